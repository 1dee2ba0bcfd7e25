#include "tilepack/exemplar/saliency.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <numeric>

namespace tilepack {
namespace {

constexpr int compared_channels = 3;
constexpr std::size_t most_measures = 2 * compared_channels; // means, differences between them, contrast

using Measures = std::array<std::int64_t, most_measures>;

Measures measured(const FeatureImage& image, int channels, int cell, int west, int north) {
  std::array<std::int64_t, compared_channels> sums{};
  std::int64_t steps = 0;
  for (int y = north; y < north + cell; ++y)
    for (int x = west; x < west + cell; ++x) {
      const std::uint8_t* here = image.texel(x, y);
      const std::uint8_t* east = image.clamped_texel(x + 1, y);
      const std::uint8_t* south = image.clamped_texel(x, y + 1);
      for (int c = 0; c < channels; ++c) {
        sums[static_cast<std::size_t>(c)] += here[c];
        steps += std::abs(east[c] - here[c]) + std::abs(south[c] - here[c]);
      }
    }
  Measures measures{};
  for (std::size_t c = 0; c < compared_channels; ++c) measures[c] = sums[c];
  for (std::size_t c = 1; c < static_cast<std::size_t>(channels); ++c)
    measures[compared_channels + c - 1] = sums[c] - sums[c - 1];
  measures.back() = steps;
  return measures;
}

} // namespace

Saliency saliency_of(const FeatureImage& image, int halvings) {
  const int cell = Saliency{}.side << halvings;
  Saliency result{image.width / cell, image.height / cell, {}, cell};
  const int channels = std::min(image.channels, compared_channels);
  std::vector<Measures> measures;
  for (int j = 0; j < result.high; ++j)
    for (int i = 0; i < result.wide; ++i)
      measures.push_back(measured(image, channels, cell, i * cell, j * cell));
  result.values.resize(measures.size());
  const double count = static_cast<double>(measures.size());
  for (std::size_t m = 0; m < most_measures; ++m) {
    double sum = 0.0, squares = 0.0;
    for (const Measures& v : measures) sum += static_cast<double>(v[m]);
    for (const Measures& v : measures) {
      const double d = static_cast<double>(v[m]) - sum / count;
      squares += d * d;
    }
    const double deviation = std::sqrt(squares / count);
    if (!(deviation > 0)) continue;
    for (std::size_t i = 0; i < measures.size(); ++i)
      result.values[i] =
          std::max(result.values[i], std::abs(static_cast<double>(measures[i][m]) - sum / count) / deviation);
  }
  return result;
}

double excess_in(const Saliency& saliency, Rect area) {
  const int cell = saliency.side;
  double most = salient_deviation;
  const auto overlap = [cell](int first, int last, int index) {
    return std::min(last, (index + 1) * cell) - std::max(first, index * cell);
  };
  for (int j = std::max(0, area.y / cell); j < saliency.high && j * cell < area.y + area.height; ++j)
    for (int i = std::max(0, area.x / cell); i < saliency.wide && i * cell < area.x + area.width; ++i)
      if (2 * overlap(area.x, area.x + area.width, i) * overlap(area.y, area.y + area.height, j) >=
          cell * cell)
        most = std::max(most, saliency.at(i, j));
  return most - salient_deviation;
}

Landmark most_seen(const Saliency& saliency, Size sample, std::span<const int> showing, std::size_t tiles) {
  const int cell = saliency.side;
  Landmark best;
  double most = 0.0;
  for (int j = 0; j < saliency.high; ++j)
    for (int i = 0; i < saliency.wide; ++i) {
      std::int64_t shown = 0;
      for (int y = j * cell; y < (j + 1) * cell; ++y) {
        const auto row =
            showing.subspan(static_cast<std::size_t>(y) * static_cast<std::size_t>(sample.width) +
                                static_cast<std::size_t>(i * cell),
                            static_cast<std::size_t>(cell));
        shown = std::accumulate(row.begin(), row.end(), shown);
      }
      const double share =
          static_cast<double>(shown) / (static_cast<double>(cell) * cell * static_cast<double>(tiles));
      const double deviation = saliency.at(i, j);
      if ((deviation - salient_deviation) * share > most) {
        most = (deviation - salient_deviation) * share;
        best = {{i * cell + cell / 2, j * cell + cell / 2}, deviation, share};
      }
    }
  return best;
}

} // namespace tilepack
