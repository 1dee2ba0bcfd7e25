#include "tilepack/match/period_alignment.h"

#include <algorithm>
#include <cmath>

namespace tilepack {
namespace {

constexpr double even_waver =
    0.35; // texels: what is measured of courses that lie exactly even, with some noise

double kept(const Period& period, int side) {
  return whole_periods(period, side) > 0 ? period.length : 0.0;
}

} // namespace

PeriodAlignment::Axis::Axis(const Period& found, int tile)
    : period(kept(found, tile)), even(found.waver < even_waver), fixed(found.lines >= 2.0 * tile) {
  if (fixed) origin = (found.lines - tile) / 2;
}

PeriodAlignment::PeriodAlignment(const Periodicity& periodicity, Size tile)
    : x(periodicity.x, tile.width), y(periodicity.y, tile.height) {}

PeriodAlignment PeriodAlignment::through(SourceTexel texel) const {
  PeriodAlignment moved = *this;
  if (!x.fixed) moved.x.origin = texel.x;
  if (!y.fixed) moved.y.origin = texel.y;
  return moved;
}

PeriodAlignment PeriodAlignment::seen_from(SourceTexel place) const {
  PeriodAlignment moved = *this;
  moved.x.origin += place.x;
  moved.y.origin += place.y;
  return moved;
}

bool PeriodAlignment::allows(SourceTexel texel, int step) const {
  return x.allows(texel.x, step) && y.allows(texel.y, step);
}

SourceTexel PeriodAlignment::nearest(SourceTexel texel, SourceTexel low, SourceTexel high) const {
  return {x.nearest(texel.x, low.x, high.x), y.nearest(texel.y, low.y, high.y)};
}

bool PeriodAlignment::Axis::allows(int texel, int step) const {
  if (fixed) return std::abs(texel - origin) <= 0.5 * std::max(1, step);
  if (period <= 0.0) return true;
  const double off = std::abs(std::remainder(texel - origin, period));
  constexpr double rounding = 0.5 + 1e-6;
  return off <= std::max(even ? rounding : std::max(1.0, period / 64.0), 0.5 * step);
}

int PeriodAlignment::Axis::nearest(int texel, int low, int high) const {
  if (fixed) return std::clamp(static_cast<int>(std::lround(origin)), low, std::max(low, high));
  if (period <= 0.0) return texel;
  double place = texel - std::remainder(texel - origin, period);
  if (place < low) place += period;
  if (place > high) place -= period;
  return static_cast<int>(std::lround(place));
}

void rule_out_of_step(PositionMap& map, const PeriodAlignment& alignment, int scale) {
  if (alignment.free()) return;
  map.for_each([&](int x, int y, std::int64_t& value) {
    if (!alignment.allows({x * scale, y * scale}, scale)) value = ruled_out;
  });
}

} // namespace tilepack
