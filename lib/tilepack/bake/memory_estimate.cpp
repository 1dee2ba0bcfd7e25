#include "tilepack/bake/memory_estimate.h"

#include "tilepack/bake/tile_size_choice.h"
#include "tilepack/exemplar/feature_image.h"
#include "tilepack/synth/framed_set_settings.h"

#include <algorithm>

namespace tilepack {
namespace {

// Bytes; what each was fitted to stands in the header.
constexpr double program = 13e6;
constexpr double a_thread = 3e6;
constexpr double about_a_sample_texel = 5;
constexpr double about_a_searched_texel = 105;
constexpr double about_a_texel_beyond = 40; // of the level that is searched in parts
constexpr double about_a_tile_texel = 23;
constexpr double about_a_float_stored = 32; // what the encoder of EXR holds
constexpr double about_a_cell = 9;          // of an index map: its ids, and the bytes of index.png
constexpr double a_float = 4;
constexpr double all_levels = 4.0 / 3; // of a pyramid, its finest being 1

// A rotated texture wastes a share, and is made once more by each filter that is compared.
constexpr double rotated_share = 1.6;

double squared(double x) {
  return x * x;
}

// Tiles that are synthesized: always the complete set.
double made_tiles(const BakeOptions& o) {
  const ColorCounts& k = o.synth.colors;
  return k.variants * (o.synth.coloring == Coloring::corner
                           ? squared(squared(k.corner))
                           : squared(static_cast<double>(k.horizontal) * k.vertical));
}

double packed_tiles(const BakeOptions& o) {
  const ColorCounts& k = o.synth.colors;
  return o.set == SetKind::sequential ? 2.0 * k.horizontal * k.vertical : made_tiles(o);
}

// Sets that are stored as they are, each tile given up as it is placed.
bool placed_one_by_one(const BakeOptions& o) {
  return o.layout != LayoutKind::rotated && !(o.layout == LayoutKind::array && o.array.border > 0) &&
         !o.corner_pack && !o.full_mips;
}

// By a tile along each axis.
bool may_be_continued(const BakeOptions& o) {
  return o.wraps != WrapChoice::no;
}

// Maps that are straightened, made even in tone or continued are held beside those that were read; whether a sample
// asks for it, nothing tells before it is read.
bool may_hold_copies(const BakeOptions& o) {
  return o.flatten > 0 || o.fit_flatten || o.straighten || may_be_continued(o);
}

// The sample that is synthesized from.
Size kept_size(Size sample, const BakeOptions& o) {
  if (!may_be_continued(o)) return sample;
  return {sample.width + o.synth.tile_size.width, sample.height + o.synth.tile_size.height};
}

double texels_of(Size size) {
  return static_cast<double>(size.width) * size.height;
}

// Of the level that is searched.
double searched_bytes(double sample_texels, Size tile) {
  const FramedSetSettings settings;
  for (int side = std::min(tile.width, tile.height); side / 2 >= settings.smallest_search_tile; side /= 2)
    sample_texels /= 4;
  const double searched = std::min(sample_texels, static_cast<double>(settings.most_searched_texels));
  return about_a_searched_texel * searched + about_a_texel_beyond * (sample_texels - searched);
}

// Texels of the textures of a map's finest level to one texel of its tiles.
double texture_share(const BakeOptions& o) {
  const double width = o.synth.tile_size.width;
  const double height = o.synth.tile_size.height;
  double share = o.corner_pack ? 2 : 1;
  if (o.layout == LayoutKind::array)
    share *= (width + 2 * o.array.border) / width * (height + 2 * o.array.border) / height;
  if (o.layout == LayoutKind::rotated)
    share *= rotated_share * squared((width + 2 * o.rotated.gutter.value_or(2)) / width);
  return share;
}

bool stored_as_floats(const MapShape& map, const BakeOptions& o) {
  if (o.depth) return *o.depth == Depth::f16 || *o.depth == Depth::f32;
  if (o.format) return *o.format == PackFormat::exr;
  return map.depth == Depth::f16 || map.depth == Depth::f32;
}

} // namespace

std::int64_t memory_estimate(std::span<const MapShape> maps, const BakeOptions& asked, int threads) {
  BakeOptions options = asked;
  if (options.fit_tile_size && !maps.empty()) {
    const int side = largest_tile_side_for(maps.front().size, static_cast<int>(made_tiles(options)));
    options.synth.tile_size = {side, side};
  }
  double channels = 0;
  double float_channels = 0;
  for (const MapShape& map : maps) {
    channels += map.channels;
    if (stored_as_floats(map, options)) float_channels += map.channels;
  }
  const double features = std::min<double>(channels, max_feature_channels);
  const Size size = maps.empty() ? Size{} : maps.front().size;
  const double read_texels = may_hold_copies(options) ? texels_of(size) : 0; // beside those that are kept
  const double sample_texels = texels_of(kept_size(size, options));
  const double tile_texels = texels_of(options.synth.tile_size);

  const double of_sample = channels * a_float + features + (features + 1) * all_levels + about_a_sample_texel;
  const double of_tile =
      channels * a_float * ((placed_one_by_one(options) ? 0 : 1) + all_levels * texture_share(options)) +
      float_channels * about_a_float_stored + about_a_tile_texel;
  const double sources_left_out = (made_tiles(options) - packed_tiles(options)) * sizeof(std::int32_t) * 2;
  double bytes = program + a_thread * threads + read_texels * channels * a_float + sample_texels * of_sample +
                 searched_bytes(sample_texels, options.synth.tile_size) +
                 tile_texels * (packed_tiles(options) * of_tile + sources_left_out);
  if (options.mapping == MappingKind::index)
    bytes += about_a_cell * static_cast<double>(options.virtual_size.width) *
             static_cast<double>(options.virtual_size.height);
  return static_cast<std::int64_t>(std::min(bytes, 9e18));
}

} // namespace tilepack
