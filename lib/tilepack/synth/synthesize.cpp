#include "tilepack/synth/synthesize.h"

#include "tilepack/error/error.h"
#include "tilepack/synth/framed_set.h"
#include "tilepack/synth/quilt.h"
#include "tilepack/tileset/limits.h"

#include <fmt/format.h>

#include <string>

namespace tilepack {
namespace {

void require_in_range(const char* name, int value, int low, int high, const char* way_out) {
  if (value < low || value > high)
    throw Error(ErrorKind::usage, field(name),
                fmt::format("{} is not in {}..{}; {}", value, low, high, way_out));
}

void require_valid(const SynthOptions& options) {
  for (const int side : {options.tile_size.width, options.tile_size.height})
    require_in_range("tile-size", side, limits::smallest_tile_side_made, limits::largest_tile_side,
                     "give each side in texels, such as 128");
  if (options.coloring == Coloring::edge) {
    for (const int colors : {options.colors.horizontal, options.colors.vertical})
      require_in_range("colors", colors, 1, limits::most_edge_colors, "2 or 3 suit most textures");
  } else {
    require_in_range("colors", options.colors.corner, 1, limits::most_corner_colors,
                     "2 or 3 suit most textures; edge coloring allows 8");
    if (options.interior == Construction::quilt)
      throw Error(ErrorKind::usage, field("interior"),
                  "quilt is made for edge coloring only; use " + field("interior", "patch") + " or " +
                      field("coloring", "edge"));
  }
  require_in_range("variants", options.colors.variants, 1, limits::most_variants,
                   "2 show half as many repeats");
  if (options.colors.variants > 1 && options.interior == Construction::quilt)
    throw Error(
        ErrorKind::usage, field("variants"),
        fmt::format(
            "{}, but quilted tiles of equal colors are equal: they have no inside of their own; use {}",
            options.colors.variants, field("interior", "patch")));
  const int smaller_side = std::min(options.tile_size.width, options.tile_size.height);
  require_in_range("guard", options.guard, 0, smaller_side / limits::guard_share_made,
                   "a guard takes at most an eighth of the tile");
  require_in_range("effort", options.effort, 0, limits::highest_effort, "5 is the default");
}

void require_one_size(std::span<const SampleMap> samples) {
  if (samples.empty()) throw Error(ErrorKind::usage, "sample", "no map was given; at least one is needed");
  const Size size = samples.front().image.size();
  for (const SampleMap& map : samples)
    if (map.image.size() != size)
      throw Error(
          ErrorKind::invalid_content, map.name,
          fmt::format("is {} x {} texels, but {} is {} x {}; all maps of a material must have one size",
                      map.image.width(), map.image.height(), samples.front().name, size.width, size.height));
}

void require_fitting(const std::string& name, Size size, Size tile) {
  if (size.width >= tile.width && size.height >= tile.height) return;
  const int fits = std::min(size.width, size.height);
  const std::string way_out =
      fits >= limits::smallest_tile_side_made
          ? fmt::format("the largest square tile that fits is {}", std::min(fits, limits::largest_tile_side))
          : fmt::format("no tile fits, since a tile has at least {} texels a side",
                        limits::smallest_tile_side_made);
  throw Error(ErrorKind::invalid_content, name,
              fmt::format("{} x {} texels are too few for a tile of {} x {}; {}", size.width, size.height,
                          tile.width, tile.height, way_out));
}

} // namespace

SourceMap synthesize(std::span<const SampleMap> samples, const SynthOptions& options,
                     const Progress& progress) {
  require_valid(options);
  require_one_size(samples);
  require_fitting(samples.front().name, samples.front().image.size(), options.tile_size);
  return synthesize(analysed(samples, {}, halvings_to_usual(options.tile_size)), options, progress);
}

SourceMap synthesize(const SampleAnalysis& sample, const SynthOptions& options, const Progress& progress) {
  const FeatureImage& image = sample.features;
  require_valid(options);
  require_fitting("sample", {image.width, image.height}, options.tile_size);
  if (options.interior == Construction::framed)
    return framed_set(sample, options, settings_for(options.effort, options.seed), progress);
  return quilted(image, options, chosen_edge_patches(image, options, progress));
}

} // namespace tilepack
