#include "tilepack/numeric/exact_math.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace tilepack;

TEST_CASE("exact_log2 is the logarithm") {
  for (int e = -40; e <= 40; ++e) CHECK(exact_log2(std::ldexp(1.0, e)) == e);
  for (const double x : {0.3, 0.7, 1.5, 3.0, 10.0, 1e-5, 12345.678})
    CHECK(exact_log2(x) == Approx(std::log2(x)).margin(1e-11));
}

TEST_CASE("the others are what the C library has, to the last bits") {
  for (const double x : {1e-300, 1e-5, 0.3, 0.70710678, 1.0, 1.5, 3.0, 12345.678, 1e300})
    CHECK(exact_logarithm(x) == Approx(std::log(x)).epsilon(1e-15).margin(1e-15));
  const double pi = 3.14159265358979323846;
  for (double x = -0.5; x <= 0.5; x += 1.0 / 64)
    CHECK(exact_sine_of_half_turns(x) == Approx(std::sin(pi * x)).epsilon(1e-15).margin(1e-16));
  // The tangent's argument x is rounded here, four times by half a unit at most; near the pole that counts
  // x tan'(x) / tan(x) = x / (sin x cos x) times.
  for (double degrees = 1; degrees < 180; degrees += 1.7) {
    const double x = degrees / 360 * pi;
    const double condition = x / (std::sin(x) * std::cos(x));
    CHECK(exact_tangent_of_half(degrees) == Approx(std::tan(x)).epsilon(4 * 0x1p-53 * (2 + condition)));
  }
  for (double t = 0; t <= 1; t += 1.0 / 64)
    CHECK(exact_arctangent_in_degrees(t) == Approx(std::atan(t) * 180 / pi).epsilon(1e-15).margin(1e-15));
  for (const double x : {1e-12, 0.003, 0.5, 1.0, 2.0, 1e6}) {
    CHECK(exact_inverse_root<5>(x) == Approx(std::pow(x, -1.0 / 5)).epsilon(2e-15));
    CHECK(exact_inverse_root<12>(x) == Approx(std::pow(x, -1.0 / 12)).epsilon(2e-15));
  }
}
