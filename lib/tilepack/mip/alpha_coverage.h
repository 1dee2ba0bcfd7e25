#pragma once

#include "tilepack/image/image.h"

#include <vector>

namespace tilepack {

/// The share of texels whose alpha (the last channel) is at least `threshold`, over all tiles, 0 to 1.
double alpha_coverage(const std::vector<Image>& tiles, double threshold);

/// Scales the alpha of a level so that its coverage is `coverage`, as near as its texels allow: cut-out
/// leaves keep their mass with distance instead of thinning out. One factor for all tiles, so texels that
/// were equal stay equal, in every bit. Nothing changes where coverage is 0 or 1, or if no factor gives it:
/// all that must be opaque is clear.
void keep_alpha_coverage(std::vector<Image>& tiles, double threshold, double coverage);

} // namespace tilepack
