#include "tilepack/exemplar/structure.h"

#include "tilepack/numeric/summed_areas.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace tilepack {
namespace {

constexpr double strong_share = 0.1;       // of all texels lie on a strong edge
constexpr double most_strong_share = 0.35; // and at most so many where what is not flat is steep
// So many times the median slope stands out. The steepest tenth is 1.8 times it in grain of one size, and 2.2 (gravel) to
// 3.6 (bathroom tiles) times in photos, which all keep their tenth; 20 and more times in drawn bricks.
constexpr double out_of_flat = 5;
constexpr double part_of_steepest =
    0.3; // and so much of the slope of the steepest hundredth: less is a step within things
constexpr double steepest_share = 0.01;
constexpr int chamfer_unit = 5; // 5, 7, 11: nearest to true distances of all small integers [Borgefors86]
constexpr int chamfer_diagonal = 7;
constexpr int chamfer_knight = 11;

// How steep the smoothed image is at each texel, all channels together. In bands of rows, so that large samples
// need little room.
std::vector<std::uint16_t> slopes(const FeatureImage& image) {
  constexpr int weights[5] = {1, 4, 6, 4, 1};
  constexpr int band = 64;
  const auto wide = static_cast<std::size_t>(image.width);
  std::vector<std::uint16_t> result(wide * static_cast<std::size_t>(image.height));
  tbb::parallel_for(0, (image.height + band - 1) / band, [&](int b) {
    const int first = b * band;
    const int rows = std::min(band, image.height - first);
    // Rows from 3 before the band to 3 past it are smoothed along, those from 1 to 1 across as well.
    std::vector<int> along(wide * static_cast<std::size_t>(rows + 6));
    std::vector<int> smooth(wide * static_cast<std::size_t>(rows + 2));
    std::vector<int> squares(wide * static_cast<std::size_t>(rows));
    for (int c = 0; c < image.channels; ++c) {
      for (int j = 0; j < rows + 6; ++j) {
        const int y = std::clamp(first + j - 3, 0, image.height - 1);
        for (int x = 0; x < image.width; ++x) {
          int sum = 0;
          for (int k = -2; k <= 2; ++k)
            sum += weights[k + 2] * image.texel(std::clamp(x + k, 0, image.width - 1), y)[c];
          along[static_cast<std::size_t>(j) * wide + static_cast<std::size_t>(x)] = sum;
        }
      }
      for (int j = 0; j < rows + 2; ++j)
        for (std::size_t x = 0; x < wide; ++x) {
          int sum = 0;
          for (std::size_t k = 0; k < 5; ++k)
            sum += weights[k] * along[(static_cast<std::size_t>(j) + k) * wide + x];
          smooth[static_cast<std::size_t>(j) * wide + x] = sum / 16;
        }
      for (int j = 0; j < rows; ++j) {
        const int* row = smooth.data() + static_cast<std::size_t>(j + 1) * wide;
        for (int x = 0; x < image.width; ++x) {
          const int dx = row[std::min(x + 1, image.width - 1)] - row[std::max(x - 1, 0)];
          const int dy = row[x + image.width] - row[x - image.width];
          squares[static_cast<std::size_t>(j) * wide + static_cast<std::size_t>(x)] += dx * dx + dy * dy;
        }
      }
    }
    for (std::size_t i = 0; i < squares.size(); ++i) // at most 23 100 with 16 channels
      result[static_cast<std::size_t>(first) * wide + i] =
          static_cast<std::uint16_t>(std::sqrt(static_cast<double>(squares[i])));
  });
  return result;
}

// The slope that at most this share of all texels exceeds.
int slope_of_share(const std::vector<std::size_t>& count, std::size_t texels, double share) {
  const auto most = static_cast<std::size_t>(share * static_cast<double>(texels));
  std::size_t above = 0;
  int value = 65'535;
  while (value > 0 && above + count[static_cast<std::size_t>(value)] <= most)
    above += count[static_cast<std::size_t>(value--)];
  return value;
}

// The slope above which an edge is strong. Where slopes go smoothly over from faint to steep, as those of grain do, it
// is that of the steepest tenth. Where most of the sample is flat and the rest steep, as of bricks in mortar, the
// steepest tenth would be the joints of some bricks and not of others; there it is what stands out from the flat.
int strong_slope(const std::vector<std::uint16_t>& slope) {
  std::vector<std::size_t> count(65'536);
  for (const std::uint16_t s : slope) ++count[s];
  const auto of_share = [&](double share) { return slope_of_share(count, slope.size(), share); };
  const double stands_out =
      std::max(out_of_flat * of_share(0.5), part_of_steepest * of_share(steepest_share));
  return std::min(of_share(strong_share),
                  std::max(of_share(most_strong_share), static_cast<int>(stands_out)));
}

// Of each texel the differences from its neighbours in the east and south, summed over a square round it, and against
// the mean of all squares.
std::vector<std::uint8_t> sensitivities(const FeatureImage& image, double floor_share) {
  constexpr int half = 3;
  const int w = image.width, h = image.height;
  const auto index = [&](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(w) + static_cast<std::size_t>(x);
  };
  std::vector<std::int64_t> steps(index(0, h));
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x)
      steps[index(x, y)] =
          squared_difference(image.texel(x, y), image.clamped_texel(x + 1, y), image.channels) +
          squared_difference(image.texel(x, y), image.clamped_texel(x, y + 1), image.channels);
  SummedAreas<std::int64_t> sums(w, h, [&](int x, int y) { return steps[index(x, y)]; });
  double mean = 0;
  for (const auto s : steps) mean += static_cast<double>(s);
  mean = std::max(1.0, mean / static_cast<double>(steps.size()));
  std::vector<double> seen(steps.size());
  double all = 0;
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      const int x0 = std::max(0, x - half), y0 = std::max(0, y - half);
      const Rect area{x0, y0, std::min(w, x + half + 1) - x0, std::min(h, y + half + 1) - y0};
      const double own = static_cast<double>(sums.sum(area)) / (area.width * area.height);
      seen[index(x, y)] = mean / (floor_share * mean + own);
      all += seen[index(x, y)];
    }
  all /= static_cast<double>(steps.size());
  std::vector<std::uint8_t> result(steps.size());
  for (std::size_t i = 0; i < steps.size(); ++i)
    result[i] =
        static_cast<std::uint8_t>(std::clamp<long>(std::lround(sensitivity_unit * seen[i] / all), 1, 255));
  return result;
}

} // namespace

