#include "tilepack/bake/prepared_sample.h"

#include "tilepack/bake/material_values.h"
#include "tilepack/bake/tile_size_choice.h"
#include "tilepack/error/error.h"
#include "tilepack/exemplar/feature_image.h"
#include "tilepack/exemplar/flatten.h"
#include "tilepack/exemplar/object_scale.h"
#include "tilepack/exemplar/straighten.h"
#include "tilepack/pack/file_name.h"
#include "tilepack/pack/stored_format_for.h"
#include "tilepack/tileset/limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace tilepack {
namespace {

// Averages, differences and their squares must stay finite, and so must what is stored.
constexpr float largest_value = 1e30f;
constexpr float largest_half = 65504.0f;

void check_values(const SampleMap& map, Depth stored) {
  const float largest = stored == Depth::f16 ? largest_half : largest_value;
  const Texels& values = map.image.data();
  const auto bad =
      std::find_if(values.begin(), values.end(), [&](float v) { return !(std::abs(v) <= largest); });
  if (bad == values.end()) return;
  const auto texel = (bad - values.begin()) / map.image.channels();
  throw Error(ErrorKind::invalid_content, map.label(),
              fmt::format("holds {} at texel ({}, {}); {} values may be {} to {}: scale the image{}", *bad,
                          texel % map.image.width(), texel / map.image.width(), name_of(stored), -largest,
                          largest,
                          stored == Depth::f16 ? ", or store it with " + field("depth", "f32") : ""));
}

// Values can leave the range that is stored: four times as bright is too much for some half.
std::vector<SampleMap> flattened_maps(std::span<const SampleMap> samples, const BakeOptions& options,
                                      const ToneChoice& tones, Size tile) {
  // Rounded once, to what is stored. Of f16 later, for what is too large for it is refused and not clamped.
  std::optional<Depth> depth = options.depth;
  if (depth == Depth::f16) depth = Depth::f32;
  std::vector<SampleMap> maps;
  for (const SampleMap& map : samples) {
    maps.push_back(flattened(map, tones.flatten / 100.0, tile, depth, tones.courses));
    check_values(maps.back(), options.depth.value_or(map.depth));
  }
  return maps;
}

// How far tile_size_in_step() goes from the side that suits the sample.
TileSides tile_sides(int side, Size sample) {
  const auto most = [&](int whole) { return std::min(side + side / 3, whole / 2); };
  const int least = side - side / 4;
  return {{least, least}, {side, side}, {most(sample.width), most(sample.height)}};
}

void check_flatten(int percent) {
  if (percent < 0 || percent > 100)
    throw Error(ErrorKind::usage, field("flatten"),
                fmt::format("{} is not allowed; it must be 0 to 100 percent", percent));
}

} // namespace

void check_fit(const SampleMap& sample, Size tile) {
  const Size size = sample.image.size();
  if (size.width >= tile.width && size.height >= tile.height) return;
  if (std::max(tile.width, tile.height) > limits::largest_tile_side)
    return; // a fault of the option, and told so later
  const int side = std::min({size.width, size.height, limits::largest_tile_side});
  const std::string way_out =
      side >= limits::smallest_tile_side_made
          ? fmt::format("take tiles of {} at most ({}) or a larger sample", side,
                        field("tile-size", std::to_string(side)))
          : fmt::format("no tile fits, since tiles have at least {} texels a side: take a larger sample",
                        limits::smallest_tile_side_made);
  throw Error(ErrorKind::invalid_content, sample.label(),
              fmt::format("has {} x {} texels, too few for a tile of {} x {}; {}", size.width, size.height,
                          tile.width, tile.height, way_out));
}

void check_one_size(std::span<const SampleMap> samples) {
  for (const SampleMap& map : samples)
    if (map.image.size() != samples[0].image.size())
      throw Error(ErrorKind::invalid_content, map.label(),
                  fmt::format("is {} x {} texels, and {} is {} x {}; the maps of a material have one size",
                              map.image.width(), map.image.height(), samples[0].label(),
                              samples[0].image.width(), samples[0].image.height()));
}

void check_samples(std::span<const SampleMap> samples, const BakeOptions& options) {
  if (samples.empty()) throw Error(ErrorKind::usage, "", "there is no sample; name an image");
  check_one_size(samples);
  std::set<std::string> names;
  for (const SampleMap& map : samples) {
    if (!is_map_name(map.name))
      throw Error(ErrorKind::usage, map.name,
                  "is no name of a map; use 1 to 64 letters, digits, '-' and '_'");
    if (!names.insert(map.name).second)
      throw Error(ErrorKind::usage, map.name,
                  fmt::format("is the name of two maps; give each its own, as in {}",
                              field("map", "NAME:ROLE=FILE")));
    if (map.role == Role::normal && map.image.channels() < 3)
      throw Error(
          ErrorKind::invalid_content, map.label(),
          fmt::format("has {} channel{}, and a normal map has 3: x, y and z; give another role, such as "
                      "height",
                      map.image.channels(), map.image.channels() == 1 ? "" : "s"));
    const StoredFormat stored = stored_format_for(map.role, map.encoding, map.depth,
                                                  {options.format, options.depth}, StoredFor::pack);
    check_values(map, stored.depth);
    check_storable(map, stored.depth);
  }
}

