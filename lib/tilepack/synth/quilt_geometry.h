#pragma once

#include "tilepack/seam/path_cut.h"
#include "tilepack/tileset/source_map.h"

#include <vector>

namespace tilepack {

/// Where the parts of a quilted tile lie (see EdgePatches for the drawing).
///
/// A tile has four quadrants. In each, rows count from the horizontal edge and columns from the vertical edge
/// towards the centre, so all four look alike: the vertical edge's patch lies before the cut, the horizontal
/// edge's patch after it.
class QuiltGeometry {
public:
  /// `guard`: texels along each edge that belong to its own patch, at least 1.
  QuiltGeometry(Size tile_size, int guard_width);

  static constexpr int quadrants = 4; ///< 0 north-west, 1 north-east, 2 south-west, 3 south-east
  static bool lower(int quadrant) { return quadrant >= 2; }
  static bool right(int quadrant) { return quadrant % 2 == 1; }

  int rows(int quadrant) const { return lower(quadrant) ? tile.height - centre_y : centre_y; }
  int columns(int quadrant) const { return right(quadrant) ? tile.width - centre_x : centre_x; }

  /// The texel of the tile at (row, column) of a quadrant.
  SourceTexel texel(int quadrant, int row, int column) const {
    return {right(quadrant) ? tile.width - 1 - column : column,
            lower(quadrant) ? tile.height - 1 - row : row};
  }

  /// The texel of its window that the horizontal or vertical edge's patch has at a texel of the tile.
  SourceTexel in_horizontal_window(int quadrant, SourceTexel at) const {
    return {at.x, at.y + tile.height - centre_y - (lower(quadrant) ? tile.height : 0)};
  }
  SourceTexel in_vertical_window(int quadrant, SourceTexel at) const {
    return {at.x + tile.width - centre_x - (right(quadrant) ? tile.width : 0), at.y};
  }

  /// Where the cut may cross each row: a band about the diagonal that keeps off the guard.
  std::vector<CutRange> allowed(int quadrant) const;

  Size tile;
  int guard;
  int centre_x;
  int centre_y;
};

} // namespace tilepack
