#pragma once

#include "tilepack/layout/layout.h"
#include "tilepack/mapping/lattice_words.h"

#include <cstdint>

namespace tilepack {

/// How a pack is looked up, as words of 32 bits: cell → colors → tile → place in the texture, for every
/// mapping and layout. The reference sampler and the fast one go by it, and whoever writes a shader's text
/// from a pack needs nothing else of it but the texels.
///
///   1. coordinate → cell     floor, then wrapped_cell() of each axis (the virtual texture need not be a power
///                            of 2). Whole tiles in integers, the fraction apart: a float loses it far out.
///   2. cell → colors         colors_of_cell(): a hash of the four lattice elements round the cell; of index
///                            maps, the colors of the tile that stands there
///   3. colors → tile         tile_of_cell(): the colors are the digits of the id in the complete set
///   4. tile → cell of the    place_of_tile(): column and row
///      texture
///   5. → texels              placement(layout, column, row, level): a point (x, y) of the tile, fractions of
///                            its sides, lies at origin + x * east + y * south, in texels of that level.
///
/// Step 5, where the layout is a
///   grid      (tile-index, de-bruijn): origin (column, row) * tile, and the texture repeats: u = (column + x)
///             / columns, v = (row + y) / rows at every level;
///   array     column is 0 and row the layer; at level l each layer is (tile >> l) + 2 * (border >> l) texels
///             wide and high, texel (0, 0) of the tile lies (border >> l) from its sides, and beyond the layer
///             its outermost texels are repeated (clamp to edge);
///   rotated   the texture repeats; with m = n² + k², p = tile_width / (tile_width + 2 gutter), g = gutter /
///             (tile_width + 2 gutter), X = g + p x, Y = g + p y, at every level: u = (column + n X - k Y) /
///             (m squares), v = (row + k X + n Y) / m. Derivatives turn alike.
///
/// The words are unsigned; see lattice_words.h for what goes round 2^32. Nothing is owned: tables are those of
/// LookupTables and of the pack's mapping.
struct PackLookup {
  LatticeWords lattice;
  LayoutWords layout;
  LayoutKind layout_kind = LayoutKind::tile_index;
  std::uint32_t levels = 0;              ///< that tiles have: mips.tile_levels, of all maps
  std::uint32_t chain_levels = 0;        ///< that textures have: with the far levels of a full chain
  std::uint32_t tiles = 0;               ///< 1..65536
  const std::uint32_t* places = nullptr; ///< by tile: column in bits 0..15, row in bits 16..31
  const std::uint32_t* colors = nullptr; ///< by tile: CellColors a, b, c, d in bits 0..7, 8..15, …

  std::uint32_t corner_columns = 0; ///< of the corner pack: Kh², 0 where there is none
  std::uint32_t corner_rows = 0;    ///< Kv²
  float corner_width = 0;           ///< CornerPack::width, texels of level 0
};

/// A cell of the texture's grid; of rotated layouts, see Layout. Both below 65536.
struct TexturePlace {
  std::uint32_t column = 0;
  std::uint32_t row = 0;
  bool operator==(const TexturePlace&) const = default;
};

inline TexturePlace unpacked_place(std::uint32_t word) {
  return {word & 0xffffu, word >> 16};
}

/// The id of the tile in a cell within the virtual texture.
inline std::uint32_t tile_of_cell(const PackLookup& lookup, LatticeCell cell) {
  return tile_of_cell(lookup.lattice, cell);
}

/// The colors of a tile, for any mapping.
inline CellColors colors_of_tile(const PackLookup& lookup, std::uint32_t tile) {
  const std::uint32_t word = lookup.colors[tile];
  return {word & 0xffu, word >> 8 & 0xffu, word >> 16 & 0xffu, word >> 24};
}

/// The colors of the tile in a cell within the virtual texture, for any mapping.
inline CellColors colors_of_cell(const PackLookup& lookup, LatticeCell cell) {
  if (lookup.lattice.kind == MappingKind::index) return colors_of_tile(lookup, tile_of_cell(lookup, cell));
  return colors_of_cell(lookup.lattice, cell);
}

/// Where a tile lies, and the tile of a cell.
inline TexturePlace place_of_tile(const PackLookup& lookup, std::uint32_t tile) {
  return unpacked_place(lookup.places[tile]);
}
inline TexturePlace place_of_cell(const PackLookup& lookup, LatticeCell cell) {
  return place_of_tile(lookup, tile_of_cell(lookup, cell));
}

/// place_of_cell as it stands in `places`. For the kernels of the fast sampler, which are compiled apart.
std::uint32_t packed_place_of_cell(const PackLookup& lookup, std::uint32_t x, std::uint32_t y);

/// The cell of the corner pack whose south-east corner is lattice point (x, y), which lies within the virtual
/// texture: column TileIndex1D(left, right), row TileIndex1D(up, down) of the colors of the edges that end in
/// it, left = H(x-1, y), right = H(x, y), up = V(x, y-1), down = V(x, y).   [Wei04, App. B]
TexturePlace corner_place(const PackLookup& lookup, LatticeCell point);

} // namespace tilepack
