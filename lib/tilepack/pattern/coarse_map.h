#pragma once

#include "tilepack/pattern/texture_runs.h"

#include <cstddef>
#include <vector>

namespace tilepack {

/// An explicit coarse map of a texture: a texel a cell of a grid, and its mips. What pixels are filtered from that cover
/// several cells, where the scene is small enough to be held so.   [LN03, section 5.1, second solution]
class CoarseMap {
public:
  /// Evaluates `texture` once for all cells, 2 x 2 samples each, with all threads there are.
  CoarseMap(const TextureRuns& runs, NodeId texture, int map, PatternGrid scene, PatternGrid grid, Size unit);

  /// Adds the value of a pixel `width` cells wide at a place of the grid (cells and fractions) to sums of value * cover
  /// (`value`) and of cover, both weighed. The grid wraps.
  void add(TileCoordinate x, TileCoordinate y, double width, double weight, std::array<double, 4>& value,
           double& cover) const;

  std::size_t bytes() const;

private:
  struct Level {
    Size size;
    std::vector<std::array<float, 5>> texels; ///< value * cover, then cover
  };
  std::vector<Level> levels;
};

} // namespace tilepack
