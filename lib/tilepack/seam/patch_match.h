#pragma once

#include "tilepack/exemplar/contrast_rank.h"
#include "tilepack/seam/source_canvas.h"

#include <cstdint>
#include <vector>

namespace tilepack {

struct PatchMatchOptions {
  std::uint64_t seed = 0;
  int passes = 5; ///< of search and vote; 0: nothing is changed
  int sweeps = 5; ///< over the canvas in the search of each pass
  int reach = 8;  ///< texels (of the image searched) this far from a seam may change
  /// At f, a match in a part of the sample that is shown as often as the average counts 1 + f times as unlike.
  double reuse_weight = 0.0;
  /// At p, a match in the part of the sample with the least contrast counts 1 + p times as unlike, one of middle
  /// contrast 1 + p / 2 times (see ContrastRanks).
  double contrast_weight = 0.0;
  int seam_threshold = 64; ///< seams of which a texel's share (seams_at_texels) is no more are left alone
};

/// What is matched against what.
struct PatchMatchInput {
  const FeatureImage& image;              ///< the sample at 1 / scale of its size
  const ContrastRanks& ranks;             ///< of the image; not looked at without a contrast_weight
  int scale = 1;                          ///< 1 or 2
  const std::vector<std::uint8_t>& fixed; ///< of a canvas's texels, row by row: 1 if it must stay
  Rect counted;                           ///< the part of a canvas whose uses of the sample are counted
};

/// Makes the surroundings of seams look like the sample patch by patch: PatchMatch and voting.
///
/// For each square of 7 × 7 texels near a seam a like one is searched in the sample, by propagation from
/// neighbours and random search [Barnes09]. Then each texel is replaced by a vote of the squares that hold it
/// [Wexler07, Kwatra05]: by the one among those which their matches propose that is nearest to the mean of all.
/// Texels are chosen, never averaged, so they stay verbatim. Both steps are repeated.
///
/// Squares of low contrast are like much else and would be found too often: without
/// PatchMatchOptions::contrast_weight there would be less contrast round seams than in the sample.
///
/// All canvases of a set, which are of one size, are worked on together, pass by pass: before each pass it is
/// counted how often they show each part of the sample, so that the next search can turn to what they don't
/// show (see PatchMatchOptions::reuse_weight) without all of them turning to the same.
///
/// At half size (scale 2) a square sees twice as far; what changes there is brought back as squares of 2 × 2
/// texels, so that a call at full size should follow. Nothing is done where the image or a canvas, at this scale,
/// holds no square. Deterministic for any number of threads.
void match_and_vote(const PatchMatchInput& input, const PatchMatchOptions& options,
                    std::vector<SourceCanvas>& canvases);

} // namespace tilepack
