#include "tilepack/numeric/exact_math.h"

#include <cmath>

namespace tilepack {

double exact_log2(double x) {
  // Squaring the mantissa doubles its logarithm: each time it passes 2, the next binary digit is 1.
  int exponent = 0;
  double mantissa = std::frexp(x, &exponent) * 2.0; // 1 <= mantissa < 2
  double result = exponent - 1;
  for (double digit = 0.5; digit > 0x1p-40 && mantissa != 1.0; digit *= 0.5) {
    mantissa *= mantissa;
    if (mantissa < 2.0) continue;
    mantissa *= 0.5;
    result += digit;
  }
  return result;
}

// ln x = e ln 2 + 2 (z + z³/3 + z⁵/5 + …), z = (m - 1) / (m + 1), for x = m 2^e with m within √2 of 1.
double exact_logarithm(double x) {
  int exponent = 0;
  double mantissa = std::frexp(x, &exponent);
  if (mantissa < 0.70710678118654752) {
    mantissa *= 2;
    --exponent;
  }
  const double z = (mantissa - 1) / (mantissa + 1);
  double sum = 0;
  for (int term = 12; term >= 0; --term) sum = 1.0 / (2 * term + 1) + z * z * sum;
  constexpr double ln_2 = 0.69314718055994530942;
  return exponent * ln_2 + 2 * z * sum;
}

double exact_sine_of_half_turns(double x) {
  constexpr double pi = 3.14159265358979323846;
  const double squared = pi * x * pi * x;
  double sum = 0;
  for (int term = 19; term >= 3; term -= 2) sum = (1.0 - sum) * squared / (term * (term - 1));
  return pi * x * (1.0 - sum);
}

// Sine and cosine by their sums. Past 45° the angle to 90° is used, where the cosine's sum would lose its
// leading digits.
double exact_tangent_of_half(double degrees) {
  constexpr double right_angle = 1.57079632679489661923;
  const bool steep = degrees > 90;
  const double x = (steep ? 180 - degrees : degrees) / 180 * right_angle;
  double sine = 0, cosine = 0, term = 1;
  for (int k = 0; k < 24; ++k) {
    (k % 2 == 0 ? cosine : sine) += k % 4 < 2 ? term : -term;
    term *= x / (k + 1);
  }
  return steep ? cosine / sine : sine / cosine;
}

// Halving the angle three times, tan(a/2) = t / (1 + sqrt(1 + t²)), brings t below 0.099, where 12 terms of the
// series are exact to double precision.
double exact_arctangent_in_degrees(double t) {
  for (int halving = 0; halving < 3; ++halving) t = t / (1.0 + std::sqrt(1.0 + t * t));
  double sum = 0;
  for (int term = 11; term >= 0; --term) sum = 1.0 / (2 * term + 1) - t * t * sum;
  constexpr double degrees_per_radian = 57.295779513082320877;
  return 8.0 * t * sum * degrees_per_radian;
}

} // namespace tilepack
