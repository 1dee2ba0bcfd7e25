#include "tilepack/exemplar/cheapest_lines.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace tilepack {
namespace {

enum class Lines { columns, rows };

constexpr int beside = 2; // lines to either side that count, the less the farther they are

// What a cut along the lines that lie whole periods from `first` on is expected to cost, a texel.
double expected_cost(const FeatureImage& image, Lines lines, double period, int first) {
  const int across = lines == Lines::columns ? image.width : image.height;
  const int along = lines == Lines::columns ? image.height : image.width;
  std::vector<int> places;
  for (int k = 0;; ++k) {
    const int place = first + static_cast<int>(std::lround(k * period));
    if (place >= across) break;
    places.push_back(place);
  }
  const auto count = static_cast<double>(places.size());
  if (places.size() < 2) return 0.0;
  std::int64_t spread = 0; // count · Σ v² - (Σ v)², as differences are seen, of all texels along the lines
  std::int64_t flat = 0;
  for (int i = 0; i < along; ++i) {
    std::int64_t seen = 0, own = 0;
    const auto texel = [&](int place) {
      return lines == Lines::columns ? image.texel(place, i) : image.texel(i, place);
    };
    for (int c = 0; c < image.channels; ++c) {
      std::int64_t sum = 0, squares = 0;
      for (const int place : places) {
        const std::int64_t v = texel(place)[c];
        sum += v;
        squares += v * v;
      }
      own += static_cast<std::int64_t>(places.size()) * squares - sum * sum;
    }
    for (const int place : places) {
      const auto offset = static_cast<std::size_t>(texel(place) - image.values.data());
      seen += image.sensitivity.empty()
                  ? sensitivity_unit
                  : image.sensitivity[offset / static_cast<std::size_t>(image.channels)];
      flat += texel(place)[image.channels - 1];
    }
    spread += own * seen / (static_cast<std::int64_t>(places.size()) * sensitivity_unit);
  }
  const double texels = along;
  const double difference = 2.0 * static_cast<double>(spread) / (count * (count - 1) * texels);
  // Of a pair of texels both sides count, of differences as of flat places.
  return 2.0 * difference + image.flat_seam * static_cast<double>(flat) / (255.0 * count * texels);
}

int cheapest_line(const FeatureImage& image, Lines lines, double period) {
  const int across = lines == Lines::columns ? image.width : image.height;
  const int count = std::min(static_cast<int>(std::lround(period)), across / 2);
  if (count < 2) return 0;
  std::vector<double> costs(static_cast<std::size_t>(count));
  tbb::parallel_for(0, count, [&](int first) {
    costs[static_cast<std::size_t>(first)] = expected_cost(image, lines, period, first);
  });
  int best = 0;
  double least = 0.0;
  for (int line = 0; line < count; ++line) {
    double cost = 0.0;
    for (int off = -beside; off <= beside; ++off)
      cost += (beside + 1 - std::abs(off)) *
              costs[static_cast<std::size_t>((line + off + beside * count) % count)];
    if (line == 0 || cost < least) {
      least = cost;
      best = line;
    }
  }
  return best;
}

} // namespace

SourceTexel cheapest_lines(const FeatureImage& image, const Periodicity& periods) {
  SourceTexel lines{0, 0};
  if (periods.x.length > 0) lines.x = cheapest_line(image, Lines::columns, periods.x.length);
  if (periods.y.length > 0) lines.y = cheapest_line(image, Lines::rows, periods.y.length);
  return lines;
}

} // namespace tilepack
