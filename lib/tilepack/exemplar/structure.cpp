#include "tilepack/exemplar/structure.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace tilepack {
namespace {

// Where more than the steepest tenth may be strong: so many times the median slope stands out. The steepest tenth is 1.8
// times it in grain of one size, 1.5 to 4.5 in 22 photos, 9 and 13 in two drawn walls. By eye: at 5, bathroom tiles and
// drawn bricks keep their tenth, and more of them are cut in two.
constexpr double out_of_flat = 2;
// And so much of the slope of the steepest hundredth: less is a step within things.
constexpr double part_of_steepest = 0.3;
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

// The slope above which an edge is strong: that of the steepest tenth, or, where more may be, what stands out from the
// flat.
int strong_slope(const std::vector<std::uint16_t>& slope, double most_strong_share) {
  std::vector<std::size_t> count(65'536);
  for (const std::uint16_t s : slope) ++count[s];
  const auto of_share = [&](double share) { return slope_of_share(count, slope.size(), share); };
  const double stands_out =
      std::max(out_of_flat * of_share(0.5), part_of_steepest * of_share(steepest_share));
  return std::min(of_share(strong_share),
                  std::max(of_share(most_strong_share), static_cast<int>(stands_out)));
}

// Of each texel the differences from its neighbours in the east and south, squared.
void add_steps(const FeatureImage& image, int y, std::vector<std::int32_t>& steps) {
  for (int x = 0; x < image.width; ++x)
    steps[static_cast<std::size_t>(x)] =
        squared_difference(image.texel(x, y), image.clamped_texel(x + 1, y), image.channels) +
        squared_difference(image.texel(x, y), image.clamped_texel(x, y + 1), image.channels);
}

constexpr int sensed_half = 3; // of the square round a texel that tells how busy it is there

// The sums of steps over the square round each texel of a row, cut off at the image's borders. Rows are asked for from
// the first on, one after the other: so no more than those of a square are held.
class SquareSums {
public:
  SquareSums(const FeatureImage& feature_image, int first_row)
      : image(feature_image), next(std::max(0, first_row - sensed_half)),
        columns(static_cast<std::size_t>(image.width)), sums(columns.size()) {
    for (auto& row : rows) row.resize(columns.size());
  }

  const std::vector<std::int64_t>& of_row(int y) {
    for (; next <= std::min(image.height - 1, y + sensed_half); ++next) {
      std::vector<std::int32_t>& row = rows[static_cast<std::size_t>(next) % rows.size()];
      for (std::size_t x = 0; x < columns.size(); ++x)
        columns[x] -= row[x]; // none, or that which leaves the square
      add_steps(image, next, row);
      for (std::size_t x = 0; x < columns.size(); ++x) columns[x] += row[x];
    }
    if (y + sensed_half >= image.height && y > sensed_half) { // none comes for the one that leaves
      std::vector<std::int32_t>& row = rows[static_cast<std::size_t>(y - sensed_half - 1) % rows.size()];
      for (std::size_t x = 0; x < columns.size(); ++x) columns[x] -= row[x];
      std::fill(row.begin(), row.end(), 0);
    }
    std::int64_t run = 0;
    const int w = image.width;
    for (int x = -sensed_half; x < w; ++x) {
      if (x + sensed_half < w) run += columns[static_cast<std::size_t>(x + sensed_half)];
      if (x > sensed_half) run -= columns[static_cast<std::size_t>(x - sensed_half - 1)];
      if (x >= 0) sums[static_cast<std::size_t>(x)] = run;
    }
    return sums;
  }

private:
  const FeatureImage& image;
  int next; // row to be added
  std::array<std::vector<std::int32_t>, 2 * sensed_half + 1> rows;
  std::vector<std::int64_t> columns; // over the rows of the square
  std::vector<std::int64_t> sums;
};

// visit(row, how well differences are seen there, a double a texel), in bands side by side.
template <class Visit>
void for_each_seen_row(const FeatureImage& image, double floor_share, double mean, const Visit& visit) {
  constexpr int band = 128;
  const int w = image.width, h = image.height;
  tbb::parallel_for(0, (h + band - 1) / band, [&](int b) {
    SquareSums squares(image, b * band);
    std::vector<double> seen(static_cast<std::size_t>(w));
    for (int y = b * band; y < std::min(h, (b + 1) * band); ++y) {
      const std::vector<std::int64_t>& sums = squares.of_row(y);
      const int high = std::min(h, y + sensed_half + 1) - std::max(0, y - sensed_half);
      for (int x = 0; x < w; ++x) {
        const int wide = std::min(w, x + sensed_half + 1) - std::max(0, x - sensed_half);
        const double own = static_cast<double>(sums[static_cast<std::size_t>(x)]) / (wide * high);
        seen[static_cast<std::size_t>(x)] = mean / (floor_share * mean + own);
      }
      visit(y, seen);
    }
  });
}

// Of each texel the steps of the square round it, against the mean of all squares. Looked at twice, row by row, so that
// a large sample takes a byte a texel and no more.
std::vector<std::uint8_t> sensitivities(const FeatureImage& image, double floor_share) {
  const auto wide = static_cast<std::size_t>(image.width);
  const auto high = static_cast<std::size_t>(image.height);
  std::vector<double> of_row(high); // sums of a row, added in their order whatever the number of threads
  const auto mean_of_rows = [&] {
    return std::accumulate(of_row.begin(), of_row.end(), 0.0) / static_cast<double>(wide * high);
  };
  tbb::parallel_for(std::size_t{0}, high, [&](std::size_t y) {
    std::vector<std::int32_t> steps(wide);
    add_steps(image, static_cast<int>(y), steps);
    of_row[y] = static_cast<double>(std::accumulate(steps.begin(), steps.end(), std::int64_t{0}));
  });
  const double mean = std::max(1.0, mean_of_rows());
  for_each_seen_row(image, floor_share, mean, [&](int y, const std::vector<double>& seen) {
    of_row[static_cast<std::size_t>(y)] = std::accumulate(seen.begin(), seen.end(), 0.0);
  });
  const double all = mean_of_rows();
  std::vector<std::uint8_t> result(wide * high);
  for_each_seen_row(image, floor_share, mean, [&](int y, const std::vector<double>& seen) {
    std::uint8_t* to = result.data() + static_cast<std::size_t>(y) * wide;
    for (const double s : seen)
      *to++ = static_cast<std::uint8_t>(std::clamp<long>(std::lround(sensitivity_unit * s / all), 1, 255));
  });
  return result;
}

constexpr int farthest_step = structure_range * chamfer_unit;

// The distance of each texel from the nearest strong edge, in 1 / chamfer_unit, at most `farthest_step`: two sweeps over
// rows, each from the two rows before it and then along itself [Borgefors86].
class EdgeDistances {
public:
  EdgeDistances(const FeatureImage& image, double most_strong_share)
      : width(static_cast<std::size_t>(image.width)), height(static_cast<std::size_t>(image.height)),
        pitch(width + 2 * margin), values(pitch * (height + 2 * margin), std::uint8_t{farthest_step}) {
    const std::vector<std::uint16_t> slope = slopes(image);
    const int strong = strong_slope(slope, most_strong_share);
    for (std::size_t y = 0; y < height; ++y)
      for (std::size_t x = 0; x < width; ++x)
        if (slope[y * width + x] > strong) row(y)[x] = 0;
    for (std::size_t y = 0; y < height; ++y) {
      relax(row(y), -static_cast<std::ptrdiff_t>(pitch));
      for (std::size_t x = 0; x < width; ++x) relax_beside(row(y) + x, -1);
    }
    for (std::size_t y = height; y-- > 0;) {
      relax(row(y), static_cast<std::ptrdiff_t>(pitch));
      for (std::size_t x = width; x-- > 0;) relax_beside(row(y) + x, 1);
    }
  }

  const std::uint8_t* row(std::size_t y) const { return values.data() + (y + margin) * pitch + margin; }

private:
  // Texels round the image, as far as a step goes: nothing is near them.
  static constexpr std::size_t margin = 2;

  std::uint8_t* row(std::size_t y) { return values.data() + (y + margin) * pitch + margin; }

  static std::uint8_t nearer(int a, int b) { return static_cast<std::uint8_t>(a < b ? a : b); }

  // From the rows one and two further; `further`: to the next.
  void relax(std::uint8_t* own, std::ptrdiff_t further) const {
    const std::uint8_t* one = own + further;
    const std::uint8_t* two = one + further;
    for (std::size_t x = 0; x < width; ++x, ++one, ++two) {
      std::uint8_t d = nearer(own[x], *one + chamfer_unit);
      d = nearer(d, nearer(one[-1], one[1]) + chamfer_diagonal);
      d = nearer(d, nearer(nearer(one[-2], one[2]), nearer(two[-1], two[1])) + chamfer_knight);
      own[x] = d;
    }
  }
  static void relax_beside(std::uint8_t* texel, std::ptrdiff_t step) {
    *texel = nearer(*texel, texel[step] + chamfer_unit);
  }

  std::size_t width, height, pitch;
  std::vector<std::uint8_t> values;
};

// Where the texels of a row or column of an image lie between those of one halved so many times, in whole numbers.
class Enlarged {
public:
  struct Place {
    std::size_t first, second;
    int part; // of the second, in 1 / (2 · 2^halvings)
    int unit;
  };

  Enlarged(int texels, int small_texels, int halvings) {
    const int unit = 2 << halvings;
    for (int i = 0; i < texels; ++i) {
      const int middle = std::max(0, 2 * i + 1 - unit / 2); // from the middle of the first small texel
      const auto first = static_cast<std::size_t>(std::min(middle / unit, small_texels - 1));
      const std::size_t second = std::min(first + 1, static_cast<std::size_t>(small_texels - 1));
      places.push_back({first, second, middle % unit, unit});
    }
  }
  const Place& operator[](std::size_t i) const { return places[i]; }

  // Bilinear, rounded; `upper` and `lower` are the rows of `y`.
  static int between(const Place& x, const Place& y, const std::uint8_t* upper, const std::uint8_t* lower) {
    const auto along = [&](const std::uint8_t* row) {
      return row[x.first] * (x.unit - x.part) + row[x.second] * x.part;
    };
    const std::int64_t sum =
        std::int64_t{along(upper)} * (y.unit - y.part) + std::int64_t{along(lower)} * y.part;
    const std::int64_t all = std::int64_t{x.unit} * y.unit;
    return static_cast<int>((sum + all / 2) / all);
  }

private:
  std::vector<Place> places;
};

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

FeatureImage with_structure(const FeatureImage& image, const StructureOptions& options, int halvings) {
  if (image.channels >= max_feature_channels || options.weight <= 0.0) return image;
  FeatureImage half; // or a smaller part
  const FeatureImage* seen = &image;
  int times = 0; // as often as it can be halved
  for (; times < halvings && std::min(seen->width, seen->height) >= 2; ++times) {
    half = halved(*seen);
    seen = &half;
  }
  const Size size{seen->width, seen->height};
  const EdgeDistances distance(*seen, options.most_strong_share);
  const std::vector<std::uint8_t> sensitivity = sensitivities(*seen, options.sensitivity_floor);
  const int w = image.width;
  const int h = image.height;
  FeatureImage result{w, h, image.channels + 1, {}, image.guides + 1, 0, {}};
  result.sensitivity.resize(static_cast<std::size_t>(w) * static_cast<std::size_t>(h));
  result.flat_seam = static_cast<int>(options.flat_seam_share * static_cast<double>(variance_of(image)));
  const int full = static_cast<int>(std::lround(255.0 * std::min(options.weight, 1.0)));
  const Enlarged across(w, size.width, times), down(h, size.height, times);
  const auto wide = static_cast<std::size_t>(w);
  result.values.resize(wide * static_cast<std::size_t>(h) * static_cast<std::size_t>(result.channels));
  tbb::parallel_for(std::size_t{0}, static_cast<std::size_t>(h), [&](std::size_t y) {
    std::uint8_t* value = result.values.data() + y * wide * static_cast<std::size_t>(result.channels);
    const std::uint8_t* own = image.texel(0, static_cast<int>(y));
    const Enlarged::Place at = down[y];
    const auto sensed = [&](std::size_t row) {
      return sensitivity.data() + row * static_cast<std::size_t>(size.width);
    };
    for (std::size_t x = 0; x < wide; ++x, own += image.channels) {
      value = std::copy_n(own, image.channels, value);
      const int d = Enlarged::between(across[x], at, distance.row(at.first), distance.row(at.second));
      *value++ = static_cast<std::uint8_t>(d * full / farthest_step);
      result.sensitivity[y * wide + x] =
          static_cast<std::uint8_t>(Enlarged::between(across[x], at, sensed(at.first), sensed(at.second)));
    }
  });
  return result;
}

} // namespace tilepack
