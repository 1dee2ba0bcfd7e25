#include "tilepack/pattern/height_blend.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace tilepack {

void height_weights(std::span<const double> coverage, std::span<const double> height, double relief,
                    double softness, std::span<double> weights) {
  double highest = 0, covered = 0;
  for (std::size_t i = 0; i < coverage.size(); ++i) {
    weights[i] = coverage[i] > 0 ? coverage[i] + relief * std::clamp(height[i], 0.0, 1.0) : 0.0;
    highest = std::max(highest, weights[i]);
    covered += coverage[i];
  }
  double sum = 0;
  for (double& weight : weights) {
    weight = std::max(0.0, weight - (highest - softness * covered));
    sum += weight;
  }
  for (double& weight : weights) weight = sum > 0 ? weight / sum : 0.0;
}

void SlopeSum::add(std::span<const double> stored, double weight) {
  constexpr double flattest = 1.0 / 64;
  const double z = std::max(2 * stored[2] - 1, flattest);
  x += weight * (2 * stored[0] - 1) / z;
  y += weight * (2 * stored[1] - 1) / z;
}

void SlopeSum::resolve(std::span<double> stored) const {
  const double length = std::sqrt(x * x + y * y + 1);
  stored[0] = 0.5 + 0.5 * x / length;
  stored[1] = 0.5 + 0.5 * y / length;
  stored[2] = 0.5 + 0.5 / length;
}

} // namespace tilepack
