#include "tilepack/image/resample.h"

#include "tilepack/numeric/exact_math.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace tilepack {
namespace {

constexpr int most_taps = 6;
constexpr double pi = 3.14159265358979323846;

double sinc(double x) {
  if (x == 0.0) return 1.0;
  const double nearest = std::floor(x + 0.5);
  const double sine = exact_sine_of_half_turns(x - nearest);
  return (std::fmod(nearest, 2.0) == 0.0 ? sine : -sine) / (pi * x);
}

double catmull_rom(double x) {
  if (x < 1.0) return (1.5 * x - 2.5) * x * x + 1.0;
  return ((-0.5 * x + 2.5) * x - 4.0) * x + 2.0;
}

double kernel(ResampleFilter filter, double distance) {
  const double x = std::fabs(distance);
  if (x >= filter_reach(filter)) return 0.0;
  switch (filter) {
  case ResampleFilter::bilinear:
    return 1.0 - x;
  case ResampleFilter::bicubic:
    return catmull_rom(x);
  case ResampleFilter::lanczos:
    break;
  }
  return sinc(x) * sinc(x / 3.0);
}

struct AxisTaps {
  int count = 0;
  std::array<int, most_taps> texel{};
  std::array<double, most_taps> weight{};
};

AxisTaps taps(double position, int side, ResampleFilter filter) {
  const int reach = filter_reach(filter);
  const double centre = std::clamp(position, -0.5 - reach, side + 0.5 + reach) - 0.5;
  const int first = static_cast<int>(std::floor(centre)) - reach + 1;
  AxisTaps result;
  result.count = 2 * reach;
  double sum = 0;
  for (int i = 0; i < result.count; ++i) {
    const auto at = static_cast<std::size_t>(i);
    result.texel[at] = std::clamp(first + i, 0, side - 1);
    result.weight[at] = kernel(filter, centre - (first + i));
    sum += result.weight[at];
  }
  for (double& w : result.weight) w /= sum; // the Lanczos kernel's sum strays from 1 by up to a percent
  return result;
}

} // namespace

int filter_reach(ResampleFilter filter) {
  switch (filter) {
  case ResampleFilter::bilinear:
    return 1;
  case ResampleFilter::bicubic:
    return 2;
  case ResampleFilter::lanczos:
    break;
  }
  return 3;
}

void resample(const Image& image, double x, double y, ResampleFilter filter, std::span<double> out) {
  const AxisTaps across = taps(x, image.width(), filter);
  const AxisTaps down = taps(y, image.height(), filter);
  // Differences from one of the texels are summed, not values: equal texels then add exact zeros.
  const auto middle = static_cast<std::size_t>(filter_reach(filter) - 1);
  const auto base = image.texel(across.texel[middle], down.texel[middle]);
  for (std::size_t c = 0; c < out.size(); ++c) out[c] = 0.0;
  for (int j = 0; j < down.count; ++j)
    for (int i = 0; i < across.count; ++i) {
      const double weight =
          across.weight[static_cast<std::size_t>(i)] * down.weight[static_cast<std::size_t>(j)];
      if (weight == 0.0) continue;
      const auto texel =
          image.texel(across.texel[static_cast<std::size_t>(i)], down.texel[static_cast<std::size_t>(j)]);
      for (std::size_t c = 0; c < out.size(); ++c)
        out[c] += weight * (static_cast<double>(texel[c]) - static_cast<double>(base[c]));
    }
  for (std::size_t c = 0; c < out.size(); ++c) out[c] += static_cast<double>(base[c]);
}

} // namespace tilepack
