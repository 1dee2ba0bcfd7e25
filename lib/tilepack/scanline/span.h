#pragma once

#include "tilepack/sampler/address.h"

namespace tilepack {

/// Texture coordinates along a run of `count` pixels, as projection gives them, in tiles:
/// u(i) = u_origin + (a1 i + b1)/(c i + d), v(i) = v_origin + (a2 i + b2)/(c i + d), i = 0..count-1.
/// [Cou, Eq. 6.1] A pixel is in front of the horizon where c i + d > 0.
struct SpanCoefficients {
  double a1 = 0, b1 = 0;
  double a2 = 0, b2 = 0;
  double c = 0, d = 1;
  int count = 0; ///< 0..max_span_pixels
  TileCoordinate u_origin, v_origin;
};

constexpr int max_span_pixels = 65536;

/// The same in the form every span method works on. With n counted from the near end,
///
///     u(n) = u + du * n / (1 - bend * n),     v(n) = v + dv * n / (1 - bend * n)
///
///       near end                                                  horizon
///          n=0 ●──●──●──●──●── … ──●  n = count-1  ·  ·  ·  ·  ·  │ n = 1/bend
///
/// so a span is a start, its derivative there, and one number for the perspective: the reciprocal of the
/// distance to the horizon in pixels, 0 where depth does not change. Three things are gained over
/// (an + b)/(cn + d): the size of c and d no longer matters (nor does their overflow); a coordinate that
/// hardly changes (D = ad - bc near 0) is a small du and no division by D; and the start is kept apart in
/// full precision, so that float offsets suffice for any place of an unbounded plane: an offset rounded to a
/// relative 2^-24 is wrong by 2^-24 times the pixels left to the horizon.
struct Span {
  int first = 0;     ///< pixel i of n = 0
  int direction = 1; ///< +1 or -1: pixel i = first + direction * n
  int count = 0;     ///< pixels in front of the horizon; 0: nothing to draw
  TileCoordinate u, v;
  double du = 0, dv = 0; ///< tiles a pixel at n = 0, in the direction of growing n; |du| <= 2^40
  double bend = 0;       ///< 0..1; bend * (count - 1) < 1 up to rounding
};

/// Brings a run of pixels to that form, walked from its near end: reversed where c > 0. [Cou, section 2]
///
/// Pixels at or behind the horizon are left out. Coefficients that are NaN or infinite give an empty span;
/// starts beyond ±2^61 tiles and slopes beyond ±2^40 tiles a pixel, where one pixel covers any texture many
/// times over, are clamped there. Throws std::invalid_argument for a count outside 0..max_span_pixels.
Span make_span(const SpanCoefficients& run);

/// Pixels from pixel n of the span to its horizon; infinite where bend = 0.
double horizon_distance(const Span& span, double n);

/// 1 - bend * n, held at 2^-53 or more: with the horizon inside the last pixel rounding could give 0.
double denominator(const Span& span, double n);

} // namespace tilepack
