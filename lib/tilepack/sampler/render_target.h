#pragma once

#include "tilepack/image/encoding.h"

#include <cstddef>
#include <span>

namespace tilepack {

/// How rendered values are to be stored.
struct RenderTarget {
  Encoding encoding = Encoding::srgb;
  Depth depth = Depth::u8;
};

/// A pixel as the target stores it: encoded but for alpha, and rounded. `out` has the length of `linear`, 1..4.
inline void store_pixel(std::span<const double> linear, const RenderTarget& target, std::span<float> out) {
  const auto encoded = static_cast<std::size_t>(
      target.encoding == Encoding::srgb ? color_channels(static_cast<int>(linear.size())) : 0);
  for (std::size_t c = 0; c < linear.size(); ++c) {
    const double value = c < encoded ? linear_to_srgb(linear[c]) : linear[c];
    out[c] = quantised(static_cast<float>(value), target.depth);
  }
}

} // namespace tilepack
