#include "tilepack/exemplar/period.h"

#include "tilepack/exemplar/courses.h"
#include "tilepack/exemplar/exact_repeat.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace tilepack {
namespace {

constexpr int largest_side = 256;  // larger samples are box-filtered down: periods are coarse things
constexpr int shortest_period = 2; // texels of the plane

// A repeat counts when comb · sqrt(teeth - 1) reaches this: a comb of few teeth is easily met by chance. Of
// 31 photos, those without a regular structure reached at most 0.41, those with one at least 0.58 (hand-laid
// bricks).
constexpr double least_significance = 0.5;

// One channel of integers, high-passed. Values stay within ±2048 · run length, so sums of products are exact
// in 64 bits.
struct Plane {
  int width = 0;
  int height = 0;
  std::vector<std::int32_t> values;

  Plane(int w, int h)
      : width(w), height(h), values(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
  std::int32_t& at(int x, int y) { return values[static_cast<std::size_t>(y) * width + x]; }
  std::int32_t at(int x, int y) const { return values[static_cast<std::size_t>(y) * width + x]; }
};

int shrink_of(const Image& image) {
  return (std::max(image.width(), image.height()) + largest_side - 1) / largest_side;
}

// Sums of shrink × shrink blocks of every channel that is not alpha, scaled to 0..1023 (HDR by its maximum).
std::vector<Plane> shrunken_channels(const Image& image) {
  const int shrink = shrink_of(image);
  const int channels = color_channels(image.channels());
  float top = 1.0f;
  for (const float v : image.data()) top = std::max(top, v);
  const float scale = 1023.0f / (top * static_cast<float>(shrink * shrink));
  std::vector<Plane> planes(static_cast<std::size_t>(channels),
                            Plane(image.width() / shrink, image.height() / shrink));
  for (int c = 0; c < channels; ++c)
    for (int y = 0; y < planes[0].height; ++y)
      for (int x = 0; x < planes[0].width; ++x) {
        float sum = 0;
        for (int j = 0; j < shrink; ++j)
          for (int i = 0; i < shrink; ++i)
            sum += image.texel(x * shrink + i, y * shrink + j)[static_cast<std::size_t>(c)];
        planes[static_cast<std::size_t>(c)].at(x, y) = static_cast<std::int32_t>(sum * scale);
      }
  return planes;
}

// Less the mean of the surrounding square: shading that drifts over the sample would agree with itself at
// every lag.
Plane high_passed(const Plane& plane) {
  const int radius = std::max(4, std::min(plane.width, plane.height) / 8);
  Plane sums(plane.width + 1, plane.height + 1);
  for (int y = 0; y < plane.height; ++y)
    for (int x = 0; x < plane.width; ++x)
      sums.at(x + 1, y + 1) = plane.at(x, y) + sums.at(x, y + 1) + sums.at(x + 1, y) - sums.at(x, y);
  Plane result = plane;
  for (int y = 0; y < plane.height; ++y)
    for (int x = 0; x < plane.width; ++x) {
      const int x0 = std::max(0, x - radius), x1 = std::min(plane.width, x + radius + 1);
      const int y0 = std::max(0, y - radius), y1 = std::min(plane.height, y + radius + 1);
      const std::int32_t sum = sums.at(x1, y1) - sums.at(x0, y1) - sums.at(x1, y0) + sums.at(x0, y0);
      result.at(x, y) -= sum / ((x1 - x0) * (y1 - y0));
    }
  return result;
}

// Luma and two opponent colors: mortar may be as bright as brick and yet of another hue.
std::vector<Plane> features(const Image& image) {
  const std::vector<Plane> channels = shrunken_channels(image);
  if (channels.size() < 3) return {high_passed(channels[0])};
  std::vector<Plane> opponents(3, Plane(channels[0].width, channels[0].height));
  for (std::size_t i = 0; i < opponents[0].values.size(); ++i) {
    const std::int32_t r = channels[0].values[i], g = channels[1].values[i], b = channels[2].values[i];
    opponents[0].values[i] = (r + g + b) / 3;
    opponents[1].values[i] = r - g;
    opponents[2].values[i] = b - (r + g) / 2;
  }
  for (Plane& plane : opponents) plane = high_passed(plane);
  return opponents;
}

Plane transposed(const Plane& plane) {
  Plane result(plane.height, plane.width);
  for (int y = 0; y < plane.height; ++y)
    for (int x = 0; x < plane.width; ++x) result.at(y, x) = plane.at(x, y);
  return result;
}

// Sums over runs along the rows: courses that waver by a texel, and bricks of many colors in one course,
// agree better. Runs that overlap by more than three quarters tell nothing new, so only some columns are
// kept.
Plane summed_along_rows(const Plane& plane, int run) {
  const int stride = std::max(1, run / 2);
  Plane result((plane.width + stride - 1) / stride, plane.height);
  for (int y = 0; y < plane.height; ++y) {
    std::int32_t sum = 0;
    for (int x = -run; x < plane.width; ++x) {
      if (x + run < plane.width) sum += plane.at(x + run, y);
      if (x - run - 1 >= 0) sum -= plane.at(x - run - 1, y);
      if (x >= 0 && x % stride == 0) result.at(x / stride, y) = sum;
    }
  }
  return result;
}

// The sum of products, in eight sums side by side so that vectors can be used: compilers keep the order.
double product(const double* a, const double* b, std::size_t count) {
  constexpr std::size_t lanes = 8;
  double sums[lanes] = {};
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes)
    for (std::size_t k = 0; k < lanes; ++k) sums[k] += a[i + k] * b[i + k];
  double sum = 0;
  for (; i < count; ++i) sum += a[i] * b[i];
  for (const double s : sums) sum += s;
  return sum;
}

// Normalised correlation of the plane with itself moved south by each lag of 0..height/2, -1 to 1.
std::vector<double> vertical_autocorrelation(const Plane& plane) {
  const auto width = static_cast<std::size_t>(plane.width);
  const auto height = static_cast<std::size_t>(plane.height);
  std::vector<double> result(height / 2 + 1);
  std::vector<double> values;
  std::vector<double> energy_above{0.0}; // of the rows before
  values.reserve(width * height);
  for (int y = 0; y < plane.height; ++y) {
    double energy = 0;
    for (int x = 0; x < plane.width; ++x) {
      values.push_back(plane.at(x, y));
      energy += values.back() * values.back();
    }
    energy_above.push_back(energy_above.back() + energy);
  }
  tbb::parallel_for(std::size_t{0}, result.size(), [&](std::size_t lag) {
    const std::size_t rows = height - lag;
    const double cross = product(values.data(), values.data() + lag * width, rows * width);
    const double first = energy_above[rows];
    const double second = energy_above[height] - energy_above[lag];
    const double energy = std::sqrt(first) * std::sqrt(second);
    result[lag] = energy > 0 ? cross / energy : 0.0;
  });
  return result;
}

// The correlation at a lag between whole ones; past the last, that of the last.
double interpolated(const std::vector<double>& correlation, double lag) {
  const std::size_t low = static_cast<std::size_t>(lag);
  if (low + 1 >= correlation.size()) return correlation.back();
  const double t = lag - static_cast<double>(low);
  return correlation[low] * (1 - t) + correlation[low + 1] * t;
}

int teeth_of(const std::vector<double>& correlation, double period) {
  return static_cast<int>(static_cast<double>(correlation.size() - 1) / period);
}

// The mean agreement at whole multiples of the period less that at the halves on both sides of each.
double comb(const std::vector<double>& correlation, double period) {
  const int teeth = teeth_of(correlation, period);
  double sum = 0;
  for (int k = 1; k <= teeth; ++k)
    sum += interpolated(correlation, k * period) - 0.5 * interpolated(correlation, (k - 0.5) * period) -
           0.5 * interpolated(correlation, (k + 0.5) * period);
  return teeth >= 2 ? sum / teeth : 0.0;
}

// The highest point of the comb within a quarter of a texel, to 1/64: the last tooth tells such fractions.
double refined(const std::vector<double>& correlation, double length) {
  double best = length;
  for (int step = -16; step <= 16; ++step) {
    const double other = length + step / 64.0;
    if (teeth_of(correlation, other) >= 2 && comb(correlation, other) > comb(correlation, best)) best = other;
  }
  return best;
}

struct Repeat {
  double length = 0;
  double strength = 0;
  double significance = 0;
};

// The first peak of the comb that reaches three quarters of the highest: a multiple of the true period scores
// much the same, a fraction of it far less.
Repeat strongest_repeat(const std::vector<double>& correlation) {
  const int first = 4 * shortest_period - 1, last = 2 * static_cast<int>(correlation.size() - 1);
  std::vector<double> scores; // at quarters of a texel
  for (int q = first; q <= last; ++q) scores.push_back(comb(correlation, q * 0.25));
  if (scores.size() < 3) return {};
  const double highest = *std::max_element(scores.begin(), scores.end());
  for (std::size_t i = 1; i + 1 < scores.size(); ++i) {
    if (scores[i] < 0.75 * highest || scores[i] < scores[i - 1] || scores[i] < scores[i + 1]) continue;
    const double length = refined(correlation, (first + static_cast<int>(i)) * 0.25);
    const double strength = comb(correlation, length);
    return {length, strength, strength * std::sqrt(static_cast<double>(teeth_of(correlation, length) - 1))};
  }
  return {};
}

// The mean of three rows, twice: uneven courses, a few texels off their places, still overlap.
Plane blurred_along_columns(const Plane& plane) {
  Plane result = plane;
  for (int pass = 0; pass < 2; ++pass) {
    const Plane before = result;
    for (int y = 0; y < plane.height; ++y)
      for (int x = 0; x < plane.width; ++x)
        result.at(x, y) = (before.at(x, std::max(0, y - 1)) + before.at(x, y) +
                           before.at(x, std::min(plane.height - 1, y + 1))) /
                          3;
  }
  return result;
}

// What repeats most clearly along the columns of any plane, in sums of runs of a `part` of the rows.
Repeat clearest_repeat(const std::vector<Plane>& planes, int part, bool blurred) {
  Repeat best;
  for (const Plane& plane : planes) {
    const Plane runs = summed_along_rows(plane, plane.width / part);
    const Repeat repeat =
        strongest_repeat(vertical_autocorrelation(blurred ? blurred_along_columns(runs) : runs));
    if (repeat.significance > best.significance) best = repeat;
  }
  return best;
}

constexpr int short_run = 56; // parts of a row
constexpr int long_run = 16;

struct FoundPeriod {
  Period period;
  bool uneven = false; // found in the blurred planes alone
};

// Short runs first: long ones blur a weave, whose rows alternate, to half its period.
FoundPeriod strongest_period(const std::vector<Plane>& planes) {
  for (const auto& [part, blurred] : {std::pair{short_run, false}, {long_run, false}, {long_run, true}}) {
    const Repeat best = clearest_repeat(planes, part, blurred);
    if (best.significance >= least_significance)
      return {{best.length, std::min(1.0, best.strength / 2)}, blurred};
  }
  return {};
}

// Normalised correlation of the plane with itself moved by a lag, -1 to 1; 0 where less than a quarter of it
// is left to compare.
double correlation_at(const Plane& plane, int dx, int dy) {
  if (2 * dx > plane.width || 2 * dy > plane.height) return 0;
  double cross = 0, first = 0, second = 0;
  for (int y = 0; y + dy < plane.height; ++y)
    for (int x = 0; x + dx < plane.width; ++x) {
      const double a = plane.at(x, y), b = plane.at(x + dx, y + dy);
      cross += a * b;
      first += a * a;
      second += b * b;
    }
  const double energy = std::sqrt(first) * std::sqrt(second);
  return energy > 0 ? cross / energy : 0.0;
}

// In a staggered lattice each course lies half a brick beside the last: half a brick along and one course
// down in any even number together bring joints onto joints, in an odd number onto bricks. How much better
// some even lags agree than the best of the odd ones: 0.20 for running bond, up to 0.09 for a floor of
// squares, less than 0 for cloth.
constexpr double least_stagger = 0.13;

double stagger(const std::vector<Plane>& planes, double half_brick, double course) {
  double most = 0;
  for (const Plane& plane : planes) {
    const auto at = [&](int i, int j) { // joints may be thinner than what rounding a lag is off by
      const double dx = i * half_brick, dy = j * course;
      double best = -1;
      for (const double x : {std::floor(dx), std::ceil(dx)})
        for (const double y : {std::floor(dy), std::ceil(dy)})
          best = std::max(best, correlation_at(plane, static_cast<int>(x), static_cast<int>(y)));
      return best;
    };
    most = std::max(most, (at(2, 0) + at(0, 2) + at(2, 2)) / 3 - std::max(at(2, 1), at(1, 2)));
  }
  return most;
}

// What repeats of both axes together: along one axis alone a staggered lattice seems to repeat after half a
// brick or a single course. `found` in texels of the planes.
Periodicity unstaggered(const std::vector<Plane>& planes, const Periodicity& found) {
  const double x = found.x.length, y = found.y.length;
  if (x <= 0 || y <= 0) return found;
  Periodicity result = found;
  double most = least_stagger;
  for (const auto& [half_brick, course] : {std::pair{x, y}, std::pair{x / 2, y}, std::pair{x, y / 2}}) {
    const double found_stagger = stagger(planes, half_brick, course);
    if (found_stagger <= most) continue;
    most = found_stagger;
    result.x.length = 2 * half_brick;
    result.y.length = 2 * course;
  }
  return result;
}

// Lines of any tones are easily taken for uneven courses. Followed to where they lie, planks are alike by 0.77 and
// such lines by 0.32.
constexpr double least_likeness = 0.5;

constexpr double nothing_but_lines = 0.9; // share of the variance; brushed metal 0.99, photos up to 0.7

// How far courses lie off even places. Where they are alike, following them also tells their mean distance better
// than the small planes do.
void measure_waver(const Image& image, CourseAxis axis, bool uneven, Period& period) {
  if (period.length <= 0) return;
  if (period.length < 4) { // no course that could waver
    period.waver = 0;
    return;
  }
  const Courses courses = followed_courses(image, axis, period.length);
  if (uneven && courses.likeness < least_likeness) period = {};
  if (courses.period <= 0 || period.length <= 0) return;
  period.waver = courses.waver();
  if (courses.likeness < least_likeness) return;
  period.length = courses.period;
  // Even courses whose drift over the whole sample is less than half a texel are as many whole texels apart.
  const double whole = std::round(period.length);
  if (period.waver < least_waver && std::abs(period.length - whole) * courses.off.height < 0.5)
    period.length = whole;
}

struct Side {
  int texels = 0;
  int periods = 0;
};

// Cost of a side: a step of e texels at every border is what is seen, so it counts squared and most; then how
// far the side is from what was asked; then the mip levels that an odd side would lose.
Side fitting_side(const Period& period, int wanted, int sample) {
  const int most = std::max(1, std::min(2 * wanted, sample / 2));
  const int least = std::min(most, std::max(4, wanted / 2));
  Side best{std::clamp(wanted, least, most), 0};
  if (period.length <= 0) return best;
  double best_cost = 1e30;
  for (int k = 1; k * period.length <= most + 0.5; ++k) {
    const double exact = k * period.length;
    for (int texels = static_cast<int>(exact) - 2; texels <= static_cast<int>(exact) + 3; ++texels) {
      if (texels < least || texels > most) continue;
      const double step = texels - exact;
      const double size = static_cast<double>(texels - wanted) / wanted;
      const double cost = step * step + 4 * size * size + 0.35 * std::max(0, 5 - halvings(texels));
      if (cost < best_cost) {
        best_cost = cost;
        best = {texels, k};
      }
    }
  }
  return best;
}

std::string described(const char* axis, const Period& period, const Side& side) {
  if (period.length <= 0) return fmt::format("no repeat along {}", axis);
  if (side.periods == 0)
    return fmt::format("a repeat of {:.2f} texels along {} that no allowed side holds", period.length, axis);
  return fmt::format("{} repeats of {:.2f} texels along {}", side.periods, period.length, axis);
}

} // namespace

