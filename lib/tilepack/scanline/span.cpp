#include "tilepack/scanline/span.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace tilepack {
namespace {

constexpr double steepest = 0x1p40;
constexpr double farthest_start = 0x1p61;

// c i + d rounded once, so its sign is that of the exact value.
double depth_at(const SpanCoefficients& run, int i) {
  return std::fma(run.c, static_cast<double>(i), run.d);
}

// Common factors cancel, so the coefficients may be scaled by a power of two: exact, and safe from overflow.
SpanCoefficients scaled(SpanCoefficients run) {
  const double largest = std::max(std::abs(run.c), std::abs(run.d));
  if (largest == 0) return run;
  const int exponent = -std::ilogb(largest);
  for (double* value : {&run.a1, &run.b1, &run.a2, &run.b2, &run.c, &run.d}) {
    *value = std::scalbn(*value, exponent);
  }
  return run;
}

double clamped(double value, double limit) {
  return std::isnan(value) ? 0.0 : std::clamp(value, -limit, limit);
}

TileCoordinate moved(TileCoordinate origin, double offset) {
  origin.fraction += clamped(offset, farthest_start);
  return normalised(origin);
}

// A pixel index near the horizon -d/c, corrected with the exact sign of the depth.
int last_in_front(const SpanCoefficients& run) {
  const double crossing = std::clamp(std::floor(-run.d / run.c), 0.0, static_cast<double>(run.count - 1));
  int i = static_cast<int>(crossing);
  while (i + 1 < run.count && depth_at(run, i + 1) > 0) ++i;
  while (i > 0 && depth_at(run, i) <= 0) --i;
  return i;
}

int first_in_front(const SpanCoefficients& run) {
  const double crossing = std::clamp(std::ceil(-run.d / run.c), 0.0, static_cast<double>(run.count - 1));
  int i = static_cast<int>(crossing);
  while (i > 0 && depth_at(run, i - 1) > 0) --i;
  while (i + 1 < run.count && depth_at(run, i) <= 0) ++i;
  return i;
}

} // namespace

Span make_span(const SpanCoefficients& given) {
  if (given.count < 0 || given.count > max_span_pixels) {
    throw std::invalid_argument("a span of " + std::to_string(given.count) + " pixels; 0 to " +
                                std::to_string(max_span_pixels) + " are possible");
  }
  for (double value : {given.a1, given.b1, given.a2, given.b2, given.c, given.d}) {
    if (!std::isfinite(value)) return {};
  }
  if (given.count == 0) return {};
  const SpanCoefficients run = scaled(given);
  const int end = run.count - 1;
  if (depth_at(run, 0) <= 0 && depth_at(run, end) <= 0) return {};

  Span span;
  span.direction = run.c > 0 ? -1 : 1;
  span.first = run.c > 0 ? end : 0;
  const int last = run.c > 0 ? first_in_front(run) : run.c < 0 ? last_in_front(run) : end;
  span.count = std::abs(last - span.first) + 1;

  const double depth = depth_at(run, span.first);
  const double u = std::fma(run.a1, static_cast<double>(span.first), run.b1) / depth;
  const double v = std::fma(run.a2, static_cast<double>(span.first), run.b2) / depth;
  span.u = moved(run.u_origin, u);
  span.v = moved(run.v_origin, v);
  // D/(depth²), written as (a - u c)/depth.
  span.du = clamped(span.direction * (run.a1 - u * run.c) / depth, steepest);
  span.dv = clamped(span.direction * (run.a2 - v * run.c) / depth, steepest);
  // Only a single pixel can be closer than one pixel to the horizon, and it needs no bend.
  span.bend = std::min(std::abs(run.c) / depth, 1.0);
  return span;
}

double horizon_distance(const Span& span, double n) {
  return span.bend > 0 ? 1 / span.bend - n : std::numeric_limits<double>::infinity();
}

double denominator(const Span& span, double n) {
  return std::max(std::fma(-span.bend, n, 1.0), 0x1p-53);
}

} // namespace tilepack
