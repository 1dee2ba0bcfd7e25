#pragma once

#include "tilepack/tileset/tile_colors.h"

#include <vector>

namespace tilepack {

/// The small set for filling row by row: two tiles for each pair of a north and a west color, 2 · Kh · Kv in
/// all, so that there is a choice in every cell but none of the (Kh · Kv)² tiles of a complete set more than
/// needed.   [Cohen03]
///
/// The two tiles of (n, w) are (south, east) = (n, w) and (n + 1 mod Kh, w + 1 mod Kv): over the set each
/// color occurs as often on every side, so the set can fill a torus. Ids in lexicographic order of (north,
/// west, choice). It goes with an index map only: which tile lies in a cell depends on the cells before it.
///
/// Colors 1..8 (Error, usage); one color of both kinds gives the same tile twice, so at least one of them
/// is 2.
std::vector<EdgeTile> sequential_edge_set(int horizontal_colors, int vertical_colors);

} // namespace tilepack
