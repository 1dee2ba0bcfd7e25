#include "tilepack/pack/bake.h"

#include "tilepack/error/error.h"
#include "tilepack/layout/de_bruijn.h"
#include "tilepack/layout/tile_index.h"
#include "tilepack/pack/bake_fields.h"
#include "tilepack/pack/file_name.h"
#include "tilepack/synth/period.h"

#include <fmt/format.h>

#include <set>

namespace tilepack {
namespace {

bool is_integer(Depth depth) {
  return depth == Depth::u8 || depth == Depth::u16;
}

void check_options(const BakeOptions& o) {
  if (o.format && o.depth && (*o.format == PackFormat::png) != is_integer(*o.depth))
    throw Error(
        ErrorKind::usage, "--depth",
        fmt::format("'{}' can't be stored in the format asked for; png holds u8 and u16, exr f16 and f32",
                    name_of(*o.depth)));
  const bool corner = o.synth.coloring == Coloring::corner;
  if (o.layout == (corner ? LayoutKind::tile_index : LayoutKind::de_bruijn))
    throw Error(ErrorKind::usage, "--layout",
                fmt::format("'{}' is for {} coloring; use {} with {} coloring", name_of(o.layout),
                            corner ? "edge" : "corner", corner ? "de-bruijn" : "tile-index",
                            corner ? "corner" : "edge"));
  const std::int64_t h = o.synth.colors.horizontal, v = o.synth.colors.vertical, k = o.synth.colors.corner;
  const std::int64_t tiles = corner ? k * k * k * k : h * h * v * v;
  const std::int64_t texels = tiles * o.synth.tile_size.width * o.synth.tile_size.height;
  if (texels > most_texels_a_level)
    throw Error(
        ErrorKind::usage, "--tile-size",
        fmt::format("{} tiles of {} x {} texels make {} texels; a pack has at most {}: take smaller tiles "
                    "or fewer colors",
                    tiles, o.synth.tile_size.width, o.synth.tile_size.height, texels, most_texels_a_level));
}

void check_samples(std::span<const SampleMap> samples) {
  if (samples.empty()) throw Error(ErrorKind::usage, "", "there is no sample; name an image");
  std::set<std::string> names;
  for (const SampleMap& map : samples) {
    if (!is_map_name(map.name))
      throw Error(ErrorKind::usage, map.name,
                  "is no name of a map; use 1 to 64 letters, digits, '-' and '_'");
    if (!names.insert(map.name).second)
      throw Error(ErrorKind::usage, map.name, "is the name of two maps; give each its own");
    if (map.image.size() != samples[0].image.size())
      throw Error(ErrorKind::invalid_content, map.name,
                  fmt::format("is {} x {} texels, and {} is {} x {}; the maps of a material have one size",
                              map.image.width(), map.image.height(), samples[0].name,
                              samples[0].image.width(), samples[0].image.height()));
  }
}

Depth stored_depth(Depth sample, const BakeOptions& options) {
  if (options.depth) return *options.depth;
  if (options.format == PackFormat::png && !is_integer(sample)) return Depth::u16;
  if (options.format == PackFormat::exr && is_integer(sample)) return Depth::f16;
  return sample;
}

// Tiles as the pack will store level 0, so that coarser levels are made from what is really there.
void convert(TileMap& map, Depth depth) {
  const bool becomes_float = is_integer(map.depth) && !is_integer(depth);
  const bool becomes_integer = !is_integer(map.depth) && is_integer(depth);
  Encoding encoding = map.encoding;
  if (map.role == Role::color && becomes_float) encoding = Encoding::linear;
  if (map.role == Role::color && becomes_integer) encoding = Encoding::srgb;
  for (Image& tile : map.tiles) {
    if (encoding != map.encoding) tile = from_linear(to_linear(tile, map.encoding), encoding);
    if (depth != map.depth) tile = quantised(tile, depth);
  }
  map.encoding = encoding;
  map.depth = depth;
}

Layout layout_for(LayoutKind kind, const TileColors& tiles) {
  if (kind == LayoutKind::tile_index) return tile_index_layout(std::get<std::vector<EdgeTile>>(tiles));
  if (kind == LayoutKind::de_bruijn) return de_bruijn_layout(std::get<std::vector<CornerTile>>(tiles));
  throw Error(ErrorKind::usage, "--layout",
              fmt::format("'{}' can't be baked by this version; use tile-index or de-bruijn", name_of(kind)));
}

Mapping mapping_for(const BakeOptions& o) {
  const ColorCounts& colors = o.synth.colors;
  switch (o.mapping) {
  case MappingKind::permutation:
    return permutation_mapping(o.virtual_size, colors, o.synth.seed);
  case MappingKind::mix:
    return mix_mapping(o.virtual_size, o.synth.seed);
  case MappingKind::index:
    break;
  }
  return index_mapping(mix_mapping(o.virtual_size, o.synth.seed), colors);
}

PackedMap packed(const TileSet& set, int map, const Layout& layout, const MipOptions& mips) {
  const TileMap& finest = set.maps[static_cast<std::size_t>(map)];
  PackedMap result{finest.name, finest.role, finest.encoding, finest.depth, finest.tiles.front().channels(),
                   {}};
  for (const TileMap& level : mip_chain(set, map, mips, &layout))
    result.levels.push_back(quantised(atlas(level.tiles, layout), result.depth));
  return result;
}

} // namespace

Pack bake(std::span<const SampleMap> samples, const BakeOptions& options, const Progress& progress) {
  check_samples(samples);
  SynthOptions synth = options.synth;
  if (options.fit_tile_size)
    synth.tile_size =
        fitting_tile_size(detect_periods(samples), synth.tile_size, samples[0].image.size()).size;
  check_options(options);
  if (options.corner_pack)
    throw Error(ErrorKind::usage, "--corner-pack", "can't be baked by this version; leave it out");
  // Before the long stage, so that a virtual size out of range is known at once.
  Mapping mapping = mapping_for(options);
  TileSet set = assembled(synthesize(samples, synth, progress), samples);
  for (TileMap& map : set.maps) convert(map, stored_depth(map.depth, options));

  Pack pack;
  pack.generator.version = TILEPACK_VERSION;
  pack.generator.options = recorded_options(options);
  pack.generator.seed = options.synth.seed;
  pack.tile_size = set.tile_size;
  pack.colors = set.colors;
  pack.tiles = set.tiles;
  pack.layout = layout_for(options.layout, set.tiles);
  pack.mapping = std::move(mapping);
  pack.mip_mode = options.mips.mode;
  pack.guard = set.guard;
  for (int m = 0; m < static_cast<int>(set.maps.size()); ++m) {
    report(progress, "mips", static_cast<double>(m) / static_cast<double>(set.maps.size()));
    pack.maps.push_back(packed(set, m, pack.layout, options.mips));
  }
  pack.tile_levels = static_cast<int>(pack.maps.front().levels.size());
  return pack;
}

} // namespace tilepack
