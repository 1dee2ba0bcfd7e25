#include "tilepack/image/encoding.h"

#include <catch2/catch.hpp>
#include <cfloat>
#include <cmath>
#include <limits>

using namespace tilepack;

namespace {

// IEC 61966-2-1 in extended precision.
long double exact_decode(long double v) {
  return v <= 0.04045L ? v / 12.92L : std::pow((v + 0.055L) / 1.055L, 2.4L);
}
long double exact_encode(long double v) {
  return v <= 0.0031308L ? v * 12.92L : 1.055L * std::pow(v, 1.0L / 2.4L) - 0.055L;
}

double relative_error(double value, long double exact) {
  return static_cast<double>(std::fabs((value - exact) / exact));
}

Image ramp(int codes) {
  Image image(codes, 1, 1);
  for (int i = 0; i < codes; ++i)
    image.data()[static_cast<std::size_t>(i)] = static_cast<float>(i) / static_cast<float>(codes - 1);
  return image;
}

} // namespace

TEST_CASE("every 8-bit and 16-bit code survives decoding and encoding") {
  for (const Depth depth : {Depth::u8, Depth::u16}) {
    const Image codes = ramp(depth == Depth::u8 ? 256 : 65536);
    const Image back = quantised(from_linear(to_linear(codes, Encoding::srgb), Encoding::srgb), depth);
    CHECK(back == codes);
    CHECK(quantised(codes, depth) == codes);
  }
}

TEST_CASE("the transfer curve agrees with its definition in extended precision") {
  double worst_decode = 0, worst_encode = 0;
  for (int i = 1; i <= 200000; ++i) {
    const double v = i / 100000.0; // up to 2
    worst_decode = std::max(worst_decode, relative_error(srgb_to_linear(v), exact_decode(v)));
    worst_encode = std::max(worst_encode, relative_error(linear_to_srgb(v), exact_encode(v)));
  }
  for (double v = 1e-300; v < 1e100; v *= 1.7) {
    worst_decode = std::max(worst_decode, relative_error(srgb_to_linear(v), exact_decode(v)));
    worst_encode = std::max(worst_encode, relative_error(linear_to_srgb(v), exact_encode(v)));
  }
  CHECK(worst_decode < 1e-14);
  CHECK(worst_encode < 1e-14);
}

TEST_CASE("the transfer curve rises, is odd, and keeps 0, 1 and what is not finite") {
  for (const auto curve : {srgb_to_linear, linear_to_srgb}) {
    double before = 0;
    for (int i = 1; i <= 65535 * 2; ++i) {
      const double value = curve(i / 65535.0);
      REQUIRE(value > before);
      REQUIRE(curve(-i / 65535.0) == -value);
      before = value;
    }
    CHECK(curve(0.0) == 0.0);
    CHECK(curve(1.0) == Approx(1.0).epsilon(1e-15));
    CHECK(std::isnan(curve(std::numeric_limits<double>::quiet_NaN())));
    CHECK(curve(std::numeric_limits<double>::infinity()) == std::numeric_limits<double>::infinity());
    CHECK(curve(-std::numeric_limits<double>::infinity()) == -std::numeric_limits<double>::infinity());
    CHECK(curve(DBL_MIN) > 0.0);
  }
  CHECK(relative_error(linear_to_srgb(DBL_MAX), exact_encode(DBL_MAX)) < 1e-14);
}

TEST_CASE("alpha is the last of two or four channels and stays linear") {
  for (int channels = 1; channels <= 4; ++channels) {
    const Image image(3, 2, channels, 0.5f);
    const Image linear = to_linear(image, Encoding::srgb), encoded = from_linear(image, Encoding::srgb);
    for (int c = 0; c < channels; ++c) {
      const bool alpha = channels % 2 == 0 && c == channels - 1;
      CHECK(linear.texel(2, 1)[static_cast<std::size_t>(c)] == (Approx(alpha ? 0.5 : 0.21404114)));
      CHECK(encoded.texel(2, 1)[static_cast<std::size_t>(c)] == (Approx(alpha ? 0.5 : 0.73535698)));
    }
    CHECK(to_linear(image, Encoding::linear) == image);
    CHECK(from_linear(image, Encoding::linear) == image);
  }
}

TEST_CASE("images are converted as single values are, wherever a value stands") {
  Image image(257, 203, 3); // more than one block of the parallel loop
  for (std::size_t i = 0; i < image.data().size(); ++i)
    image.data()[i] = static_cast<float>(i % 1009) / 700.0f - 0.2f;
  const Image linear = to_linear(image, Encoding::srgb), encoded = from_linear(image, Encoding::srgb);
  for (std::size_t i = 0; i < image.data().size(); ++i) {
    const auto v = static_cast<double>(image.data()[i]);
    REQUIRE(linear.data()[i] == static_cast<float>(srgb_to_linear(v)));
    REQUIRE(encoded.data()[i] == static_cast<float>(linear_to_srgb(v)));
  }
}

TEST_CASE("quantising clamps, rounds half up and takes NaN for 0 in integers") {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float inf = std::numeric_limits<float>::infinity();
  for (const Depth depth : {Depth::u8, Depth::u16}) {
    CHECK(quantised(-0.1f, depth) == 0.0f);
    CHECK(quantised(1.1f, depth) == 1.0f);
    CHECK(quantised(nan, depth) == 0.0f);
    CHECK(quantised(inf, depth) == 1.0f);
    CHECK(quantised(-inf, depth) == 0.0f);
  }
  CHECK(quantised(0.5f, Depth::u8) == 128.0f / 255.0f); // 127.5
  CHECK(quantised(0.4999f / 255.0f, Depth::u8) == 0.0f);
  CHECK(quantised(2049.0f, Depth::f16) == 2048.0f); // ties to even
  CHECK(quantised(2051.0f, Depth::f16) == 2052.0f);
  CHECK(quantised(0.1f, Depth::f32) == 0.1f);
}

TEST_CASE("encodings and depths have the names of pack.json") {
  CHECK(name_of(Encoding::srgb) == "srgb");
  CHECK(name_of(Encoding::linear) == "linear");
  CHECK(name_of(Depth::u8) == "u8");
  CHECK(name_of(Depth::u16) == "u16");
  CHECK(name_of(Depth::f16) == "f16");
  CHECK(name_of(Depth::f32) == "f32");
}