std::int64_t variance_of(const FeatureImage& image) {
  const auto texels = static_cast<std::int64_t>(image.width) * image.height;
  std::vector<std::int64_t> sums(static_cast<std::size_t>(image.channels));
  std::vector<std::int64_t> squares(sums.size());
  const std::uint8_t* value = image.values.data();
  for (std::int64_t i = 0; i < texels; ++i)
    for (std::size_t c = 0; c < sums.size(); ++c, ++value) {
      sums[c] += *value;
      squares[c] += *value * *value;
    }
  double variance = 0.0;
  for (std::size_t c = 0; c < sums.size(); ++c) {
    const double mean = static_cast<double>(sums[c]) / static_cast<double>(texels);
    variance += static_cast<double>(squares[c]) / static_cast<double>(texels) - mean * mean;
  }
  return std::llround(variance);
}

FeatureImage with_structure(const FeatureImage& image, const StructureOptions& options) {
  if (image.channels >= max_feature_channels || options.weight <= 0.0) return image;
  const std::vector<std::uint16_t> slope = slopes(image);
  const int strong = strong_slope(slope);

  const int w = image.width;
  const int h = image.height;
  constexpr int farthest = structure_range * chamfer_unit;
  const auto index = [&](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(w) + static_cast<std::size_t>(x);
  };
  std::vector<std::uint8_t> distance(slope.size());
  for (std::size_t i = 0; i < slope.size(); ++i)
    distance[i] = static_cast<std::uint8_t>(slope[i] > strong ? 0 : farthest);
  const auto relax = [&](int x, int y, int dx, int dy, int step) {
    if (x + dx < 0 || x + dx >= w || y + dy < 0 || y + dy >= h) return;
    std::uint8_t& d = distance[index(x, y)];
    d = static_cast<std::uint8_t>(std::min<int>(d, distance[index(x + dx, y + dy)] + step));
  };
  const auto sweep = [&](int x, int y, int sign) {
    relax(x, y, -sign, 0, chamfer_unit);
    for (const int dx : {-1, 1}) {
      relax(x, y, dx, -sign, chamfer_diagonal);
      relax(x, y, 2 * dx, -sign, chamfer_knight);
      relax(x, y, dx, -2 * sign, chamfer_knight);
    }
    relax(x, y, 0, -sign, chamfer_unit);
  };
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) sweep(x, y, 1);
  for (int y = h - 1; y >= 0; --y)
    for (int x = w - 1; x >= 0; --x) sweep(x, y, -1);

  FeatureImage result{w, h, image.channels + 1, {}, image.guides + 1, 0, {}};
  result.sensitivity = sensitivities(image, options.sensitivity_floor);
  result.flat_seam = static_cast<int>(options.flat_seam_share * static_cast<double>(variance_of(image)));
  result.values.resize(slope.size() * static_cast<std::size_t>(result.channels));
  const int full = static_cast<int>(std::lround(255.0 * std::min(options.weight, 1.0)));
  std::uint8_t* value = result.values.data();
  for (std::size_t i = 0; i < slope.size(); ++i) {
    const std::uint8_t* own = image.values.data() + i * static_cast<std::size_t>(image.channels);
    value = std::copy_n(own, image.channels, value);
    *value++ = static_cast<std::uint8_t>(distance[i] * full / farthest);
  }
  return result;
}

} // namespace tilepack
