#pragma once

#include "tilepack/exemplar/feature_image.h"

#include <cstdint>
#include <vector>

namespace tilepack {

/// How much contrast each part of a sample has among all its parts.
///
/// The patch of a sample most like another is often one of low contrast: it is near to everything, as a mean
/// is. A choice by likeness alone therefore shows such parts more often than the sample does, and what it
/// repairs looks washed out. With ranks it can pay for that, whatever the sample's contrast and however that
/// is distributed.
struct ContrastRanks {
  static constexpr int count = 64;

  int square = 1; ///< each rank holds for so many texels a side
  int wide = 0;   ///< squares in a row; what is left of a row or column at its end is a square too
  int high = 0;
  std::vector<std::uint8_t> ranks; ///< 0 for the square of least contrast .. count - 1 for that of most

  /// Of the square round a texel.
  int at(int x, int y) const {
    return ranks[static_cast<std::size_t>(y / square) * static_cast<std::size_t>(wide) +
                 static_cast<std::size_t>(x / square)];
  }
};

/// By the variance, summed over the channels, of the 7 × 7 texels round the middle of each square (fewer at
/// the image's border). Squares of one variance have one rank. They are as small as can be, a power of two
/// texels wide, with about 16 000 of them at most.
ContrastRanks contrast_ranks(const FeatureImage& image);

} // namespace tilepack
