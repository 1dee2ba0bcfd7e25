#pragma once

#include "tilepack/image/image.h"
#include "tilepack/tileset/tile_colors.h"

#include <string_view>
#include <vector>

namespace tilepack {

enum class LayoutKind { tile_index, de_bruijn, rotated, array };

/// As in pack.json and options: "tile-index", "de-bruijn", "rotated", "array".
std::string_view name_of(LayoutKind kind);

/// Where a tile sits in a grid of equal cells.
struct Cell {
  int tile = 0;   ///< id
  int column = 0; ///< 0..columns-1, from the west
  int row = 0;    ///< 0..rows-1, from the north
  bool operator==(const Cell&) const = default;
};

/// The places of all tiles in one texture, each tile once. The texture wraps at its borders.
struct Layout {
  LayoutKind kind = LayoutKind::tile_index;
  int columns = 0;
  int rows = 0;
  std::vector<Cell> cells; ///< in the order of the tiles' ids
  bool operator==(const Layout&) const = default;
};

/// All tiles of one level placed as `layout` says: an image of columns × rows tiles.
Image atlas(const std::vector<Image>& tiles, const Layout& layout);

/// Inverse of atlas: the tiles by id, cut out of `image`, whose size must be a multiple of the grid.
std::vector<Image> tiles_of(const Image& image, const Layout& layout);

} // namespace tilepack
