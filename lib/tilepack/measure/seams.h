#pragma once

#include "tilepack/check/tile_border.h"
#include "tilepack/pack/pack.h"

#include <cstdint>
#include <vector>

namespace tilepack {

/// How visible the border between two tiles is that may lie side by side. Steps are mean absolute differences
/// of neighbouring texels, over channels, in stored values; both ratios are to the mean step between
/// neighbouring columns (rows, for a south border) inside the two tiles. 1 can't be told from the inside,
/// more is an edge, less is a blur.
struct BorderStep {
  int tile = 0;
  Side side = Side::east; ///< east or south
  int neighbour = 0;      ///< the tile beyond
  double ratio = 0;       ///< of the whole border
  double window = 0;      ///< of its worst run of seam_window texels
  int window_at = 0;      ///< where that run begins, from the north or west end
};

inline constexpr int seam_window = 8;

struct SeamFigures {
  std::int64_t pairs = 0;        ///< of tiles that may be neighbours, east and south counted apart
  double seam = 1;               ///< mean step across all their borders over the mean step inside all tiles
  std::vector<BorderStep> worst; ///< by `window`, falling; ties by tile, side, neighbour
};

/// Figures of one level of one map, which must be there and of the right size; `list` is the length of
/// `worst`. Tiles that are flat inside have ratio 1 where the border is flat too, else 1e6.
SeamFigures seam_figures(const Pack& pack, int map, int level, int list);

} // namespace tilepack
