#include "tilepack/bake/material_values.h"

#include "tilepack/bake/material_normals.h"
#include "tilepack/error/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace tilepack {
namespace {

std::string place_of(const Image& image, std::size_t value) {
  const auto texel = value / static_cast<std::size_t>(image.channels());
  const auto width = static_cast<std::size_t>(image.width());
  return fmt::format("texel ({}, {})", texel % width, texel / width);
}

const char* convention(NormalY y) {
  return y == NormalY::up ? "up, as in OpenGL" : "down, as in DirectX";
}

class Notes {
public:
  void add(const SampleMap& map, const std::string& sentence) {
    list.push_back(map.label() + ": " + sentence);
  }
  std::vector<std::string> list;
};

// Which way green points, and the turn to the way that was asked for.
void settle_green(SampleMap& map, const Image* heights, const MaterialOptions& options, Notes& notes) {
  const std::optional<GreenEvidence> evidence = green_evidence(map.image, heights);
  const char* const by = evidence && evidence->from_heights ? "against the height map" : "by its slopes";
  if (map.normal_y && evidence && *map.normal_y != evidence->y) {
    notes.add(map, fmt::format("has green pointing {} by its name, but {} {}; the name is gone by",
                               convention(*map.normal_y), convention(evidence->y), by));
  } else if (!map.normal_y && evidence) {
    map.normal_y = evidence->y;
    if (!options.normal_y && evidence->y == NormalY::down)
      notes.add(map, fmt::format("has green pointing {}, {}; {} turns it", convention(NormalY::down), by,
                                 field("normal-y", "up")));
  }
  if (!options.normal_y) return;
  if (!map.normal_y) {
    map.normal_y = options.normal_y;
    notes.add(map, fmt::format("doesn't tell which way green points; it is taken to point {}, as asked for",
                               convention(*options.normal_y)));
  } else if (*map.normal_y != *options.normal_y) {
    flip_green(map);
    notes.add(map, fmt::format("has green pointing {}; it is turned {}, as asked for",
                               convention(*options.normal_y == NormalY::up ? NormalY::down : NormalY::up),
                               name_of(*options.normal_y)));
  }
}

// Of the image the channels from `first` on, `count` of them.
Image channels_of(const Image& image, std::size_t first, int count) {
  Image result = Image::unset(image.size(), count);
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      const auto from = image.texel(x, y).subspan(first, static_cast<std::size_t>(count));
      std::copy(from.begin(), from.end(), result.texel(x, y).begin());
    }
  return result;
}

bool is_constant(const Image& image, std::size_t channel) {
  const auto channels = static_cast<std::size_t>(image.channels());
  for (std::size_t at = channel; at < image.data().size(); at += channels)
    if (image.data()[at] != image.data()[channel]) return false;
  return true;
}

// Alpha has no place beside plain values: where it is 1 everywhere it goes, and opacity that a file keeps in alpha
// alone is taken from there.
void settle_alpha(SampleMap& map, Notes& notes) {
  const int channels = map.image.channels();
  const bool plain = map.role == Role::roughness || map.role == Role::height || map.role == Role::ao ||
                     map.role == Role::metallic || map.role == Role::opacity;
  if (!plain || color_channels(channels) == channels) return;
  const auto alpha = static_cast<std::size_t>(channels) - 1;
  if (is_constant(map.image, alpha)) {
    if (map.image.data()[alpha] == 1.0f) map.image = channels_of(map.image, 0, channels - 1);
    return;
  }
  bool empty = true;
  for (std::size_t c = 0; c < alpha; ++c) empty = empty && is_constant(map.image, c);
  if (map.role == Role::opacity && empty) {
    map.image = channels_of(map.image, alpha, 1);
    notes.add(map, "holds its opacity in alpha, which is taken from there");
  } else {
    notes.add(map, "has alpha, which is kept as a channel of its own and weighs nothing");
  }
}

