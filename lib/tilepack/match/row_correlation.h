#pragma once

#include "tilepack/exemplar/feature_image.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace tilepack {

/// The channels of a feature image as planes of pairs: each value beside that of the texel to the east, 0
/// past the last. A product of two pairs, summed, is one vector instruction, so rows of texels can be laid at
/// many places side by side and correlated two texels at a time.
///
/// Places lie `stride` texels apart: the pairs at x, x + stride, x + 2 stride … follow one another.
class PairPlanes {
public:
  PairPlanes(const FeatureImage& image, int stride);

  /// In pairs, from `data()`.
  std::ptrdiff_t index(int channel, int x, int y) const {
    return (static_cast<std::ptrdiff_t>(channel) * height + y) * pitch + x % stride * columns + x / stride;
  }
  std::ptrdiff_t row_pitch() const { return pitch; }
  const std::int16_t* data() const { return values.data(); }

private:
  int height;
  int stride;
  std::ptrdiff_t columns; ///< pairs that follow one another
  std::ptrdiff_t pitch;
  std::vector<std::int16_t> values; ///< and slack, which vectors may read
};

/// Two neighbouring values of a row that is laid over the image.
struct PairTerm {
  std::ptrdiff_t index = 0; ///< of the pair of the image it meets at the first place
  std::int16_t first = 0;   ///< 0..255
  std::int16_t second = 0;  ///< 0 where the row ends with `first`
  bool operator==(const PairTerm&) const = default;
};

/// For i in 0..sums.size() - 1: the sum over all terms of their products with the pairs at data + index + i.
/// Exact.
void correlate_pairs(const std::int16_t* data, std::span<const PairTerm> terms, std::span<std::int64_t> sums);

} // namespace tilepack
