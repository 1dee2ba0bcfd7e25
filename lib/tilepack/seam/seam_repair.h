#pragma once

#include "tilepack/exemplar/feature_pyramid.h"
#include "tilepack/match/patch_search.h"
#include "tilepack/match/period_alignment.h"
#include "tilepack/match/use_counts.h"
#include "tilepack/seam/source_canvas.h"

#include <vector>

namespace tilepack {

struct SeamRepairOptions {
  int patches = 12; ///< replaced in a canvas, the worst first; 0: none
  /// Side of the square of new material, texels, where the last level is a fourth of the first or larger; where it is
  /// smaller, what the sample shows is larger, and the square in proportion.
  int window = 28;
  int tries = 2;             ///< windows of the sample laid at each
  double reuse_weight = 4.0; ///< at f, a window shown as often as the average counts 1 + f times as unlike
};

/// What is repaired from what.
struct SeamRepairInput {
  const FeaturePyramid& pyramid; ///< of the sample; canvases are at the scale of its first level
  const PatchSearch& search;     ///< of its last level
  const UseTable& uses; ///< what the set shows of the last level; where it shows nothing, all is fresh
  const PeriodAlignment& alignment;       ///< what must be kept, seen from the canvas's north-west texel
  const std::vector<std::uint8_t>& fixed; ///< of a canvas's texels, row by row: 1 if it must stay
};

/// Replaces what joins worst, as in the seam repair of [Kwatra03]: again and again the square with the
/// highest seam costs is looked up in the whole sample, and the windows most like what it shows now, other than
/// those it is made of, are laid over it along best cuts (lay_patch). The seam energy never rises.
void replace_worst_patches(const SeamRepairInput& input, const SeamRepairOptions& options,
                           SourceCanvas& canvas);

} // namespace tilepack
