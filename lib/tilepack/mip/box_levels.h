#pragma once

#include "tilepack/tileset/material_map.h"

#include <vector>

namespace tilepack {

/// The levels of one tile of `map`, each a 2 × 2 box of the finer one (mip/downsample.h), from decoded values
/// (mip/level_values.h): levels 1 to `levels - 1`, at their place in the result, whose first image is empty.
/// Levels up to `encoded` come encoded as the tile is, and not yet rounded; coarser ones as they may be
/// averaged further. Means of unit vectors keep their length until they are encoded, else each level would
/// weigh its children differently from their area.
///
/// `levels`: 1 to level_count(tile.size()). All threads share the work on large tiles; the values don't
/// depend on their number.
std::vector<Image> box_levels(const Image& tile, const TileMap& map, int levels, int encoded);

} // namespace tilepack
