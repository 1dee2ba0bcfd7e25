#include "tilepack/image/peak_to_noise.h"

#include <cmath>

namespace tilepack {
namespace {

// ln x = e ln 2 + 2 (z + z³/3 + z⁵/5 + …), z = (m - 1) / (m + 1), for x = m 2^e with m within √2 of 1.
double natural_logarithm(double x) {
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

} // namespace

std::optional<double> peak_to_noise(double peak, double rms) {
  if (!(peak > 0) || !(rms > 0) || !std::isfinite(peak) || !std::isfinite(rms)) return {};
  constexpr double ln_10 = 2.30258509299404568402;
  return 20 * (natural_logarithm(peak) - natural_logarithm(rms)) / ln_10;
}

} // namespace tilepack
