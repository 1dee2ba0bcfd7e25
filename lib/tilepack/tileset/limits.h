#pragma once

#include <cstdint>

namespace tilepack {

/// The limits of tile sets and packs, each once. What bakes and packs tile sets, what lays them out, reads and
/// samples them, pack.schema.json, pack/FORMAT.md and the help texts all hold the same numbers
/// (tests/pack/limits_test.cpp compares them).
///
/// A limit named smallest_… or …_made binds only what makes packs: a reader takes less of it, or more, and
/// the comment says so.
namespace limits {

/// Texels, side of a tile that is made: two texels of border on both sides. A pack may have tiles of 1.
inline constexpr int smallest_tile_side_made = 4;

/// Texels, side of a tile of a pack at level 0. A complete set of 16 tiles of this side, as a layout of 4 × 4,
/// is just a level of most_texels_a_level.
inline constexpr int largest_tile_side = 4096;

/// Colors of horizontal edges, and of vertical ones: 8 × 8 give a complete set of 4096 tiles.
inline constexpr int most_edge_colors = 8;

/// Colors of corners, for whose 256 tiles a torus is known (layout/de_bruijn.h), and even patterns (mapping/even_pattern.h).
inline constexpr int most_corner_colors = 4;

/// Insides of every combination of colors. The even pattern writes them as digits.
inline constexpr int most_variants = 8;

/// Tiles of a set, and so cells of a layout and layers of an array: the complete set of 8 × 8 edge colors.
inline constexpr int most_tiles = most_edge_colors * most_edge_colors * most_edge_colors * most_edge_colors;

/// Columns and rows of a grid's or corner pack's combinations along one axis: pairs of edge colors.
inline constexpr int most_color_pairs = most_edge_colors * most_edge_colors;

/// Tiles of a rotated scheme that is only reckoned with (`layouts --tiles`): 256². A pack holds most_tiles.
inline constexpr int most_scheme_tiles = 65536;

/// n of a rotated scheme of a pack: n² <= most_tiles.
inline constexpr int largest_scheme_n = 64;

/// A guard that is made takes one in so many texels of the shorter side at most; else the inside has no room.
/// The guard of hand-drawn tiles is measured, and may be as long as the longer side.
inline constexpr int guard_share_made = 8;
inline constexpr int largest_guard_made = largest_tile_side / guard_share_made; ///< texels

/// Texels round each tile: of a rotated layout up to a tile's side, of an array layer up to half of it.
inline constexpr int largest_gutter = largest_tile_side;
inline constexpr int largest_layer_border = largest_tile_side / 2;

/// Levels of a tile: 4096 halves twelve times. Levels of a map with a full chain: 65536 halves sixteen times.
inline constexpr int most_levels = 13;
inline constexpr int most_chain_levels = 17;

/// What a jump across a border may cost against an error, when coarser levels are fitted (mip/least_squares.h).
inline constexpr int most_jump_weight = 1000;

/// Maps of a pack, channels of one, and letters of a map's name, which is part of file names.
inline constexpr int most_maps = 64;
inline constexpr int most_map_channels = 4;
inline constexpr int longest_map_name = 64;

/// Texels of one level of a map: 16384 × 16384, beyond what graphics hardware takes. Limits what reading a
/// pack can make a program allocate.
inline constexpr std::int64_t most_texels_a_level = std::int64_t{1} << 28;

/// Texels, side of a texture: what image files are read and written with (image/image_file.h).
inline constexpr int longest_texture_side = 65536;

/// Tiles, side of the virtual texture. Twice as much and lattice coordinates would leave 32 bits.
inline constexpr std::int64_t longest_virtual_side = std::int64_t{1} << 31;

/// Entries of a permutation table.
inline constexpr int longest_table = 65536;

/// Tiles, side of the virtual texture over which a permutation is made: its table is at least twice as long,
/// and beyond it would be larger than a small index map. Tables of packs repeat over longer sides.
inline constexpr std::int64_t longest_permutation_side_made = 4096;

/// Cells of an index map: along a side, as it is an image, and in all, each an int in memory.
inline constexpr std::int64_t longest_index_side = longest_texture_side;
inline constexpr std::int64_t most_index_cells = std::int64_t{1} << 26;

/// Cells of an index map that is printed as JSON, of which a cell takes 3 to 6 bytes (mapping/index_json.h).
inline constexpr std::int64_t most_index_cells_as_json = std::int64_t{1} << 20;

/// The largest seed: whole in every JSON reader, also those that keep numbers as doubles.
inline constexpr std::uint64_t largest_seed = (std::uint64_t{1} << 53) - 1;

/// Effort of a bake, 0 to this.
inline constexpr int highest_effort = 9;

} // namespace limits
} // namespace tilepack
