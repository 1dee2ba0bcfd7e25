#include "tilepack/transition/joined_samples.h"

#include "tilepack/error/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace tilepack {
namespace {

std::string channels_text(int count) {
  return fmt::format("{} channel{}", count, count == 1 ? "" : "s");
}

[[noreturn]] void refuse_unlike(const SampleMap& map, const SampleMap& first, const std::string& what,
                                const std::string& way_out) {
  throw Error(
      ErrorKind::invalid_content, map.label(),
      fmt::format("{}, which does not go with {}: the materials of a transition have the same maps; {}", what,
                  first.label(), way_out));
}

void require_alike(const SampleMap& first, const SampleMap& map) {
  if (map.name != first.name || map.role != first.role)
    refuse_unlike(map, first,
                  fmt::format("is a map '{}' of role {} where the first material has '{}' of role {}",
                              map.name, name_of(map.role), first.name, name_of(first.role)),
                  "take maps away, or add those that are missing");
  if (map.image.channels() != first.image.channels())
    refuse_unlike(map, first,
                  fmt::format("has {}, not {}", channels_text(map.image.channels()),
                              channels_text(first.image.channels())),
                  "convert one of them");
  if (map.encoding != first.encoding)
    refuse_unlike(map, first, fmt::format("is {}, not {}", name_of(map.encoding), name_of(first.encoding)),
                  "say how colors are encoded with " + field("encoding"));
  if (map.contents != first.contents)
    refuse_unlike(map, first, "holds other things in its channels", "pack them in one way");
  if (map.normal_y != first.normal_y)
    refuse_unlike(map, first, "has its green pointing another way",
                  "turn both with " + field("normal-y", "up"));
  if (map.range != first.range)
    refuse_unlike(map, first, "holds heights of another range",
                  "give all one range, such as " + field("height-range", "0,1"));
}

void require_same_maps(std::span<const SampleMap> first, std::span<const SampleMap> other) {
  for (std::size_t m = 0; m < std::min(first.size(), other.size()); ++m) require_alike(first[m], other[m]);
  if (first.size() == other.size()) return;
  const bool missing = other.size() < first.size();
  const SampleMap& odd = missing ? first[other.size()] : other[first.size()];
  throw Error(
      ErrorKind::invalid_content, odd.label(),
      fmt::format("is a map '{}' that the material of {} does not have: the materials of a transition have "
                  "the same maps; take it away, or add the one that is missing",
                  odd.name, (missing ? other : first).front().label()));
}

// `from` into the columns that begin at `x`, continued by its outermost texels.
void lay_material(Image& into, const Image& from, int x) {
  for (int j = 0; j < into.height(); ++j)
    for (int i = -1; i <= from.width(); ++i) {
      if (x + i < 0 || x + i >= into.width()) continue;
      const auto texel = from.texel(std::clamp(i, 0, from.width() - 1), std::min(j, from.height() - 1));
      std::copy(texel.begin(), texel.end(), into.texel(x + i, j).begin());
    }
}

} // namespace

int JoinedSamples::material_at(int x) const {
  int material = 0;
  for (std::size_t m = 1; m < places.size(); ++m)
    if (x >= places[m].x - 1) material = static_cast<int>(m);
  return material;
}

void require_joinable(std::span<const std::span<const SampleMap>> materials) {
  for (const auto& maps : materials) require_same_maps(materials.front(), maps);
}

JoinedSamples joined(std::span<const std::span<const SampleMap>> materials) {
  JoinedSamples result;
  int width = 0;
  int height = 0;
  require_joinable(materials);
  for (const auto& maps : materials) {
    const Size size = maps.front().image.size();
    result.places.push_back({width, 0, size.width, size.height});
    width += size.width + 2; // a texel beyond this one, and one before the next
    height = std::max(height, size.height);
  }
  width -= 2;
  for (std::size_t m = 0; m < materials.front().size(); ++m) {
    const SampleMap& first = materials.front()[m];
    SampleMap map(static_cast<const MapFormat&>(first), Image(width, height, first.image.channels()));
    for (std::size_t k = 0; k < materials.size(); ++k) {
      const SampleMap& part = materials[k][m];
      map.depth = std::max(map.depth, part.depth);
      lay_material(map.image, part.image, result.places[k].x);
    }
    result.maps.push_back(std::move(map));
  }
  return result;
}

} // namespace tilepack
