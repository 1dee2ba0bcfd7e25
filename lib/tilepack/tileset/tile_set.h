#pragma once

#include "tilepack/tileset/material_map.h"
#include "tilepack/tileset/tile_colors.h"

#include <vector>

namespace tilepack {

/// Tiles with their colors and their images, before they are laid out: what synthesis makes, or what was
/// drawn by hand.
struct TileSet {
  Size tile_size;            ///< texels
  ColorCounts colors;        ///<
  TileColors tiles;          ///< id → colors
  std::vector<TileMap> maps; ///< at least one; each holds tile_count(tiles) images of tile_size
  int guard = 0; ///< texels on either side of an edge that all tiles of its color share (0: not promised)
};

} // namespace tilepack
