#pragma once

#include "tilepack/layout/layout.h"

namespace tilepack {

/// A pair of edge colors along one axis: of the left and right edges of a tile, or of its top and bottom
/// edges.
struct ColorPair {
  int first = 0;
  int second = 0;
  bool operator==(const ColorPair&) const = default;
};

/// TileIndex1D: where the tile joining left color `a` to right color `b` sits in a one-dimensional strip.
///
/// Cells are ordered so that each cell's right edge color is the next cell's left edge color, cyclically; a
/// bilinear fetch across a cell border therefore reads a tile that could lie there in the plane.   [Wei04,
/// Eq. 6]
///
///   strip, n = 2:   0─[0]─0   0─[1]─1   1─[2]─1   1─[3]─0   (then back to cell 0)
///
/// Guarantees (tests/layout/tile_index_test.cpp, n = 1..8):
///   * bijection of {0..n-1}² onto {0..n²-1};
///   * neighbours share their color, including last → first;
///   * nested: pairs using only colors < m fill exactly the first m² cells, so n may grow without moving
///   tiles.
int tile_index_1d(int a, int b);

/// Inverse of tile_index_1d: the (left, right) colors of cell `index` >= 0.
ColorPair color_pair_at(int index);

/// The complete edge set on a Kv² × Kh² torus: column = TileIndex1D(west, east), row = TileIndex1D(north,
/// south). [Wei04, Eq. 7], north and south swapped since our v grows down. Variants, a complete set after the other,
/// lie on copies of that torus one below the other: row + variant · Kh². What lies below a copy's last row is its
/// first row of colors again, so neighbours agree and the whole still wraps.
Layout tile_index_layout(const std::vector<EdgeTile>& complete_set);

} // namespace tilepack
