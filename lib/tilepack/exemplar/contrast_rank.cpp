#include "tilepack/exemplar/contrast_rank.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>

namespace tilepack {
namespace {

constexpr int half = 3;
constexpr std::int64_t most_squares = 16'384; // contrast changes slowly from texel to texel

// Per texel, times 64 so that small differences count.
std::int64_t variance_round(const FeatureImage& image, int x, int y) {
  const int x0 = std::max(0, x - half);
  const int x1 = std::min(image.width - 1, x + half);
  const int y0 = std::max(0, y - half);
  const int y1 = std::min(image.height - 1, y + half);
  const std::int64_t texels = static_cast<std::int64_t>(x1 - x0 + 1) * (y1 - y0 + 1);
  std::int64_t total = 0;
  for (int c = 0; c < image.channels; ++c) {
    std::int64_t sum = 0;
    std::int64_t squares = 0;
    for (int j = y0; j <= y1; ++j)
      for (int i = x0; i <= x1; ++i) {
        const int value = image.texel(i, j)[c];
        sum += value;
        squares += value * value;
      }
    total += texels * squares - sum * sum;
  }
  return 64 * total / (texels * texels);
}

} // namespace

ContrastRanks contrast_ranks(const FeatureImage& image) {
  int square = 1;
  while (static_cast<std::int64_t>(image.width / square) * (image.height / square) > most_squares)
    square *= 2;
  ContrastRanks result{square, (image.width + square - 1) / square, (image.height + square - 1) / square, {}};
  const auto wide = static_cast<std::size_t>(result.wide);
  std::vector<std::int64_t> variances(wide * static_cast<std::size_t>(result.high));
  tbb::parallel_for(0, result.high, [&](int j) {
    for (int i = 0; i < result.wide; ++i)
      variances[static_cast<std::size_t>(j) * wide + static_cast<std::size_t>(i)] =
          variance_round(image, std::min(image.width - 1, i * square + square / 2),
                         std::min(image.height - 1, j * square + square / 2));
  });
  std::vector<std::int64_t> sorted = variances;
  tbb::parallel_sort(sorted.begin(), sorted.end());
  result.ranks.resize(variances.size());
  tbb::parallel_for(std::size_t{0}, variances.size(), [&](std::size_t i) {
    const auto lower = static_cast<std::size_t>(std::lower_bound(sorted.begin(), sorted.end(), variances[i]) -
                                                sorted.begin());
    result.ranks[i] = static_cast<std::uint8_t>(lower * ContrastRanks::count / sorted.size());
  });
  return result;
}

} // namespace tilepack
