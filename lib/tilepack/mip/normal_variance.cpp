#include "tilepack/mip/normal_variance.h"

#include "tilepack/image/encoding.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace tilepack {

void add_normal_variance(Image& roughness, const Image& mean_normals) {
  // The mean of equal vectors misses length 1 by the rounding of floats alone.
  constexpr double rounding = 1e-6;
  const auto values = static_cast<std::size_t>(color_channels(roughness.channels()));
  for (int y = 0; y < roughness.height(); ++y)
    for (int x = 0; x < roughness.width(); ++x) {
      const auto n = mean_normals.texel(x, y);
      const double length = std::sqrt(static_cast<double>(n[0]) * n[0] + static_cast<double>(n[1]) * n[1] +
                                      static_cast<double>(n[2]) * n[2]);
      if (length > 1 - rounding) continue;
      const auto texel = roughness.texel(x, y);
      for (std::size_t c = 0; c < values; ++c) {
        const double r = static_cast<double>(texel[c]);
        const double width_squared = r * r * r * r + 2 * (1 - length) / std::max(length, rounding);
        texel[c] = static_cast<float>(std::min(1.0, std::sqrt(std::sqrt(width_squared))));
      }
    }
}

} // namespace tilepack
