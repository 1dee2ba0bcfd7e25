#pragma once

#include "tilepack/tileset/tile_set.h"

#include <string_view>
#include <vector>

namespace tilepack {

/// What is done to the border texels of coarser levels, where tiles of one edge color no longer agree.
/// [Gems2, 12.5]
enum class MipMode {
  none,    ///< level 0 only
  box,     ///< nothing
  edges,   ///< border texels averaged over all tiles that share the edge color, corner texels left alone
  corners, ///< the four corner texels too: over all tiles for edge coloring, per color for corner coloring
  least_squares, ///< border texels that minimise the expected error over random neighbours
};

std::string_view name_of(MipMode mode); ///< "none", "box", "edges", "corners", "least-squares"

struct MipOptions {
  MipMode mode = MipMode::edges;
};

/// Number of levels of a tile, level 0 counted: halved as long as both sides are even; a 128² tile has 8
/// (down to one texel), a 96 × 64 tile 6 (down to 3 × 2).
int level_count(Size tile_size);

/// The size of a tile at `level`: each side divided by 2^level.
Size level_size(Size tile_size, int level);

/// The levels of map number `map` of `set`, level 0 (as it is) first, each a TileMap of smaller tiles.
///
/// Each level is a 2 × 2 box of the finer one *before* sanitizing and within one tile, in linear light for
/// color (weighted by alpha), as vectors for normals; the values returned are encoded as level 0 is, not yet
/// rounded.
std::vector<TileMap> mip_chain(const TileSet& set, int map, const MipOptions& options);

} // namespace tilepack
