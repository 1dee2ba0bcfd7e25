#pragma once

#include "tilepack/image/image.h"
#include "tilepack/tileset/tile_colors.h"

#include <vector>

namespace tilepack {

/// The corner pack of a complete edge-colored set: the places where four tiles meet, one cell a combination
/// of the four edge colors round a lattice point.   [Wei04, App. B]
///
/// The lattice point lies at the south-east corner of its cell. With `left` and `right` the colors of the
/// horizontal edges that end in it, `up` and `down` those of the vertical ones:
///
///            │ up               column = TileIndex1D(left, right),  0 .. Kh² - 1
///      ──────┼──────            row    = TileIndex1D(up, down),     0 .. Kv² - 1
///       left │ right
///            │ down
///
/// The cell's tile has north = south = left and west = east = up. Its neighbours in the grid, which wraps,
/// are then tiles with the colors wanted on the other side of the point, so that filtering across the corner
/// is right. Only Kh · Kv different tiles are used; away from their corners they are not the virtual
/// texture's.
struct CornerGrid {
  int columns = 0;
  int rows = 0;
  std::vector<int> tiles; ///< row by row: id of the tile in the complete set
  bool operator==(const CornerGrid&) const = default;
};

/// Colors 1..8 (Error, usage).
CornerGrid corner_grid(int horizontal_colors, int vertical_colors);

/// Where the point with these colors is found: the cell whose south-east corner it is.
struct CornerCell {
  int column = 0;
  int row = 0;
  bool operator==(const CornerCell&) const = default;
};
CornerCell corner_cell(int left, int right, int up, int down);

/// The grid's tiles side by side, from those of one level.
Image corner_atlas(const std::vector<Image>& tiles, const CornerGrid& grid);

} // namespace tilepack