void check_set_choice(const BakeOptions& o) {
  const ColorCounts& k = o.synth.colors;
  const bool edge = o.synth.coloring == Coloring::edge;
  const int most = edge ? limits::most_edge_colors : limits::most_corner_colors;
  for (const int count : edge ? std::vector{k.horizontal, k.vertical} : std::vector{k.corner})
    if (count < 1 || count > most)
      throw Error(ErrorKind::usage, field("colors"),
                  fmt::format("{} is not allowed; it must be 1 to {}", count, most));
  if (k.variants < 1 || k.variants > limits::most_variants)
    throw Error(ErrorKind::usage, field("variants"),
                fmt::format("{} is not allowed; it must be 1 to {}", k.variants, limits::most_variants));
  if (combinations(k) * k.variants > limits::most_tiles)
    throw Error(
        ErrorKind::usage, field("variants"),
        fmt::format(
            "{} of {} combinations of colors are {} tiles, and a pack holds {}; take fewer, or fewer colors",
            k.variants, combinations(k), combinations(k) * k.variants, limits::most_tiles));
  if (k.variants > 1 && o.set == SetKind::sequential)
    throw Error(
        ErrorKind::usage, field("variants"),
        "of a sequential set there are none: an index map chooses between its two tiles for each north and "
        "west color already");
  if (o.set == SetKind::sequential && o.synth.coloring == Coloring::corner)
    throw Error(ErrorKind::usage, field("set"),
                "'sequential' is for edge coloring; corner-colored sets are complete");
  if (o.set == SetKind::sequential && o.layout == LayoutKind::tile_index)
    throw Error(ErrorKind::usage, field("layout"),
                "'tile-index' needs the complete set; use rotated or array");
}

PreparedSample straightened_sample(std::span<const SampleMap> samples, const BakeOptions& options, int tiles,
                                   int settled_side) {
  PreparedSample result;
  result.size = samples[0].image.size();
  const bool look = (options.fit_tile_size && settled_side == 0) || options.wraps == WrapChoice::found;
  const FeatureImage features = look ? feature_image(samples) : FeatureImage();
  std::optional<Periodicity>& periods = result.periods;
  if (look || options.straighten) periods = detect_periods(samples);
  result.wrap = options.wraps == WrapChoice::found
                    ? detect_wrap(features, *periods)
                    : SampleWrap{options.wraps == WrapChoice::yes, options.wraps == WrapChoice::yes};
  result.side = settled_side > 0        ? settled_side
                : options.fit_tile_size ? tile_side_for(result.size, object_scale(features), tiles)
                                        : 0;
  // A sample whose courses wrap or repeat texel by texel is even as it is.
  const bool is_even = options.wraps == WrapChoice::yes ||
                       (result.wrap.x && periods && periods->x.length > 0) ||
                       (result.wrap.y && periods && periods->y.length > 0) ||
                       (periods && (periods->x.exact || periods->y.exact));
  if (!options.straighten || is_even) return result;
  const Size asked = options.synth.tile_size;
  Straightened straight =
      straightened(samples, *periods,
                   result.side > 0 ? tile_sides(result.side, result.size) : TileSides{asked, asked, asked});
  if (!straight.done()) return result;
  result.maps = std::move(straight.maps);
  result.straightened = straight.moved;
  periods = straight.periods;
  result.wrap = {};                          // its borders moved
  result.size = result.maps[0].image.size(); // a few texels less
  return result;
}

void finish_sample(PreparedSample& sample, std::span<const SampleMap> given, const BakeOptions& options,
                   Size tile) {
  check_flatten(options.flatten);
  if (sample.wrap != SampleWrap{}) {
    const auto samples = sample.used(given);
    if (!sample.periods)
      sample.periods = detect_periods(samples); // of what is given: a cut at its end would disturb
    // A tile more, so that a window of that size may begin anywhere.
    sample.maps = continued(samples, {sample.size.width + (sample.wrap.x ? tile.width : 0),
                                      sample.size.height + (sample.wrap.y ? tile.height : 0)});
  }
  if (options.fit_flatten && !sample.periods) sample.periods = detect_periods(sample.used(given));
  sample.tones = options.fit_flatten ? tone_choice(sample.used(given), *sample.periods, tile)
                                     : ToneChoice{options.flatten, {}};
  if (sample.tones.flatten > 0) {
    sample.maps = flattened_maps(sample.used(given), options, sample.tones, tile);
    if (sample.straightened == 0 && !sample.tones.courses)
      sample.periods.reset(); // those of a straightened sample are exact
  }
}

} // namespace tilepack
