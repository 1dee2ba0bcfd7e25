#include "tilepack/exemplar/statistics.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cstdlib>

namespace tilepack {
namespace {

constexpr std::size_t thresholds = 15;
constexpr int measured_channels = 3;

using Measure = std::vector<int>; // one measure, a value a texel

Measure values_of(const FeatureImage& image, int channel) {
  Measure plane;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) plane.push_back(image.texel(x, y)[channel]);
  return plane;
}

Measure contrast_of(const FeatureImage& image) {
  Measure plane;
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
Measure smoothed(const Measure& plane, int width, int height, int reach) {
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
  Measure result;
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

// Of each channel its values and, next to them, its means over squares; contrast comes last.
Measure measure(const FeatureImage& image, int channels, int which) {
  if (which == 2 * channels) return contrast_of(image);
  Measure values = values_of(image, which / 2);
  return which % 2 == 0 ? values : smoothed(values, image.width, image.height, 4);
}

// They split the values into equal parts.
std::array<int, thresholds> limits_of(Measure plane) {
  std::sort(plane.begin(), plane.end());
  std::array<int, thresholds> limits;
  for (std::size_t t = 0; t < thresholds; ++t) limits[t] = plane[plane.size() * (t + 1) / (thresholds + 1)];
  return limits;
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
  const int channels = std::min(level->channels, measured_channels);
  const auto planes = static_cast<std::size_t>(2 * channels + 1);
  functions = static_cast<int>(planes * thresholds);
  const auto count = static_cast<std::size_t>(functions);
  const std::size_t stride = (static_cast<std::size_t>(width) + 1) * count;
  sums.assign(stride * (static_cast<std::size_t>(height) + 1), 0);
  tbb::parallel_for(std::size_t{0}, planes, [&](std::size_t p) {
    const Measure plane = measure(*level, channels, static_cast<int>(p));
    const std::array<int, thresholds> limits = limits_of(plane);
    for (std::size_t y = 0; y < static_cast<std::size_t>(height); ++y) {
      std::array<std::int32_t, thresholds> run{};
      for (std::size_t x = 0; x < static_cast<std::size_t>(width); ++x) {
        const std::int32_t* above = sums.data() + y * stride + (x + 1) * count + p * thresholds;
        std::int32_t* here = sums.data() + (y + 1) * stride + (x + 1) * count + p * thresholds;
        const int value = plane[y * static_cast<std::size_t>(width) + x];
        for (std::size_t t = 0; t < thresholds; ++t) {
          run[t] += value < limits[t];
          here[t] = above[t] + run[t];
        }
      }
    }
  });
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
