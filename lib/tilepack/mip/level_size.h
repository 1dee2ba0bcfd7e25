#pragma once

#include "tilepack/image/image.h"

namespace tilepack {

/// Number of levels of a tile, level 0 counted: halved as long as both sides are even; a 128² tile has 8
/// (down to one texel), a 96 × 64 tile 6 (down to 3 × 2).
int level_count(Size tile_size);

/// The size of a tile at `level`: each side divided by 2^level.
Size level_size(Size tile_size, int level);

/// Whether `level` needs no sanitizing under a guard band of `guard` texels: level 0, and those with
/// 2^level <= guard. There the border texels of width guard >> level are boxes of guarded texels alone, hence
/// equal in all tiles of a color by themselves, and what bilinear filtering reads across a border is exact.
bool exact_through_guard(int guard, int level);

} // namespace tilepack
