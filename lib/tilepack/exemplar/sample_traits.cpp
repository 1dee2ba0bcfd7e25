#include "tilepack/exemplar/sample_traits.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace tilepack {
namespace {

int brightness(const std::uint8_t* texel, int channels) {
  int sum = 0;
  for (int c = 0; c < channels; ++c) sum += texel[c];
  return sum / channels;
}

double drift_of(const FeatureImage& image, Size tile, int channels) {
  const int wide = image.width / tile.width;
  const int high = image.height / tile.height;
  if (wide * high < 4) return 0.0;
  const double texels = static_cast<double>(tile.width) * tile.height;
  double within = 0.0;
  double between = 0.0;
  for (int c = 0; c < channels; ++c) {
    double sum = 0.0, squares = 0.0, squared_means = 0.0;
    for (int j = 0; j < high; ++j)
      for (int i = 0; i < wide; ++i) {
        std::int64_t block = 0, block_squares = 0;
        for (int y = j * tile.height; y < (j + 1) * tile.height; ++y)
          for (int x = i * tile.width; x < (i + 1) * tile.width; ++x) {
            const int v = image.texel(x, y)[c];
            block += v;
            block_squares += v * v;
          }
        const double mean = static_cast<double>(block) / texels;
        sum += mean;
        squares += static_cast<double>(block_squares) / texels;
        squared_means += mean * mean;
      }
    const double blocks = static_cast<double>(wide) * high;
    const double mean = sum / blocks;
    within += squares / blocks - mean * mean; // of all texels
    between += squared_means / blocks - mean * mean;
  }
  return within > 0 ? std::clamp(between / within, 0.0, 1.0) : 0.0;
}

// Means of patches without order: those of a square have a quarter of the variance of those of its quarters.
double shading_of(const FeatureImage& image, Size tile, int channels) {
  const int tiles = std::max(1, std::min(image.width / (4 * tile.width), image.height / (4 * tile.height)));
  const Size square{tile.width * tiles, tile.height * tiles};
  if (square.width > image.width || square.height > image.height) return 0.0;
  if ((image.width / square.width) * (image.height / square.height) < 4) return 0.0;
  const Size quarter{std::max(1, square.width / 2), std::max(1, square.height / 2)};
  return std::max(0.0, drift_of(image, square, channels) - drift_of(image, quarter, channels) / 4);
}

struct Tones {
  double explained = 0;
  double smaller = 0;
};

// The threshold that leaves the least variance in both groups together.   [Otsu79]
Tones tones_of(const FeatureImage& image, int channels) {
  std::array<std::int64_t, 256> histogram{};
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      ++histogram[static_cast<std::size_t>(brightness(image.texel(x, y), channels))];
  double count = 0.0, sum = 0.0, squares = 0.0;
  for (std::size_t v = 0; v < histogram.size(); ++v) {
    const double n = static_cast<double>(histogram[v]), value = static_cast<double>(v);
    count += n;
    sum += n * value;
    squares += n * value * value;
  }
  const double mean = sum / count;
  const double variance = squares / count - mean * mean;
  Tones best;
  double below = 0.0, below_sum = 0.0;
  for (std::size_t v = 0; v + 1 < histogram.size(); ++v) {
    below += static_cast<double>(histogram[v]);
    below_sum += static_cast<double>(histogram[v]) * static_cast<double>(v);
    if (below <= 0 || below >= count || variance <= 0) continue;
    const double share = below / count;
    const double distance = below_sum / below - (sum - below_sum) / (count - below);
    const double explained = share * (1 - share) * distance * distance / variance;
    if (explained > best.explained) best = {explained, std::min(share, 1 - share)};
  }
  return best;
}

} // namespace

SampleTraits sample_traits(const FeatureImage& image, const Periodicity& periods, Size tile) {
  const int channels = std::min(image.channels, 3);
  const Tones tones = tones_of(image, channels);
  return {periods, drift_of(image, tile, channels), shading_of(image, tile, channels), tones.explained,
          tones.smaller};
}

} // namespace tilepack
