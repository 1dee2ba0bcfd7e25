#include "tilepack/mip/normal_variance.h"

#include "tilepack/image/encoding.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace tilepack {

std::vector<RoughnessChannel> roughness_channels(const MapFormat& map, int channels) {
  std::vector<RoughnessChannel> list;
  const auto count = static_cast<std::size_t>(channels);
  if (map.role == Role::roughness)
    for (std::size_t c = 0; c < static_cast<std::size_t>(color_channels(channels)); ++c)
      list.push_back({c, false});
  for (std::size_t c = 0; c < std::min(count, map.contents.size()); ++c)
    if (map.contents[c] == ChannelContent::roughness || map.contents[c] == ChannelContent::gloss)
      list.push_back({c, map.contents[c] == ChannelContent::gloss});
  return list;
}

void add_normal_variance(Image& level, const Image& mean_normals,
                         std::span<const RoughnessChannel> channels) {
  // The mean of equal vectors misses length 1 by the rounding of floats alone.
  constexpr double rounding = 1e-6;
  for (int y = 0; y < level.height(); ++y)
    for (int x = 0; x < level.width(); ++x) {
      const auto n = mean_normals.texel(x, y);
      const double length = std::sqrt(static_cast<double>(n[0]) * n[0] + static_cast<double>(n[1]) * n[1] +
                                      static_cast<double>(n[2]) * n[2]);
      if (length > 1 - rounding) continue;
      const auto texel = level.texel(x, y);
      for (const auto& [c, gloss] : channels) {
        const double stored = static_cast<double>(texel[c]);
        const double r = gloss ? 1.0 - stored : stored;
        const double width_squared = r * r * r * r + 2 * (1 - length) / std::max(length, rounding);
        const double rougher = std::min(1.0, std::sqrt(std::sqrt(width_squared)));
        texel[c] = static_cast<float>(gloss ? 1.0 - rougher : rougher);
      }
    }
}

} // namespace tilepack
