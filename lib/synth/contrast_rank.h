#pragma once

#include "tilepack/image/image.h"
#include "tilepack/synth/feature_image.h"

#include <cstdint>
#include <vector>

namespace tilepack {

/// How lively each part of a sample is among all its parts.
///
/// The most like patch of a sample is often a calm one: it is near to everything, as a mean is. A choice by
/// likeness alone therefore shows calm parts more often than the sample does, and what it mends looks washed
/// out. With ranks it can pay for that, whatever the sample's contrast and however that is distributed.
struct ContrastRanks {
  static constexpr int highest = 64;

  int square = 1; ///< each rank holds for so many texels a side
  int wide = 0;   ///< squares in a row; what is left of a row or column at its end is a square too
  int high = 0;
  std::vector<std::uint8_t> ranks; ///< 0 for the calmest square .. highest - 1 for the liveliest

  int at(int square_x, int square_y) const {
    return ranks[static_cast<std::size_t>(square_y) * static_cast<std::size_t>(wide) +
                 static_cast<std::size_t>(square_x)];
  }
};

/// By the variance, summed over the channels, of the 7 × 7 texels round the middle of each square (fewer at
/// the image's border). Squares of one variance have one rank. `square` is at least 1.
ContrastRanks contrast_ranks(const FeatureImage& image, int square);

} // namespace tilepack
