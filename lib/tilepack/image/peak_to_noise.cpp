#include "tilepack/image/peak_to_noise.h"

#include "tilepack/numeric/exact_math.h"

#include <cmath>

namespace tilepack {

std::optional<double> peak_to_noise(double peak, double rms) {
  if (!(peak > 0) || !(rms > 0) || !std::isfinite(peak) || !std::isfinite(rms)) return {};
  constexpr double ln_10 = 2.30258509299404568402;
  return 20 * (exact_logarithm(peak) - exact_logarithm(rms)) / ln_10;
}

} // namespace tilepack
