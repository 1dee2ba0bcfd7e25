#include "tilepack/exemplar/straighten.h"

#include "tilepack/exemplar/courses.h"
#include "tilepack/image/resample.h"
#include "tilepack/tileset/value_space.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

namespace tilepack {
namespace {

constexpr double most_stretch = 0.025; // of the whole
constexpr double clearer = 1.03;       // the strength of the repeat after against before
constexpr double as_clear = 0.97;      // the same where only the length is to fit
constexpr double least_misfit = 0.3;   // texels, a step at every border of a tile that shows in thin lines
constexpr double off_length = 0.02;    // by which the repeat found after may differ in length
constexpr int wished_halvings = 5;

// The length near `period` of which a side that is allowed holds a whole number: little stretched, near the side
// that is wanted, and halving often.
struct FittingPeriod {
  double length = 0;
  double misfit = 0; // texels by which the side is off whole periods as they are
};

FittingPeriod fitting_period(double period, int least, int wanted, int most) {
  FittingPeriod best{period, 0.0};
  double lowest = 1e30;
  for (int side = least; side <= most; ++side) {
    const int count = static_cast<int>(std::lround(side / period));
    if (count < 1) continue;
    const double stretch = (side / (count * period) - 1) / most_stretch;
    if (std::abs(stretch) > 1) continue;
    const double size = static_cast<double>(side - wanted) / wanted;
    const double cost =
        stretch * stretch + 4 * size * size + 0.35 * std::max(0, wished_halvings - halvings(side));
    if (cost >= lowest) continue;
    lowest = cost;
    best = {static_cast<double>(side) / count, std::abs(side - count * period)};
  }
  if (lowest == 1e30 && std::abs(std::round(period) / period - 1) <= most_stretch)
    best.length = std::round(period);
  return best;
}

// By how many texels the side nearest to whole periods is off them; 0 where no side holds any.
double misfit_as_is(double period, int least, int wanted, int most) {
  double nearest = 1e30;
  for (int count = 1; count * period <= most + 0.5; ++count) {
    const int side = static_cast<int>(std::lround(count * period));
    if (side >= least && side <= most) nearest = std::min(nearest, std::abs(side - count * period));
  }
  // The side that is asked for, and no other, need only be near.
  if (least == most && nearest == 1e30 && std::lround(wanted / period) >= 1) {
    const double off = std::abs(wanted - static_cast<double>(std::lround(wanted / period)) * period);
    if (off <= most_stretch * wanted) nearest = off;
  }
  return nearest == 1e30 ? 0.0 : nearest;
}

// Along one axis: a place of the straight sample, along and across, to where that lies in the sample as it came.
struct AxisWarp {
  std::optional<Courses> courses;
  double stretch = 1;

  double source(double along, double across) const {
    if (!courses) return along;
    const double even = along / stretch;
    return even + courses->at(even, across);
  }
};

struct Warp {
  AxisWarp x, y;
  double left = 0, top = 0; // of the straight sample: what is cut off
  Size size;                // of what is left

  std::pair<double, double> source(double i, double j) const {
    const double u = i + left, v = j + top;
    // Displacements are small and smooth: those at the unmoved place across do for both.
    return {x.source(u, v / y.stretch), y.source(v, u / x.stretch)};
  }
};

// Cuts off along one axis what lies beyond the sample, anywhere across.
std::pair<double, int> kept(const AxisWarp& warp, int length, int side) {
  if (!warp.courses) return {0.0, length};
  const int longer = static_cast<int>(length * warp.stretch);
  const auto inside = [&](int i) {
    for (int across = 0; across <= 16; ++across) {
      const double at = warp.source(i + 0.5, across / 16.0 * side);
      if (at < 0.5 || at > length - 0.5) return false;
    }
    return true;
  };
  int first = 0, last = longer;
  while (first < longer / 2 && !inside(first)) ++first;
  while (last > longer / 2 && !inside(last - 1)) --last;
  return {first, last - first};
}

Warp warp_of(AxisWarp x, AxisWarp y, Size size) {
  Warp warp{std::move(x), std::move(y), 0, 0, {}};
  const auto [left, width] = kept(warp.x, size.width, size.height);
  const auto [top, height] = kept(warp.y, size.height, size.width);
  warp.left = left;
  warp.top = top;
  warp.size = {width, height};
  return warp;
}

// How the source moves with the straight sample's texels: the columns of the warp's Jacobian.
struct Jacobian {
  double xx = 1, xy = 0, yx = 0, yy = 1; // d source x / d x, d source x / d y, …
};

Jacobian jacobian_at(const Warp& warp, double i, double j) {
  const auto [west, west_y] = warp.source(i - 0.5, j);
  const auto [east, east_y] = warp.source(i + 0.5, j);
  const auto [north_x, north] = warp.source(i, j - 0.5);
  const auto [south_x, south] = warp.source(i, j + 0.5);
  return {east - west, south_x - north_x, east_y - west_y, south - north};
}

// The slopes of a height field whose places are warped: those of the source, by the chain rule. A vector that points
// down has none and stays.
void turn(std::span<double> stored, const Jacobian& d) {
  const double nx = 2 * stored[0] - 1, ny = 2 * stored[1] - 1, nz = 2 * stored[2] - 1;
  if (nz <= 0) return;
  const double slope_x = -nx / nz, slope_y = ny / nz; // x east, y south; green points north
  const double x = d.xx * slope_x + d.yx * slope_y, y = d.xy * slope_x + d.yy * slope_y;
  stored[0] = 0.5 - 0.5 * x * nz;
  stored[1] = 0.5 + 0.5 * y * nz;
}

// Where there is alpha it weighs the colors, as everywhere.
Image weighed_by_alpha(const Image& image) {
  Image weighed = image;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      const auto texel = weighed.texel(x, y);
      for (std::size_t c = 0; c + 1 < texel.size(); ++c) texel[c] *= texel.back();
    }
  return weighed;
}

// The least and largest value of each channel: the filter swings a little beyond them where values jump.
struct Range {
  std::array<float, 4> least{}, most{};
};

Range range_of(const Image& image) {
  Range range;
  const auto first = image.texel(0, 0);
  std::copy(first.begin(), first.end(), range.least.begin());
  range.most = range.least;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      const auto texel = image.texel(x, y);
      for (std::size_t c = 0; c < texel.size(); ++c) {
        range.least[c] = std::min(range.least[c], texel[c]);
        range.most[c] = std::max(range.most[c], texel[c]);
      }
    }
  return range;
}

