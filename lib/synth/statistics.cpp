#include "tilepack/synth/statistics.h"

#include <algorithm>
#include <cstdlib>

namespace tilepack {
namespace {

constexpr int thresholds = 15;
constexpr int most_channels = 3;

using Plane = std::vector<int>; // one measure, a value a texel

Plane values_of(const FeatureImage& image, int channel) {
  Plane plane;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) plane.push_back(image.texel(x, y)[channel]);
  return plane;
}

Plane contrast_of(const FeatureImage& image) {
  Plane plane;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      int sum = 0;
      for (int c = 0; c < image.channels; ++c)
        sum += std::abs(image.clamped_texel(x + 1, y)[c] - image.clamped_texel(x - 1, y)[c]) +
               std::abs(image.clamped_texel(x, y + 1)[c] - image.clamped_texel(x, y - 1)[c]);
      plane.push_back(sum);
    }
  return plane;
}

// Sums over squares of side 2 reach + 1, clamped at the border; scaled to one number of texels.
Plane smoothed(const Plane& plane, int width, int height, int reach) {
  const std::size_t stride = static_cast<std::size_t>(width) + 1;
  std::vector<int> sums(stride * (static_cast<std::size_t>(height) + 1));
  for (int y = 0; y < height; ++y) {
    int run = 0;
    for (int x = 0; x < width; ++x) {
      run += plane[static_cast<std::size_t>(y * width + x)];
      sums[static_cast<std::size_t>(y + 1) * stride + static_cast<std::size_t>(x + 1)] =
          sums[static_cast<std::size_t>(y) * stride + static_cast<std::size_t>(x + 1)] + run;
    }
  }
  Plane result;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const auto at = [&](int i, int j) {
        return sums[static_cast<std::size_t>(j) * stride + static_cast<std::size_t>(i)];
      };
      const int x0 = std::max(0, x - reach);
      const int x1 = std::min(width, x + reach + 1);
      const int y0 = std::max(0, y - reach);
      const int y1 = std::min(height, y + reach + 1);
      result.push_back((at(x1, y1) - at(x0, y1) - at(x1, y0) + at(x0, y0)) * 16 / ((x1 - x0) * (y1 - y0)));
    }
  return result;
}

} // namespace

SampleStatistics::SampleStatistics(const FeatureImage& image, int most_texels) {
  FeatureImage small;
  const FeatureImage* level = &image;
  while (static_cast<std::int64_t>(level->width) * level->height > most_texels && level->width > 1 &&
         level->height > 1) {
    small = halved(*level);
    level = &small;
    scale *= 2;
  }
  width = level->width;
  height = level->height;
  std::vector<Plane> planes;
  for (int c = 0; c < std::min(level->channels, most_channels); ++c) {
    planes.push_back(values_of(*level, c));
    planes.push_back(smoothed(planes.back(), width, height, 4));
  }
  planes.push_back(contrast_of(*level));

  functions = static_cast<int>(planes.size()) * thresholds;
  std::vector<int> limits;
  for (const Plane& plane : planes) {
    Plane sorted = plane;
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t t = 1; t <= thresholds; ++t)
      limits.push_back(sorted[sorted.size() * t / (thresholds + 1)]);
  }
  const auto count = static_cast<std::size_t>(functions);
  const std::size_t stride = (static_cast<std::size_t>(width) + 1) * count;
  sums.assign(stride * (static_cast<std::size_t>(height) + 1), 0);
  std::vector<std::int32_t> run(count);
  for (std::size_t y = 0; y < static_cast<std::size_t>(height); ++y) {
    std::fill(run.begin(), run.end(), 0);
    for (std::size_t x = 0; x < static_cast<std::size_t>(width); ++x) {
      const std::int32_t* above = sums.data() + y * stride + (x + 1) * count;
      std::int32_t* here = sums.data() + (y + 1) * stride + (x + 1) * count;
      for (std::size_t f = 0; f < count; ++f) {
        run[f] += planes[f / thresholds][y * static_cast<std::size_t>(width) + x] < limits[f];
        here[f] = above[f] + run[f];
      }
    }
  }
  const std::int32_t* all = sums.data() + sums.size() - count;
  for (std::size_t f = 0; f < count; ++f)
    target.push_back(all[f] / (static_cast<double>(width) * static_cast<double>(height)));
}

SampleStatistics::Corners SampleStatistics::corners(Rect a) const {
  const int x0 = std::clamp(a.x / scale, 0, width - 1);
  const int y0 = std::clamp(a.y / scale, 0, height - 1);
  const int x1 = std::clamp((a.x + a.width) / scale, x0 + 1, width);
  const int y1 = std::clamp((a.y + a.height) / scale, y0 + 1, height);
  const auto at = [&](int x, int y) {
    return sums.data() + (static_cast<std::size_t>(y) * (static_cast<std::size_t>(width) + 1) +
                          static_cast<std::size_t>(x)) *
                             static_cast<std::size_t>(functions);
  };
  return {at(x0, y0), at(x1, y0), at(x0, y1), at(x1, y1), (x1 - x0) * (y1 - y0)};
}

void SampleStatistics::add(Tally& tally, Rect area, double weight) const {
  const Corners c = corners(area);
  tally.texels += weight * c.texels;
  for (std::size_t f = 0; f < tally.below.size(); ++f)
    tally.below[f] += weight * (c.high_high[f] - c.high_low[f] - c.low_high[f] + c.low_low[f]);
}

double SampleStatistics::distance_with(const Tally& tally, Rect area, double weight) const {
  const Corners c = corners(area);
  const double texels = tally.texels + weight * c.texels;
  double sum = 0.0;
  for (std::size_t f = 0; f < tally.below.size(); ++f) {
    const double below =
        tally.below[f] + weight * (c.high_high[f] - c.high_low[f] - c.low_high[f] + c.low_low[f]);
    const double difference = below / texels - target[f];
    sum += difference * difference;
  }
  return sum / functions;
}

double SampleStatistics::distance(const Tally& tally) const {
  double sum = 0.0;
  for (std::size_t f = 0; f < tally.below.size(); ++f) {
    const double difference = tally.below[f] / std::max(tally.texels, 1e-9) - target[f];
    sum += difference * difference;
  }
  return sum / functions;
}

} // namespace tilepack
