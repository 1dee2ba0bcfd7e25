#include "tilepack/bake/packing.h"

#include "tilepack/bake/round_trip.h"
#include "tilepack/error/error.h"
#include "tilepack/layout/array_layout.h"
#include "tilepack/layout/corner_grid.h"
#include "tilepack/layout/de_bruijn.h"
#include "tilepack/layout/tile_index.h"
#include "tilepack/mapping/even_pattern.h"
#include "tilepack/mapping/index_fill.h"
#include "tilepack/mip/far_levels.h"
#include "tilepack/mip/mip_chain.h"
#include "tilepack/pack/stored_format_for.h"
#include "tilepack/tileset/border_agreement.h"
#include "tilepack/tileset/limits.h"

#include <fmt/format.h>

#include <algorithm>

namespace tilepack {
namespace {

MappingKind mapping_kind(const PackingOptions& o, const TileColors& tiles) {
  if (o.mapping) return *o.mapping;
  return has_even_pattern(color_counts(tiles).corner) ? MappingKind::even : MappingKind::mix;
}

void check_layout_fits(const PackingOptions& o, const TileColors& tiles) {
  const bool corner = coloring_of(tiles) == Coloring::corner;
  if (o.layout == (corner ? LayoutKind::tile_index : LayoutKind::de_bruijn))
    throw Error(ErrorKind::usage, field("layout"),
                fmt::format("'{}' is for {} coloring; use {}, rotated or array with {} coloring",
                            name_of(o.layout), corner ? "edge" : "corner",
                            corner ? "de-bruijn" : "tile-index", corner ? "corner" : "edge"));
  // These name the combination that is missing or there twice.
  if (o.layout == LayoutKind::tile_index) tile_index_layout(std::get<std::vector<EdgeTile>>(tiles));
  if (o.layout == LayoutKind::de_bruijn) de_bruijn_layout(std::get<std::vector<CornerTile>>(tiles));
  if (is_complete_set(tiles)) return;
  if (const MappingKind kind = mapping_kind(o, tiles); kind != MappingKind::index)
    throw Error(
        ErrorKind::usage, field("mapping"),
        fmt::format("'{}' needs the complete set, in the order of its colors; use index for these {} tiles",
                    name_of(kind), tile_count(tiles)));
}

void check_layout_options(const PackingOptions& o, Size tile_size) {
  const RotatedOptions& r = o.rotated;
  if (o.layout != LayoutKind::rotated && (r.scheme || r.gutter || r.power_of_two))
    throw Error(ErrorKind::usage,
                r.scheme   ? field("scheme")
                : r.gutter ? field("gutter")
                           : field("power-of-two"),
                fmt::format("is for {}", field("layout", "rotated")));
  if (o.layout == LayoutKind::rotated && tile_size.width != tile_size.height)
    throw Error(
        ErrorKind::usage, field("tile-size"),
        fmt::format("{}x{} texels; tiles must be square to be turned", tile_size.width, tile_size.height));
  if (o.layout != LayoutKind::array && o.array.border != 0)
    throw Error(ErrorKind::usage, field("border"), fmt::format("is for {}", field("layout", "array")));
}

Layout layout_for(const PackingOptions& o, const TileColors& tiles, Size tile_size) {
  switch (o.layout) {
  case LayoutKind::tile_index:
    return tile_index_layout(std::get<std::vector<EdgeTile>>(tiles));
  case LayoutKind::de_bruijn:
    return de_bruijn_layout(std::get<std::vector<CornerTile>>(tiles));
  case LayoutKind::array:
    return array_layout(tile_count(tiles), tile_size, o.array.border);
  case LayoutKind::rotated:
    break;
  }
  LayoutRequest request;
  request.tiles = tile_count(tiles);
  request.tile_side = tile_size.width;
  request.scheme = o.rotated.scheme;
  request.gutter = o.rotated.gutter;
  request.power_of_two = o.rotated.power_of_two;
  return planned_layout(layout_plans(request, &tiles).front(), tile_size.width);
}

Mapping mapping_for(const PackingPlan& plan, const TileSet& set, std::uint64_t seed) {
  const PackingOptions& o = plan.options;
  switch (plan.mapping) {
  case MappingKind::permutation:
    return permutation_mapping(o.virtual_size, set.colors, seed);
  case MappingKind::mix:
    return mix_mapping(o.virtual_size, seed);
  case MappingKind::even:
    return even_mapping(o.virtual_size, set.colors.corner, seed, set.colors.variants);
  case MappingKind::index:
    break;
  }
  if (!is_complete_set(set.tiles)) return filled_index_mapping(o.virtual_size, set.tiles, seed);
  return index_mapping(has_even_pattern(set.colors.corner)
                           ? even_mapping(o.virtual_size, set.colors.corner, seed, set.colors.variants)
                           : mix_mapping(o.virtual_size, seed),
                       set.colors);
}

// Its range alone, without the work of filling an index map.
void check_virtual_size(const PackingOptions& o, const TileColors& tiles) {
  const MappingKind kind = mapping_kind(o, tiles);
  if (kind == MappingKind::permutation) permutation_mapping(o.virtual_size, color_counts(tiles), 0);
  if (kind == MappingKind::mix) mix_mapping(o.virtual_size, 0);
  if (kind == MappingKind::even) even_mapping(o.virtual_size, color_counts(tiles).corner, 0);
  if (kind == MappingKind::index) check_index_size(o.virtual_size);
}

// Tiles as the pack will store level 0, so that coarser levels are made from what is really there.
void convert(TileMap& map, const StoredFormat& to) {
  for (Image& tile : map.tiles) {
    if (to.encoding != map.encoding) tile = from_linear(to_linear(tile, map.encoding), to.encoding);
    if (to.depth != map.depth) tile = quantised(tile, to.depth);
  }
  map.encoding = to.encoding;
  map.depth = to.depth;
}

// Whether all tiles lie side by side as they are, and every texel is some tile's.
bool is_plain_grid(const Layout& layout) {
  return layout.kind != LayoutKind::rotated && layout.border == 0 &&
         layout.cells.size() ==
             static_cast<std::size_t>(layout.columns) * static_cast<std::size_t>(layout.rows);
}

// Levels past those of tiles, for maps that have those: `maps` are the set's in the pack or in its corner pack.
void add_far_levels(std::vector<PackedMap>& maps, const TileSet& set, const Layout& layout,
                    bool roughness_from_normals, int tile_levels) {
  const std::vector<Size> sizes = far_level_sizes(layout, set.tile_size, tile_levels);
  const auto last_of = [&](std::size_t m) { return PlacedLevel{maps[m].levels.back(), set.maps[m]}; };
  std::optional<PlacedLevel> normals;
  for (std::size_t m = 0; m < maps.size() && roughness_from_normals && !normals; ++m)
    if (value_space(maps[m]).has_vectors()) normals.emplace(last_of(m));
  const int layers = layout.kind == LayoutKind::array ? layout.rows : 1;
  for (std::size_t m = 0; m < maps.size(); ++m)
    for (Image& level : far_levels(last_of(m), layers, sizes, normals ? &*normals : nullptr))
      maps[m].far_levels.push_back(quantised(std::move(level), maps[m].depth));
}

} // namespace

PackingPlan planned_packing(const PackingOptions& options, const TileColors& tiles, Size tile_size) {
  if (options.format && options.depth && !holds(*options.format, *options.depth))
    throw Error(
        ErrorKind::usage, field("depth"),
        fmt::format("'{}' can't be stored in the format asked for; png holds u8 and u16, exr f16 and f32",
                    name_of(*options.depth)));
  check_layout_options(options, tile_size);
  check_layout_fits(options, tiles);
  if (options.full_mips && options.mips.mode == MipMode::none)
    throw Error(ErrorKind::usage, field("full-mips"),
                fmt::format("goes on where levels end, and {} makes none", field("mips", "none")));
  if (options.corner_pack && (coloring_of(tiles) == Coloring::corner || !is_complete_set(tiles)))
    throw Error(ErrorKind::usage, field("corner-pack"),
                "is for complete edge-colored sets; corner-colored tiles need none");
  check_virtual_size(options, tiles);
  PackingPlan plan{options, layout_for(options, tiles, tile_size), {}, mapping_kind(options, tiles)};
  plan.texture = texture_size(plan.layout, tile_size, 0);
  const Size texture = plan.texture;
  const std::int64_t texels = std::int64_t{texture.width} * texture.height;
  if (texels > most_texels_a_level || std::max(texture.width, texture.height) > limits::longest_texture_side)
    throw Error(
        ErrorKind::usage, field("tile-size"),
        fmt::format(
            "{} tiles of {} x {} texels make a texture of {} x {}; a pack has at most {} texels, and {} a "
            "side: take smaller tiles or fewer colors or variants",
            tile_count(tiles), tile_size.width, tile_size.height, texture.width, texture.height,
            most_texels_a_level, limits::longest_texture_side));
  return plan;
}

Pack packed(TileSet set, const PackingPlan& plan, std::uint64_t seed, const Progress& progress) {
  const PackingOptions& options = plan.options;
  for (TileMap& map : set.maps)
    convert(map, stored_format_for(map.role, map.encoding, map.depth, {options.format, options.depth},
                                   StoredFor::pack));

  Pack pack;
  pack.tile_size = set.tile_size;
  pack.colors = set.colors;
  pack.tiles = set.tiles;
  pack.layout = plan.layout;
  pack.mapping = mapping_for(plan, set, seed);
  pack.mip_mode = options.mips.mode;
  if (pack.mip_mode == MipMode::least_squares) pack.jump_weight = options.mips.jump_weight;
  pack.guard = set.guard;
  const int maps = static_cast<int>(set.maps.size());
  if (options.corner_pack) {
    const CornerGrid grid = corner_grid(set.colors.horizontal, set.colors.vertical);
    pack.corner_pack = CornerPack{grid.columns, grid.rows, agreed_corner_width(set), {}};
  }
  for (int m = 0; m < maps; ++m) {
    report(progress, "mips", static_cast<double>(m) / maps);
    TileMap& finest = set.maps[static_cast<std::size_t>(m)];
    std::vector<TileMap> coarser = coarser_levels(set, m, options.mips, &pack.layout);
    PackedMap map(finest, finest.tiles.front().channels());
    PackedMap corners = map;
    pack.tile_levels = levels_held(pack.layout, set.tile_size, static_cast<int>(coarser.size()) + 1);
    // Others may look at normals, and corner packs and far levels at the tiles.
    const bool done_with = is_plain_grid(pack.layout) && !options.corner_pack && !options.full_mips &&
                           finest.role != Role::normal;
    for (int level = 0; level < pack.tile_levels; ++level) {
      TileMap& tiles = level == 0 ? finest : coarser[static_cast<std::size_t>(level - 1)];
      if (done_with) {
        map.levels.push_back(quantised(atlas(std::move(tiles.tiles), pack.layout), map.depth));
        continue;
      }
      map.levels.push_back(quantised(
          place_tiles(tiles, set.tiles, pack.layout, set.tile_size, level, {options.rotated.turn_filter, {}}),
          map.depth));
      if (level == 0 && pack.layout.kind == LayoutKind::rotated)
        map.round_trips = round_trips(tiles, set.tiles, pack.layout, set.tile_size);
      if (pack.corner_pack)
        corners.levels.push_back(quantised(
            corner_atlas(tiles.tiles, corner_grid(set.colors.horizontal, set.colors.vertical)), map.depth));
    }
    pack.maps.push_back(std::move(map));
    if (pack.corner_pack) pack.corner_pack->maps.push_back(std::move(corners));
  }
  if (!options.full_mips) return pack;
  pack.full_chain = true;
  const bool rough = options.mips.roughness_from_normals;
  add_far_levels(pack.maps, set, pack.layout, rough, pack.tile_levels);
  if (pack.corner_pack) {
    Layout grid;
    grid.columns = pack.corner_pack->columns;
    grid.rows = pack.corner_pack->rows;
    add_far_levels(pack.corner_pack->maps, set, grid, rough, pack.tile_levels);
  }
  return pack;
}

Pack packed(TileSet set, const PackingOptions& options, std::uint64_t seed, const Progress& progress) {
  const PackingPlan plan = planned_packing(options, set.tiles, set.tile_size);
  return packed(std::move(set), plan, seed, progress);
}

} // namespace tilepack
