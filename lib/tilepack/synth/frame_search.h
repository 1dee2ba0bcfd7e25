#pragma once

#include "tilepack/error/progress.h"
#include "tilepack/exemplar/feature_pyramid.h"
#include "tilepack/exemplar/sample_analysis.h"
#include "tilepack/match/patch_search.h"
#include "tilepack/synth/frame.h"

#include <vector>

namespace tilepack {

/// How thoroughly a frame is looked for.
struct FrameSearchOptions {
  std::uint64_t seed = 0;
  int starts = 8;         ///< random choices of corner patches
  int candidates = 12;    ///< places considered for each strip
  int rounds = 3;         ///< passes over all strips
  double evenness = 2;    ///< weight of a strip's deviation from the sample's mean color
  double calmness = 4;    ///< weight of a strip's step across its edge being other than usual
  double caution = 1.0;   ///< a strip that shows a part that deviates by striking_deviation + d (see
                          ///< Saliency) fits 1 + caution · d times as badly
  double likeness = 1500; ///< weight of the distance between all strips together and the sample's statistics
};

/// Chooses the whole frame together.
///
/// The choice is made in the last level of `pyramid`, which `search` searches, and brought to the first. For
/// each start the strips' best places by their fit to the corner patches are listed; then one strip after
/// another takes the place that makes the sum over all tiles least of
///   the misfit of its ends, and
///   the misfit of the best inside that a tile with these four strips could get.
/// The second is a sum of four maps, one a side, over positions of the inside, so that trying another place
/// for a strip costs two maps and a few additions.
FrameSources searched_frame(const FeaturePyramid& pyramid, const PatchSearch& search,
                            const SampleAnalysis& sample, const FrameShape& shape,
                            const FrameSearchOptions& options, const Progress& progress = {});

} // namespace tilepack
