#include "support/images.h"

#include "tilepack/image/resample.h"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>

using namespace tilepack;

namespace {

constexpr ResampleFilter all_filters[] = {ResampleFilter::bilinear, ResampleFilter::bicubic,
                                          ResampleFilter::lanczos};

} // namespace

TEST_CASE("resampling at a texel's centre gives the texel to the last bit") {
  const Image image = test::noise(9, 9, 1, 7, Depth::f32);
  for (const ResampleFilter filter : all_filters)
    for (int y = 0; y < 9; ++y)
      for (int x = 0; x < 9; ++x) {
        std::array<double, 1> out{};
        resample(image, x + 0.5, y + 0.5, filter, out);
        CHECK(static_cast<float>(out[0]) == image.texel(x, y)[0]);
      }
}

TEST_CASE("an image of one value resamples to exactly that value, beyond its borders too") {
  const Image image(5, 7, 1, 0.1f);
  for (const ResampleFilter filter : all_filters)
    for (double x = -9; x < 15; x += 0.37) {
      std::array<double, 1> out{};
      resample(image, x, 0.73 * x, filter, out);
      CHECK(out[0] == static_cast<double>(0.1f));
    }
}

TEST_CASE("every filter keeps a straight slope between its reach from the borders") {
  Image slope(16, 16, 1);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) slope.texel(x, y)[0] = static_cast<float>(3 * x - y);
  for (const ResampleFilter filter : all_filters)
    for (double x = 4; x < 12; x += 0.29) {
      std::array<double, 1> out{};
      resample(slope, x, 15 - x, filter, out);
      // Lanczos, normalised, bends a slope by up to three hundredths of a step.
      CHECK(out[0] ==
            Approx(3 * (x - 0.5) - (14.5 - x)).margin(filter == ResampleFilter::lanczos ? 0.09 : 1e-9));
    }
}

TEST_CASE("the Lanczos weights are those of the formula") {
  // An impulse reads the kernel back, up to the normalisation of the six weights on each axis.
  Image impulse(13, 1, 1);
  impulse.texel(6, 0)[0] = 1.0f;
  const double pi = std::acos(-1.0);
  const auto lanczos = [&](double x) {
    return x == 0              ? 1.0
           : std::fabs(x) >= 3 ? 0.0
                               : 3 * std::sin(pi * x) * std::sin(pi * x / 3) / (pi * pi * x * x);
  };
  for (double x = 3.6; x < 9.4; x += 0.13) {
    double sum = 0;
    for (int tap = 0; tap < 13; ++tap) sum += lanczos(x - (tap + 0.5));
    std::array<double, 1> out{};
    resample(impulse, x, 0.5, ResampleFilter::lanczos, out);
    CHECK(out[0] == Approx(lanczos(x - 6.5) / sum).margin(1e-14));
  }
}

TEST_CASE("filters are found by their names") {
  for (const ResampleFilter filter : all_filters)
    CHECK(enum_named<ResampleFilter>(name_of(filter)) == filter);
  CHECK_FALSE(enum_named<ResampleFilter>("gauss"));
}
