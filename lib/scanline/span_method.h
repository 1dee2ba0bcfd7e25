#pragma once

#include "tilepack/scanline/span.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace tilepack {

/// How 1/(1 - bend * n), the perspective of a span, is followed from pixel to pixel.
///
/// s is the distance in pixels from the pixel at hand to the horizon, m the number of steps since the last
/// exact value ("seed"). The bounds are of the error in pixels of the screen, before rounding.
enum class SpanMethod {
  exact,         ///< a division a pixel
  euler1,        ///< y += bend y²; error 0..ln((s+m+1)/(s+1))  [Cou, Theorem 3.1]
  euler2,        ///< y += bend y² + bend² y³; error 0..4m/((2s+1)(2s+2m+1)) < 2  [Cou, Theorem 3.2]
  newton,        ///< y = (q y + 2) y, q += bend; error 0..min(1, 1/s)  [Cou, Theorem 4.1, Listing 1]
  newton_direct, ///< as newton, q = bend (n + 1) - 1 computed afresh: a multiplication more, but no sum whose
                 ///< roundings pile up, so in float the one recurrence that truly corrects itself
  newton_general, ///< each coordinate by its own quadratic, same error  [Cou, Eq. 5.5, Listing 2]
  affine,         ///< straight lines between seeds; error -(sqrt(s+m) - sqrt(s))²..0
  estimate,       ///< a division's stand-in: a start value from the bits of the divisor, Newton steps to full
                  ///< precision; no error but rounding, the same bits on every processor
};

/// "exact", "euler1", "euler2", "newton", "newton-direct", "newton-general", "affine", "estimate".
std::string_view name_of(SpanMethod method);

/// The method of that name; Error (usage) that names the nearest one.
SpanMethod span_method_of(const std::string& name);

enum class SpanPrecision { f32, f64 };
std::string_view name_of(SpanPrecision precision); ///< "f32", "f64"

struct SpanOptions {
  SpanMethod method = SpanMethod::exact;
  int reseed =
      0; ///< pixels between exact values, 1..max_span_pixels; 0: only the first is exact (affine: 16)
};

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
