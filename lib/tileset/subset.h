#pragma once

#include "tilepack/tileset/tile_set.h"

namespace tilepack {

/// The tiles of `set`, complete and in the order of their colors, that have the colors of `wanted`, in the
/// order of `wanted`: ids change. Throws Error (internal) if the coloring or a color is another.
TileSet subset(const TileSet& set, const TileColors& wanted);

} // namespace tilepack
