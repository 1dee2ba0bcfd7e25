#include "tilepack/mip/alpha_coverage.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>

namespace tilepack {
namespace {

template <typename F>
void for_each_alpha(std::vector<Image>& tiles, F&& f) {
  for (Image& tile : tiles) {
    const std::size_t channels = static_cast<std::size_t>(tile.channels());
    for (std::size_t i = channels - 1; i < tile.data().size(); i += channels) f(tile.data()[i]);
  }
}

} // namespace

double alpha_coverage(const std::vector<Image>& tiles, double threshold) {
  std::size_t opaque = 0;
  std::size_t texels = 0;
  for (const Image& tile : tiles) {
    const std::size_t channels = static_cast<std::size_t>(tile.channels());
    for (std::size_t i = channels - 1; i < tile.data().size(); i += channels, ++texels)
      opaque += static_cast<double>(tile.data()[i]) >= threshold;
  }
  return texels > 0 ? static_cast<double>(opaque) / static_cast<double>(texels) : 0;
}

void keep_alpha_coverage(std::vector<Image>& tiles, double threshold, double coverage) {
  std::vector<float> alphas;
  for_each_alpha(tiles, [&](float& alpha) { alphas.push_back(alpha); });
  const double wanted = coverage * static_cast<double>(alphas.size());
  const std::size_t opaque = static_cast<std::size_t>(std::lround(wanted));
  if (opaque == 0 || opaque >= alphas.size()) return;
  // The factor must lift the smallest of the `opaque` largest alphas to the threshold. Halfway to the next
  // smaller one, rounding to any depth can't tip it over.
  std::nth_element(alphas.begin(), alphas.begin() + static_cast<std::ptrdiff_t>(opaque) - 1, alphas.end(),
                   std::greater<>());
  const float smallest_in = alphas[opaque - 1];
  const float largest_out =
      *std::max_element(alphas.begin() + static_cast<std::ptrdiff_t>(opaque), alphas.end());
  const float middle = smallest_in - (smallest_in - largest_out) * 0.5f;
  if (!(middle > 0.0f)) return;
  const float factor = static_cast<float>(threshold) / middle;
  for_each_alpha(tiles, [&](float& alpha) { alpha = std::clamp(alpha * factor, 0.0f, 1.0f); });
}

} // namespace tilepack
