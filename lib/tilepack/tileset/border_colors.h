#pragma once

#include "tilepack/tileset/tile_colors.h"

#include <vector>

namespace tilepack {

/// What decides whether two tiles fit side by side, one number a side for either coloring: an edge's color,
/// or for corner coloring the pair of colors at its ends. Tiles fit if the east number of one is the west
/// number of the other, or the south number of one the north number of the other.
struct BorderColors {
  int north = 0;
  int east = 0;
  int south = 0;
  int west = 0;
  bool operator==(const BorderColors&) const = default;
};

/// By tile id.
std::vector<BorderColors> border_colors(const TileColors& tiles);

} // namespace tilepack
