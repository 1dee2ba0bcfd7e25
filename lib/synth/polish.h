#pragma once

#include "tilepack/synth/source_canvas.h"

#include <cstdint>
#include <vector>

namespace tilepack {

struct PolishOptions {
  std::uint64_t seed = 0; ///< a different one for each canvas
  int passes = 2;         ///< look-up and vote this many times
  int sweeps = 3;         ///< sweeps of the look-up in each pass
  int reach = 8;          ///< texels this far from a seam may change
  double doubt = 500; ///< mean squared difference (a channel of a texel) at which a match counts half as much
                      ///< as an exact one
  int seam_threshold = 64; ///< seams that cost no more are left alone
};

/// Makes the surroundings of seams look like the sample patch by patch: for each square of 7 × 7 texels near
/// a seam a like one is looked up in the sample (by propagation from neighbours and random trials), and each
/// texel is replaced by the one, among those its squares propose, that is nearest to their weighted mean.
/// Texels are chosen, never averaged, so they stay verbatim.
///
/// `fixed`: texels that must stay, 1 each.
void polish(const FeatureImage& image, const std::vector<std::uint8_t>& fixed, const PolishOptions& options,
            SourceCanvas& canvas);

/// The same at half size, where a square sees twice as far: `half_image` is the sample halved. What changes
/// there is brought back as squares of 2 × 2 texels, which want polishing at full size next.
void polish_at_half_size(const FeatureImage& half_image, const std::vector<std::uint8_t>& fixed,
                         const PolishOptions& options, SourceCanvas& canvas);

} // namespace tilepack
