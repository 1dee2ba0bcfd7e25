#pragma once

#include "tilepack/layout/layout.h"

#include <vector>

namespace tilepack {

/// Sides of the texture of a rotated layout.
struct RotatedTexture {
  int tile_side = 0; ///< texels of level 0
  int gutter = 0;    ///< texels round each tile, 0..tile_side
  bool power_of_two = false;
};

/// The smallest texture that holds the tiles of `scheme` no smaller than they are, in texels of level 0:
/// whole sides, so stored tiles are up to a texel larger; powers of two if asked. Throws Error (usage) for
/// numbers out of range or a side over limits::longest_texture_side.
Size rotated_texture_size(const RotatedScheme& scheme, const RotatedTexture& texture);

/// Tile number arrangement[site] on each site of the scheme (see RotatedLattice). Every tile of
/// 0..arrangement.size()-1 must stand there once.
Layout rotated_layout(const RotatedScheme& scheme, const RotatedTexture& texture,
                      const std::vector<int>& arrangement);

} // namespace tilepack
