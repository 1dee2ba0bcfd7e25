#pragma once

#include "tilepack/tileset/tile_colors.h"

#include <array>
#include <vector>

namespace tilepack {

/// What a tile's borders must agree on, as one number a side and a corner, whatever the coloring: two tiles
/// fit at a side if the facing sides have the same key, and can lie diagonally across a lattice point if the
/// facing corners have.
///
/// Edge coloring: a side's key is its edge color; corners all have key 0, since any tile can lie diagonally
/// across. Corner coloring: a corner's key is its color; a side's is the ordered pair of the colors at its
/// ends, west to east or north to south.
struct BorderKeys {
  enum Side { north, east, south, west };
  enum Corner { nw, ne, sw, se };
  std::array<int, 4> sides{};
  std::array<int, 4> corners{};
};

/// In the order of the tiles' ids.
std::vector<BorderKeys> border_keys(const TileColors& tiles);

} // namespace tilepack
