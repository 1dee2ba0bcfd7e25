#include "tilepack/scanline/series.h"

#include <cmath>
#include <limits>

namespace tilepack {
namespace {

constexpr double ln2 = 0.69314718055994530942;

// ln m for m in [1/sqrt 2, sqrt 2] as 2 artanh z, z = (m-1)/(m+1), |z| < 0.172: z^2k < 1e-17 for k = 11.
double ln_of_mantissa(double m) {
  const double z = (m - 1) / (m + 1);
  const double z2 = z * z;
  double sum = 0;
  for (int k = 11; k >= 0; --k) sum = sum * z2 + 1.0 / (2 * k + 1);
  return 2 * z * sum;
}

} // namespace

double repeatable_ln(double x) {
  if (x == 0) return -std::numeric_limits<double>::infinity();
  int exponent = 0;
  double m = std::frexp(x, &exponent);
  if (m < 0.70710678118654752440) {
    m *= 2;
    --exponent;
  }
  return ln_of_mantissa(m) + exponent * ln2;
}

double repeatable_log2(double x) {
  if (x == 0) return -std::numeric_limits<double>::infinity();
  int exponent = 0;
  double m = std::frexp(x, &exponent);
  if (m < 0.70710678118654752440) {
    m *= 2;
    --exponent;
  }
  return ln_of_mantissa(m) / ln2 + exponent;
}

double tangent_of_half(double degrees) {
  // Taylor sums of sine and cosine at an angle below pi/2; past 45° the angle to 90° is used, because the
  // cosine's sum would lose its leading digits there.
  constexpr double quarter_turn = 1.57079632679489661923;
  const bool steep = degrees > 90;
  const double x = (steep ? 180 - degrees : degrees) / 180 * quarter_turn;
  double sine = 0, cosine = 0, term = 1;
  for (int k = 0; k < 24; ++k) {
    const double sign = k % 4 < 2 ? 1 : -1;
    (k % 2 == 0 ? cosine : sine) += sign * term;
    term *= x / (k + 1);
  }
  return steep ? cosine / sine : sine / cosine;
}

} // namespace tilepack
