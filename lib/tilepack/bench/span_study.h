#pragma once

#include "tilepack/scanline/span_batch.h"

#include <string>
#include <vector>

/// What the span methods get wrong, measured against long double: the figures behind `tilepack bench --spans`
/// and the advice there. No clock here; the same numbers on every machine.
namespace tilepack {

/// By how far the horizon lies behind the last pixel, and by length.
enum class SpanShape {
  nearly_straight, ///< 10^6 pixels behind; 1920 pixels, as all but the last two
  mild,            ///< as long as the span
  steep,           ///< 100 pixels: what a camera near the ground sees
  grazing,         ///< 5 pixels
  horizon_inside,  ///< inside the last pixel
  from_the_paper,  ///< [Cou]'s example: 101 pixels, 20 behind
  long_run,        ///< 16384 pixels, 1000 behind
};

struct SpanCase {
  SpanShape shape;
  std::string name;
  Span span;
};

/// Spans from nearly straight to one with the horizon in its last pixel; a texel of a 128-texel tile a pixel
/// at the near end. In the order of SpanShape, one each.
std::vector<SpanCase> span_cases();

struct SpanError {
  double pixels = 0; ///< largest, along the scanline
  double texels = 0; ///< largest, of level 0, on a 128-texel tile
  double bound = 0;  ///< the largest of the theorems' bounds at its pixels
  double beyond = 0; ///< by how many pixels rounding carries the error out of 0..bound, at most
  int worst = 0;     ///< n of the largest error in pixels
};

/// The errors of filling `span`, all pixels looked at.
SpanError span_error(const Span& span, const SpanOptions& options, SpanPrecision precision);

// ---- hard cases, also for the programs as [Cou] prints them

struct HardCase {
  std::string name;
  SpanCoefficients run;
};
std::vector<HardCase> hard_cases();

enum class StepMethod { division, listing1, listing2, euler2, newton, newton_direct, newton_general };
constexpr StepMethod all_contestants[] = {
    StepMethod::division, StepMethod::listing1,      StepMethod::listing2,      StepMethod::euler2,
    StepMethod::newton,   StepMethod::newton_direct, StepMethod::newton_general};
std::string_view name_of(StepMethod contestant); ///< the first three work on a, b, c, d as they are

/// The outcome of one coordinate: its largest error in pixels, and relative to its largest value; both
/// infinite if a value came out infinite or NaN. Pixels are 0 where the coordinate is constant (D = 0) or
/// moves by less than its own double rounding.
struct HardResult {
  double pixels = 0;
  double relative = 0;
};
HardResult run_contestant(StepMethod contestant, const HardCase& hard, SpanPrecision precision);

// ---- growth of errors along a span

struct ErrorCurve {
  std::string name;
  std::vector<double> n;        ///< pixel
  std::vector<double> total;    ///< |error| in pixels at or since the previous entry, at most
  std::vector<double> rounding; ///< the part of it that exact arithmetic does not have
  std::vector<double> bound;    ///< the theorem's, empty where none
};

/// 1/(cn + d) in float over `count` pixels, c = -1, horizon `behind` pixels after the last: Euler of both
/// orders, Newton with its coefficient computed afresh and added up (Listing 1), and the last two re-seeded.
std::vector<ErrorCurve> error_curves(int count, double behind, int reseed);

} // namespace tilepack
