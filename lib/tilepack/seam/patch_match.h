#pragma once

#include "tilepack/exemplar/contrast_rank.h"
#include "tilepack/seam/source_canvas.h"

#include <cstdint>
#include <vector>

namespace tilepack {

struct PatchMatchOptions {
  std::uint64_t seed = 0;
  int passes = 5;         ///< look-up and vote this many times
  int sweeps = 5;         ///< sweeps of the look-up in each pass
  int reach = 8;          ///< texels this far from a seam may change
  double freshness = 0.0; ///< at f, a match in a part of the sample that is shown as often as the average
                          ///< counts 1 + f times as unlike
  double contrast_weight =
      0.0;                 ///< at p, a match in the calmest part of the sample counts 1 + p times as unlike,
                           ///< one of middle contrast 1 + p / 2 times (see ContrastRanks)
  int seam_threshold = 64; ///< seams that cost no more are left alone
};

/// Makes the surroundings of seams look like the sample patch by patch: for each square of 7 × 7 texels near
/// a seam a like one is looked up in the sample (by propagation from neighbours and random trials), and each
/// texel is replaced by the one, among those its squares propose, that is nearest to their mean.
/// Texels are chosen, never averaged, so they stay verbatim.
///
/// What is calm is like much else and would be found too often: without PatchMatchOptions::contrast_weight there would
/// be less contrast round seams than in the sample.
///
/// All canvases of a set, which are of one size, are polished together, pass by pass: before each pass it is
/// counted how often they show each part of the sample, so that the next look-up can turn to what they don't
/// show (see PatchMatchOptions::freshness) without all of them turning to the same.
///
/// `image` is the sample at 1 / scale of its size (scale 1 or 2), `ranks` are its contrast ranks (not looked
/// at without a contrast_weight). At half size a square sees twice as far; what changes there is brought back as
/// squares of 2 × 2 texels, which want polishing at full size next. `fixed`: texels of a canvas that must
/// stay, 1 each. `shown`: the part of a canvas that is counted.
void match_and_vote(const FeatureImage& image, const ContrastRanks& ranks, int scale,
                    const std::vector<std::uint8_t>& fixed, Rect shown, const PatchMatchOptions& options,
                    std::vector<SourceCanvas>& canvases);

} // namespace tilepack
