#pragma once

#include <bit>
#include <cstdint>

namespace tilepack {

/// Functions of which the C library's last bit may differ from one processor to another (it picks variants with
/// fused multiply-add). These are made of + - * / and square roots only, so that files and pictures come out
/// the same everywhere.

/// log2 of a finite x > 0, to 2^-40.
double exact_log2(double x);

/// The natural logarithm of a finite x > 0, to double precision.
double exact_logarithm(double x);

/// sin(pi x) for |x| <= 1/2, to double precision.
double exact_sine_of_half_turns(double x);

/// The tangent of half an angle of 0 < degrees < 180, to double precision.
double exact_tangent_of_half(double degrees);

/// The angle of 0..45 degrees whose tangent is t, 0 <= t <= 1, to double precision.
double exact_arctangent_in_degrees(double t);

/// x^(-1/n) for n = 5 and 12 and x > 0, to double precision: by Newton's iteration on y^-n = x, which divides
/// by constants only:
///   y <- y + y (1 - x y^n) / n,   with a relative error e turning into about (n + 1) / 2 e^2.
///
/// The start value divides the bit pattern, read as an integer, by -n. That pattern is the logarithm with the
/// mantissa taken linearly, which is 0 to 0.0861 octaves too low, for x as for y; the magic number centres the
/// error. n = 12: start 3.3e-2, then 7e-3, 3e-4, 6e-7, 2e-12, 3e-23. n = 5: start 3.6e-2, 4e-3, 5e-5, 6e-9,
/// 1e-16. Inline, since it runs once a texel.
template <int n>
double exact_inverse_root(double x) {
  static_assert(n == 5 || n == 12);
  constexpr double octave = 4503599627370496.0; // 2^52, one octave in the bit pattern
  constexpr double magic = octave * (1023.0 - 0.0430357) * (1.0 + 1.0 / n);
  const auto bits = static_cast<double>(std::bit_cast<std::int64_t>(x));
  double y = std::bit_cast<double>(static_cast<std::int64_t>(magic - bits * (1.0 / n)));
  for (int step = 0; step < (n == 12 ? 5 : 4); ++step) {
    // Split so that no factor leaves the range of doubles, however large x is.
    const double y2 = y * y;
    const double residual = n == 12 ? 1.0 - x * (y2 * y2 * y2) * (y2 * y2 * y2) : 1.0 - x * (y2 * y) * y2;
    y += y * residual * (1.0 / n);
  }
  return y;
}

} // namespace tilepack