Image warped(const SampleMap& map, const Warp& warp, ResampleFilter filter) {
  const ValueSpace space = value_space(map);
  const bool alpha = space.has_alpha();
  const Image from = alpha ? weighed_by_alpha(map.image) : map.image;
  Image result(warp.size.width, warp.size.height, from.channels());
  const auto channels = static_cast<std::size_t>(from.channels());
  const Range range = range_of(map.image);
  tbb::parallel_for(0, warp.size.height, [&](int j) {
    std::array<double, 4> value{};
    std::array<double, 4> plain{};
    for (int i = 0; i < warp.size.width; ++i) {
      const auto [x, y] = warp.source(i + 0.5, j + 0.5);
      const std::span<double> values(value.data(), channels);
      resample(from, x, y, filter, values);
      if (alpha) {
        const double coverage = value[channels - 1];
        if (coverage <= 1e-6) resample(map.image, x, y, filter, std::span<double>(plain.data(), channels));
        for (std::size_t c = 0; c + 1 < channels; ++c)
          value[c] = coverage > 1e-6 ? value[c] / coverage : plain[c];
      }
      if (space.has_vectors()) turn(values, jacobian_at(warp, i + 0.5, j + 0.5));
      const auto texel = result.texel(i, j);
      for (std::size_t c = 0; c < channels; ++c)
        texel[c] = space.has_vectors()
                       ? static_cast<float>(value[c])
                       : std::clamp(static_cast<float>(value[c]), range.least[c], range.most[c]);
      if (space.has_vectors()) renormalise(texel);
    }
  });
  return quantised(result, map.depth);
}

struct Found {
  AxisWarp warp;
  Period period;
  double moved = 0;
};

// What straightens one axis, if that makes its repeat clearer.
Found found_along(const SampleMap& map, CourseAxis axis, const Period& period, int least, int wanted,
                  int most) {
  Found none;
  if (period.length <= 0) return none;
  Courses courses = followed_courses(map.image, axis, period.length);
  if (courses.period <= 0) return none;
  const FittingPeriod fitting = fitting_period(courses.period, least, wanted, most);
  const bool uneven = courses.waver() >= least_waver;
  if (!uneven && misfit_as_is(courses.period, least, wanted, most) < least_misfit) return none;
  const bool along_x = axis == CourseAxis::x;
  Found found;
  const double target = fitting.length;
  found.warp.stretch = target / courses.period;
  found.moved = fitting.misfit;
  for (const double d : courses.off.values) found.moved = std::max(found.moved, std::abs(d));
  found.warp.courses = std::move(courses);
  const Warp alone =
      along_x ? warp_of(found.warp, {}, map.image.size()) : warp_of({}, found.warp, map.image.size());
  SampleMap straight = map;
  straight.image = warped(map, alone, ResampleFilter::bilinear);
  const Periodicity after = detect_periods(std::span<const SampleMap>(&straight, 1));
  const Period& repeat = along_x ? after.x : after.y;
  if (repeat.strength < (uneven ? clearer : as_clear) * period.strength ||
      std::abs(repeat.length / target - 1) > off_length)
    return none;
  found.period = {target, repeat.strength, false, 0.0};
  return found;
}

} // namespace

Straightened straightened(std::span<const SampleMap> samples, const Periodicity& periods,
                          const TileSides& sides) {
  Straightened result;
  result.periods = periods;
  if (samples.empty()) return result;
  Found x = found_along(samples[0], CourseAxis::x, periods.x, sides.least.width, sides.wanted.width,
                        sides.most.width);
  Found y = found_along(samples[0], CourseAxis::y, periods.y, sides.least.height, sides.wanted.height,
                        sides.most.height);
  if (!x.warp.courses && !y.warp.courses) return result;
  if (x.warp.courses) result.periods.x = x.period;
  if (y.warp.courses) result.periods.y = y.period;
  result.moved = std::max(x.moved, y.moved);
  result.stretch_x = x.warp.stretch;
  result.stretch_y = y.warp.stretch;
  const Warp warp = warp_of(std::move(x.warp), std::move(y.warp), samples[0].image.size());
  if (warp.size.width < sides.least.width || warp.size.height < sides.least.height)
    return {{}, periods, 0, 1, 1};
  for (const SampleMap& map : samples) {
    SampleMap straight = map;
    straight.image = warped(map, warp, ResampleFilter::bicubic);
    result.maps.push_back(std::move(straight));
  }
  return result;
}

} // namespace tilepack
