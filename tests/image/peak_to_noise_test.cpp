#include "tilepack/image/peak_to_noise.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

using namespace tilepack;

TEST_CASE("the ratio of peak to noise is the logarithm's, to the rounding of doubles") {
  for (double peak : {1.0, 255.0, 65535.0, 1e-30, 1e30})
    for (double rms = 1e-12; rms < 1e12; rms *= 3.7)
      CHECK(peak_to_noise(peak, rms).value() ==
            Approx(20 * std::log10(peak / rms)).epsilon(1e-13).margin(1e-11));
  CHECK(peak_to_noise(3, 3) == 0.0);
}

TEST_CASE("without noise or peak there is no ratio") {
  const double inf = std::numeric_limits<double>::infinity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {0.0, -1.0, inf, nan}) {
    CHECK_FALSE(peak_to_noise(1, bad));
    CHECK_FALSE(peak_to_noise(bad, 1));
  }
}
