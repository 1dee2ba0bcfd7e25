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

/// Corner colors reach 255 before two pairs share a number: far past what a pack may have, so that a broken
/// one is read as it is.
inline constexpr int border_number_base = 256;

BorderColors borders_of(const EdgeTile& tile);

/// A side's number is first · base + second, its ends read from west to east or from north to south,
/// whichever tile they are seen from. With the number of colors as `base` sides count from 0 without gaps.
BorderColors borders_of(const CornerTile& tile, int base = border_number_base);

/// By tile id.
std::vector<BorderColors> border_colors(const TileColors& tiles);

} // namespace tilepack