int halvings(int side) {
  int count = 0;
  while (side > 1 && side % 2 == 0) {
    side /= 2;
    ++count;
  }
  return count;
}

Periodicity detect_periods(std::span<const SampleMap> samples) {
  if (samples.empty() || samples[0].image.width() < 32 || samples[0].image.height() < 32) return {};
  const Image& image = samples[0].image;
  const std::vector<Plane> rows = features(image);
  std::vector<Plane> columns;
  for (const Plane& plane : rows) columns.push_back(transposed(plane));
  const FoundPeriod x = strongest_period(columns), y = strongest_period(rows);
  Periodicity found = unstaggered(rows, {x.period, y.period});
  found.x.length *= shrink_of(image);
  found.y.length *= shrink_of(image);
  measure_waver(image, CourseAxis::x, x.uneven, found.x);
  measure_waver(image, CourseAxis::y, y.uneven, found.y);
  if (found.x.length <= 0 && share_of_lines(image, CourseAxis::x) >= nothing_but_lines)
    found.x.lines = image.width();
  if (found.y.length <= 0 && share_of_lines(image, CourseAxis::y) >= nothing_but_lines)
    found.y.lines = image.height();
  const ExactRepeat exact = exact_repeat(samples);
  if (exact.x > 0) found.x = {exact.x > 1 ? exact.x : 0.0, 1.0, true, 0.0};
  if (exact.y > 0) found.y = {exact.y > 1 ? exact.y : 0.0, 1.0, true, 0.0};
  return found;
}

int whole_periods(const Period& period, int side) {
  if (period.length <= 0) return 0;
  const double count = std::max(1.0, std::round(side / period.length));
  const double off = std::abs(side - count * period.length);
  return off <= std::max(0.75, 0.02 * period.length) ? static_cast<int>(count) : 0;
}

TileSizeAdvice fitting_tile_size(const Periodicity& periodicity, Size wanted, Size sample) {
  const Side x = fitting_side(periodicity.x, wanted.width, sample.width);
  const Side y = fitting_side(periodicity.y, wanted.height, sample.height);
  return {{x.texels, y.texels},
          {x.periods, y.periods},
          fmt::format("{} x {} texels: {}, {}", x.texels, y.texels, described("x", periodicity.x, x),
                      described("y", periodicity.y, y))};
}

} // namespace tilepack
