#pragma once

#include "tilepack/image/image.h"
#include "tilepack/seam/source_canvas.h"

#include <cstdint>
#include <vector>

namespace tilepack {

/// What laying a patch may do with a texel.
enum class CutConstraint : std::uint8_t {
  keep,     ///< it stays as it is
  free,     ///< the cut decides
  unbiased, ///< the cut decides, and `bias` is not paid
  take,     ///< it takes the new material
};

/// New material laid over part of a canvas: texel (x, y) of the canvas would show sample texel origin + (x,
/// y).
struct LaidPatch {
  Rect area;                              ///< of the canvas
  SourceTexel origin;                     ///< may lie outside the sample as long as `area` does not
  std::vector<CutConstraint> constraints; ///< one a texel of `area`, row by row
};

/// Lays new material over a canvas along the best cut: among all ways to keep or take the free texels of the
/// area the one with the least seam energy, found as a minimum cut of a graph with one node a free texel
/// [Kwatra03]. Seams that exist already are counted, and disappear where both sides take.
///
/// Unless texels are forced to `take`, the seam energy of the canvas should not rise; by half a hundredth it was seen to,
/// in drawn bricks, and who relies on it looks (seam_repair). Where an old seam costs
/// more than the two ways to cut through it (squared differences are no metric), these two are priced up
/// until the graph can hold them [Kwatra03, 3.1]; the result is then still no worse than the start, but may
/// not be the least.
///
/// `bias` is paid for each free texel that keeps, so that cuts of like cost leave more new material.
/// Returns whether any texel changed.
bool lay_patch(const FeatureImage& image, SourceCanvas& canvas, const LaidPatch& patch,
               std::int64_t bias = 0);

} // namespace tilepack