void apply_range(SampleMap& map, const MaterialOptions& options) {
  if (is_integer(map.depth)) {
    map.range = options.height_range;
    return;
  }
  const int channels = map.image.channels();
  const Texels values = channels_of(map.image, 0, color_channels(channels)).data(); // without alpha
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  ValueRange range{static_cast<double>(*least), static_cast<double>(*greatest)};
  if (options.height_range) {
    range = *options.height_range;
    for (const auto& end : {least, greatest})
      if (*end < static_cast<float>(range.low) || *end > static_cast<float>(range.high))
        throw Error(ErrorKind::invalid_content, map.label(),
                    fmt::format("holds {} at {}, outside of {}; take {}, or {}", *end,
                                place_of(map.image, static_cast<std::size_t>(end - values.begin()) /
                                                        static_cast<std::size_t>(color_channels(channels)) *
                                                        static_cast<std::size_t>(channels)),
                                field("height-range", fmt::format("{},{}", range.low, range.high)),
                                field("height-range", fmt::format("{},{}", *least, *greatest)),
                                field("height-range", "auto")));
  }
  if (!(range.low < range.high)) range.high = range.low + 1; // all of one height
  for (int y = 0; y < map.image.height(); ++y)
    for (int x = 0; x < map.image.width(); ++x)
      for (float& v : map.image.texel(x, y).first(static_cast<std::size_t>(color_channels(channels))))
        v = static_cast<float>((static_cast<double>(v) - range.low) / (range.high - range.low));
  map.range = range;
}

} // namespace

std::vector<std::string> prepare_maps(std::vector<SampleMap>& maps, const MaterialOptions& options) {
  Notes notes;
  for (SampleMap& map : maps) settle_alpha(map, notes);
  const Image* heights = nullptr;
  for (SampleMap& map : maps)
    if (map.role == Role::height && heights == nullptr) heights = &map.image;
  bool any_normals = false;
  for (SampleMap& map : maps) {
    if (map.role != Role::normal) continue;
    any_normals = true;
    for (const std::string& sentence : complete_normals(map)) notes.add(map, sentence);
    for (const std::string& sentence : doubts_about_normals(map.image)) notes.add(map, sentence);
    settle_green(map, heights, options, notes);
  }
  if (options.normal_y && !any_normals)
    notes.list.push_back(field("normal-y") + " is for normal maps, and there is none");
  const bool ranged = options.height_range || options.fit_height_range;
  if (ranged && heights == nullptr)
    notes.list.push_back(field("height-range") + " is for height maps, and there is none");
  for (SampleMap& map : maps) {
    if (!ranged || map.role != Role::height) continue;
    if (is_integer(map.depth) && options.fit_height_range)
      notes.add(map, fmt::format("holds integers, which fill a range that is not known: {}",
                                 field("height-range", "A,B")));
    apply_range(map, options);
  }
  return notes.list;
}

std::string check_storable(const SampleMap& map, Depth depth) {
  if (!is_integer(depth) || is_integer(map.depth)) return "";
  constexpr float rounding = 0.5f / 255.0f;
  const Texels& values = map.image.data();
  const auto channels = static_cast<std::size_t>(map.image.channels());
  const auto lies_beyond = [](float v) { return v < -rounding || v > 1.0f + rounding; };
  std::size_t texels = 0, beyond = 0;
  for (std::size_t at = 0; at + channels <= values.size(); at += channels, ++texels)
    if (std::any_of(values.begin() + static_cast<std::ptrdiff_t>(at),
                    values.begin() + static_cast<std::ptrdiff_t>(at + channels), lies_beyond))
      ++beyond;
  const double share = static_cast<double>(beyond) / static_cast<double>(texels);
  if (beyond == 0) return "";
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  const std::string percent =
      share > 0.1 ? fmt::format("{:.0f} %", 100 * share) : fmt::format("{:.2g} %", 100 * share);
  if (is_light(map.role))
    return fmt::format(
        "{}: holds light of {} to {}, and {} holds 0 to 1: {} of the texels are clipped; {} keeps them",
        map.label(), *least, *greatest, name_of(depth), percent, field("format", "exr"));
  const auto worst = -*least > *greatest - 1 ? least : greatest;
  throw Error(
      ErrorKind::invalid_content, map.label(),
      fmt::format("holds values of {} to {} ({} at {}), and {} holds 0 to 1: {} of the texels would be "
                  "clipped. {}",
                  *least, *greatest, *worst,
                  place_of(map.image, static_cast<std::size_t>(worst - values.begin())), name_of(depth),
                  percent,
                  map.role == Role::height
                      ? fmt::format("Store 0 to 1 and what they stand for ({} or {}), or floats ({})",
                                    field("height-range", "auto"),
                                    field("height-range", fmt::format("{},{}", *least, *greatest)),
                                    field("format", "exr"))
                      : fmt::format("Store floats ({}), or scale the image", field("format", "exr"))));
}

} // namespace tilepack
