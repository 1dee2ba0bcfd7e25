#pragma once

#include "tilepack/layout/layout.h"
#include "tilepack/mip/level_size.h"
#include "tilepack/mip/mip_mode.h"
#include "tilepack/tileset/tile_set.h"

#include <vector>

namespace tilepack {

/// The levels of map number `map` of `set`, level 0 (as it is) first, each a TileMap of smaller tiles.
///
/// Each level is a 2 × 2 box of the finer one *before* sanitizing and within one tile: of linear light
/// weighted by alpha for color and emissive, of vectors for normals (3 or 4 channels: the first three are the
/// vector, renormalised), of the values as they are for the rest. Roughness, also in a channel of a packed map,
/// then takes up what the set's first normal map loses (mip/normal_variance.h). Levels past the guard band are then
/// sanitized as `options` says (mip/shared_border.h tells what becomes equal). The values returned are
/// encoded as level 0 is, and not yet rounded; texels made equal are equal in every bit. The result does not
/// depend on the number of threads.
std::vector<TileMap> mip_chain(const TileSet& set, int map, const MipOptions& options,
                               const Layout* layout = nullptr);

/// The same without level 0, which saves copying it.
std::vector<TileMap> coarser_levels(const TileSet& set, int map, const MipOptions& options,
                                    const Layout* layout = nullptr);

} // namespace tilepack
