#include "tilepack/exemplar/local_contrast.h"

#include <algorithm>
#include <cstdint>

namespace tilepack {

LocalContrast local_contrast(const FeatureImage& image) {
  constexpr int cell = LocalContrast::side, half = LocalContrast::around / 2;
  LocalContrast result{image.width / cell, image.height / cell, {}};
  const int channels = image.channels - image.guides;
  // Of all channels of each cell; whole numbers, so that the order of adding is no matter.
  std::vector<std::int64_t> sums(static_cast<std::size_t>(result.wide) *
                                 static_cast<std::size_t>(result.high) * static_cast<std::size_t>(channels));
  const auto sum_at = [&](int i, int j) {
    return sums.data() + (static_cast<std::size_t>(j) * static_cast<std::size_t>(result.wide) +
                          static_cast<std::size_t>(i)) *
                             static_cast<std::size_t>(channels);
  };
  for (int y = 0; y < result.high * cell; ++y)
    for (int x = 0; x < result.wide * cell; ++x) {
      const std::uint8_t* texel = image.texel(x, y);
      std::int64_t* sum = sum_at(x / cell, y / cell);
      for (int c = 0; c < channels; ++c) sum[c] += texel[c];
    }
  double total = 0.0;
  for (int j = 0; j < result.high; ++j)
    for (int i = 0; i < result.wide; ++i) {
      double squared = 0.0;
      for (int c = 0; c < channels; ++c) {
        std::int64_t near = 0, count = 0;
        for (int y = std::max(0, j - half); y <= std::min(result.high - 1, j + half); ++y)
          for (int x = std::max(0, i - half); x <= std::min(result.wide - 1, i + half); ++x, ++count)
            near += sum_at(x, y)[c];
        const double off = static_cast<double>(count * sum_at(i, j)[c] - near) / static_cast<double>(count);
        squared += off * off;
      }
      result.values.push_back(squared);
      total += squared;
    }
  if (total > 0)
    for (double& value : result.values) value *= static_cast<double>(result.values.size()) / total;
  return result;
}

double mean_in(const LocalContrast& contrast, Rect area) {
  constexpr int cell = LocalContrast::side;
  // Of cells along an axis, the first whose middle does not lie before `place`.
  const auto first_from = [](int place, int cells) {
    return std::clamp((place - cell / 2 + cell - 1) / cell, 0, cells);
  };
  const int west = first_from(area.x, contrast.wide), north = first_from(area.y, contrast.high);
  const int east = first_from(area.x + area.width, contrast.wide);
  const int south = first_from(area.y + area.height, contrast.high);
  if (east <= west || south <= north) return 1.0;
  double sum = 0.0;
  for (int j = north; j < south; ++j)
    for (int i = west; i < east; ++i) sum += contrast.at(i, j);
  return sum / (static_cast<double>(east - west) * (south - north));
}

} // namespace tilepack
