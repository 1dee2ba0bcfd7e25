#include "tilepack/exemplar/object_scale.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace tilepack {
namespace {

constexpr int longest_lag = 32; // texels of the image that is looked at
constexpr int least_half = 512; // the shorter side of an image that is looked at beside one twice as large
// Of the variance at full size. By averaging grain loses more at each halving, and shading has less than that.
constexpr double coarse_share = 0.25;
constexpr double grain = 5; // texels: less is what is left of grain (gravel 3.8, bark 4.9)

constexpr int half_box = 32;   // slower than this square is shading
constexpr int most_side = 768; // of the middle of the sample, which is looked at

// Brightness less its mean over a square, in sixteenths.
struct Relief {
  int width = 0;
  int height = 0;
  std::vector<std::int32_t> values;
  std::int32_t at(int x, int y) const {
    return values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
};

Relief relief_of(const FeatureImage& image) {
  const int wide = std::min(image.width, most_side), high = std::min(image.height, most_side);
  const int west = (image.width - wide) / 2, north = (image.height - high) / 2;
  Relief relief{wide, high, {}};
  const int channels = std::min(image.channels, 3);
  const auto stride = static_cast<std::size_t>(wide) + 1;
  std::vector<std::int64_t> sums(stride * (static_cast<std::size_t>(high) + 1));
  const auto brightness = [&](int x, int y) {
    const std::uint8_t* texel = image.texel(west + x, north + y);
    int sum = 0;
    for (int c = 0; c < channels; ++c) sum += texel[c];
    return 16 * sum / channels;
  };
  for (int y = 0; y < high; ++y) {
    std::int64_t run = 0;
    for (int x = 0; x < wide; ++x) {
      run += brightness(x, y);
      const std::size_t i = static_cast<std::size_t>(y + 1) * stride + static_cast<std::size_t>(x + 1);
      sums[i] = sums[i - stride] + run;
    }
  }
  relief.values.resize(static_cast<std::size_t>(wide) * static_cast<std::size_t>(high));
  tbb::parallel_for(0, high, [&](int y) {
    const int y0 = std::max(0, y - half_box), y1 = std::min(high, y + half_box + 1);
    for (int x = 0; x < wide; ++x) {
      const int x0 = std::max(0, x - half_box), x1 = std::min(wide, x + half_box + 1);
      const auto at = [&](int i, int j) {
        return sums[static_cast<std::size_t>(j) * stride + static_cast<std::size_t>(i)];
      };
      const std::int64_t mean = (at(x1, y1) - at(x0, y1) - at(x1, y0) + at(x0, y0)) /
                                (static_cast<std::int64_t>(x1 - x0) * (y1 - y0));
      relief.values[static_cast<std::size_t>(y) * static_cast<std::size_t>(wide) +
                    static_cast<std::size_t>(x)] = static_cast<std::int32_t>(brightness(x, y) - mean);
    }
  });
  return relief;
}

// The mean product of texels (dx, dy) apart.
double correlation(const Relief& relief, int dx, int dy) {
  const int x0 = std::max(0, -dx), x1 = std::min(relief.width, relief.width - dx);
  const int y1 = relief.height - dy;
  if (x1 <= x0 || y1 <= 0) return 0.0;
  std::int64_t sum = 0;
  for (int y = 0; y < y1; ++y)
    for (int x = x0; x < x1; ++x)
      sum += static_cast<std::int64_t>(relief.at(x, y)) * relief.at(x + dx, y + dy);
  return static_cast<double>(sum) / (static_cast<double>(x1 - x0) * y1);
}

struct Seen {
  double scale;
  double variance;
};

Seen seen_in(const FeatureImage& image) {
  const Relief relief = relief_of(image);
  const double variance = correlation(relief, 0, 0);
  if (!(variance > 0.0)) return {1.0, 0.0};
  std::array<double, longest_lag + 1> at_lag{};
  at_lag[0] = 1.0;
  tbb::parallel_for(1, longest_lag + 1, [&](int lag) {
    const int aslant = (lag * 181 + 128) / 256; // lag / √2
    at_lag[static_cast<std::size_t>(lag)] =
        (correlation(relief, lag, 0) + correlation(relief, 0, lag) + correlation(relief, aslant, aslant) +
         correlation(relief, -aslant, aslant)) /
        (4.0 * variance);
  });
  constexpr double independent = 0.1;
  for (std::size_t lag = 1; lag < at_lag.size(); ++lag)
    if (at_lag[lag] < independent)
      return {static_cast<double>(lag) -
                  (independent - at_lag[lag]) / std::max(1e-9, at_lag[lag - 1] - at_lag[lag]),
              variance};
  return {longest_lag, variance};
}

bool has_half(Size size) {
  return std::min(size.width, size.height) >= 2 * least_half;
}

} // namespace

double object_scale(const FeatureImage& image) {
  const Seen full = seen_in(image);
  double scale = full.scale;
  FeatureImage half;
  double texels = 1;
  for (const FeatureImage* seen = &image; has_half({seen->width, seen->height});) {
    half = halved(*seen);
    seen = &half;
    texels *= 2;
    const Seen coarse = seen_in(half);
    if (coarse.scale >= grain && coarse.variance >= coarse_share * full.variance)
      scale = std::max(scale, texels * coarse.scale);
  }
  return scale;
}

double largest_object_scale(Size sample) {
  double scale = longest_lag;
  for (; has_half(sample); sample = {sample.width / 2, sample.height / 2}) scale *= 2;
  return scale;
}

} // namespace tilepack
