#include "support/images.h"

#include "tilepack/image/encoding.h"
#include "tilepack/mip/downsample.h"
#include "tilepack/mip/srgb_tables.h"
#include "tilepack/numeric/random.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace tilepack;

namespace {

// Rows of `image` by pairs, by the table; empty if some row refuses.
Image halved_by_table(const Image& image, const SrgbKernel& kernel) {
  Image result(image.width() / 2, image.height() / 2, image.channels());
  for (int y = 0; y < result.height(); ++y)
    if (!halve_srgb_codes(image.row(2 * y), image.row(2 * y + 1), image.channels(), result.row(y), kernel))
      return {};
  return result;
}

Image halved_plainly(const Image& image) {
  return halved(to_linear(image, Encoding::srgb),
                image.channels() % 2 == 0 ? Weighting::by_alpha : Weighting::plain);
}

Image encoded_by(const Image& linear, const SrgbKernel& kernel) {
  Image result = linear;
  encode_srgb(linear.data(), linear.channels(), result.data(), kernel);
  return result;
}

Image random_codes(int width, int height, int channels) {
  Image image = test::noise(width, height, channels, 1);
  for (int y = 0; y < 2; ++y) // where all is clear, color counts by quarters
    for (int x = 0; x < 2 && channels % 2 == 0; ++x) image.texel(x, y).back() = 0.0f;
  return image;
}

} // namespace

TEST_CASE("halving 8-bit codes by table equals decoding and halving, to the last bit") {
  const SrgbKernel best = srgb_kernels().front();
  for (const int channels : {1, 2, 3, 4}) {
    const Image image = random_codes(64, 6, channels);
    CHECK(halved_by_table(image, best) == halved_plainly(image));
  }
}

TEST_CASE("what is no 8-bit code is refused by the table") {
  for (const SrgbKernel& kernel : srgb_kernels())
    for (const int channels : {1, 2, 3, 4})
      for (const float stray :
           {0.1234f, -0.5f, -0.0f, 3.0f, std::nextafter(1.0f, 2.0f), 1e-3f, NAN, INFINITY}) {
        INFO(kernel.target << ' ' << channels << ' ' << stray);
        for (const std::size_t place : {7, 64 * channels + 11, 128 * channels - 1}) {
          Image image = random_codes(64, 2, channels);
          image.data()[place] = stray;
          CHECK(halved_by_table(image, kernel).empty());
        }
      }
}

TEST_CASE("encoding by parabolas is right to the precision of floats, everywhere") {
  Image values(1 << 12, 64, 1);
  const int count = static_cast<int>(values.data().size());
  for (int i = 0; i < count; ++i)
    values.data()[static_cast<std::size_t>(i)] =
        static_cast<float>(i) / static_cast<float>(count) * 1.05f - 0.01f;
  const Image exact = from_linear(values, Encoding::srgb);
  const Image fast = encoded_by(values, srgb_kernels().front());
  double worst = 0;
  for (std::size_t i = 0; i < fast.data().size(); ++i)
    worst =
        std::max(worst, std::abs(static_cast<double>(fast.data()[i]) - static_cast<double>(exact.data()[i])));
  CHECK(worst < 1.0 / (1 << 22));
}

TEST_CASE("encoding gives back every 8-bit code, and leaves alpha alone") {
  for (int code = 0; code < 256; ++code) {
    const float value = static_cast<float>(code) / 255.0f;
    const Image linear(1, 1, 4, static_cast<float>(srgb_to_linear(static_cast<double>(value))));
    Image image = linear;
    encode_srgb(image.data(), 4, image.data()); // in place
    CHECK(quantised(image.texel(0, 0)[0], Depth::u8) == value);
    CHECK(image.texel(0, 0)[3] == linear.texel(0, 0)[3]);
  }
}

TEST_CASE("every instruction set gives the same bits, at any length") {
  const auto kernels = srgb_kernels();
  REQUIRE_FALSE(kernels.empty());
  for (const int width : {2, 6, 34, 514})
    for (const int channels : {1, 2, 3, 4}) {
      const Image codes = random_codes(width, 6, channels);
      const Image linear = halved_plainly(codes);
      Image values(width, 3, channels);
      std::uint64_t index = 0;
      for (float& v : values.data()) // some of them off the curve's pieces
        v = static_cast<float>(random_below(3, "value", index++, 1 << 16)) / 60000.0f - 0.02f;
      values.data().front() = 1.0f;
      values.data().back() = 0.0f;
      const Image encoded = encoded_by(values, kernels.back());
      for (const SrgbKernel& kernel : kernels) {
        INFO(kernel.target << ' ' << width << " x " << channels);
        CHECK(halved_by_table(codes, kernel) == linear);
        CHECK(encoded_by(values, kernel) == encoded);
      }
    }
}

TEST_CASE("off the curve's pieces the exact curve is taken, to the last bit") {
  for (const float v : {-0.3f, -0.0f, 0.0f, 1e-30f, 0.001f, 0.0031307f, 0.0031308f, 0.0031309f, 0.0032f, 1.0f,
                        std::nextafter(1.0f, 2.0f), 7.5f, INFINITY}) {
    float encoded = 0;
    encode_srgb({&v, 1}, 1, {&encoded, 1});
    CHECK(encoded == static_cast<float>(linear_to_srgb(static_cast<double>(v))));
  }
}
