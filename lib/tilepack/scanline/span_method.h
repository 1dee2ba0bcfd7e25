#pragma once

#include "tilepack/scanline/span_options.h"

#include <span>

namespace tilepack {

/// The largest error in pixels (its size, for affine) `steps` pixels after a seed, at a pixel `distance`
/// pixels from the horizon; exact arithmetic. For Newton the fixed point of one step, (sqrt(s²+4) - s)/2,
/// which is sharper than the theorem's min(1, 1/s).   [Cou, Eq. 4.8]
double method_bound(SpanMethod method, double distance, int steps);

/// What rounding can add at pixel n, `steps` after a seed, in pixels: unit * (8 n + (steps + 4)(steps + 1)),
/// unit 2^-24 for float and 2^-53 for double; without the last product for the exact methods and
/// newton_direct.
///
/// Why: a step rounds once at the size of y, or of Newton's q where that is a sum; so after j steps
/// 1/(1 - bend n) is off by up to j units relative, j * unit / bend pixels; but it only scales an offset
/// which is itself j pixels long, and counts for j / (1/bend) of that.
double rounding_bound(SpanMethod method, int n, int steps, double unit);

/// The longest re-seeding interval (1..max_span_pixels) that keeps method_bound + rounding_bound at or below
/// `wanted` pixels over the whole span; 1 means an exact value at every pixel.
int reseed_interval(SpanMethod method, const Span& span, double wanted, double unit);

/// How many leading pixels of the span the method may step through. The rest, within a pixel or its worst
/// rounding of the horizon, where a recurrence that has drifted past it would blow up, is for exact division
/// in double precision. All methods and all implementations share this cut.
int steppable_pixels(const Span& span, const SpanOptions& options, double unit);

/// Offsets of pixels n = 0..count-1 from the span's start in tiles: u[n] = du * n / (1 - bend * n), v alike;
/// u and v hold span.count entries or more. Defined and finite for every Span of make_span.
///
/// Scalar code, one rounding an operation, so the same bits everywhere; Real is float or double. The affine
/// method's last piece ends at the last pixel. Throws Error (usage) for a reseed outside its range.
template <class Real>
void fill_span(const Span& span, const SpanOptions& options, std::span<Real> u, std::span<Real> v);

/// The exact offset at pixel n, in double precision.
double exact_offset(double slope, const Span& span, int n);

/// 1/x for x in 2^-100..2^100 without a division: an estimate within 12.5 % by subtracting the bits of x from
/// a constant, then Newton steps that square the relative error (3 for float, 5 for double).
float estimated_reciprocal(float x);
double estimated_reciprocal(double x);

} // namespace tilepack
