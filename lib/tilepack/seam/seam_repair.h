#pragma once

#include "tilepack/exemplar/feature_pyramid.h"
#include "tilepack/match/patch_search.h"
#include "tilepack/match/period_alignment.h"
#include "tilepack/match/use_counts.h"
#include "tilepack/seam/source_canvas.h"

#include <vector>

namespace tilepack {

struct SeamRepairOptions {
  int spots = 12;         ///< places mended in a canvas
  int window = 28;        ///< side of the square of new material, texels
  int tries = 2;          ///< windows of the sample tried at each
  double freshness = 4.0; ///< at f, a window shown as often as the average counts 1 + f times as unlike
};

/// Re-places what joins worst: again and again the square with the highest seam costs is looked up in the
/// whole sample, and the windows most like what it shows now, other than those it is made of, are laid over
/// it along best cuts. The seam energy never rises.
///
/// `pyramid[0]` is the sample; `search` searches the last level. `fixed`: texels that must stay, 1 each.
/// `phase`: what must be kept in step with the sample, seen from the canvas's north-west texel.
/// `usage`: what the set shows of the last level, prepared; of one that counts nothing any window is fresh.
void replace_worst_patches(const FeaturePyramid& pyramid, const PatchSearch& search, const UseCounts& usage,
                           const PeriodAlignment& phase, const std::vector<std::uint8_t>& fixed,
                           const SeamRepairOptions& options, SourceCanvas& canvas);

} // namespace tilepack
