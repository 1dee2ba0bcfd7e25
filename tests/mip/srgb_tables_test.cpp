#include "tilepack/image/encoding.h"
#include "tilepack/mip/downsample.h"
#include "tilepack/mip/srgb_tables.h"
#include "tilepack/tileset/random.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace tilepack;

TEST_CASE("halving 8-bit codes by table equals decoding and halving, to the last bit") {
  for (const int channels : {1, 3}) {
    Image image(64, 6, channels);
    std::uint64_t index = 0;
    for (float& v : image.data()) v = static_cast<float>(random_below(1, "code", index++, 256)) / 255.0f;
    CHECK(halved_from_srgb(image) == halved(to_linear(image, Encoding::srgb), Weighting::plain));
    for (const float stray : {0.1234f, -0.5f, 3.0f, std::nextafter(0.5f, 1.0f)}) { // no codes of 8 bits
      image.data()[7] = stray;
      CHECK(halved_from_srgb(image) == halved(to_linear(image, Encoding::srgb), Weighting::plain));
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
  Image fast = values;
  encode_srgb(fast);
  double worst = 0;
  for (std::size_t i = 0; i < fast.data().size(); ++i)
    worst =
        std::max(worst, std::abs(static_cast<double>(fast.data()[i]) - static_cast<double>(exact.data()[i])));
  CHECK(worst < 1.0 / (1 << 22));
}

TEST_CASE("encoding gives back every 8-bit code, and leaves alpha alone") {
  for (int code = 0; code < 256; ++code) {
    const float value = static_cast<float>(code) / 255.0f;
    Image image(1, 1, 4, static_cast<float>(srgb_to_linear(static_cast<double>(value))));
    encode_srgb(image);
    CHECK(quantised(image.texel(0, 0)[0], Depth::u8) == value);
    CHECK(image.texel(0, 0)[3] == static_cast<float>(srgb_to_linear(static_cast<double>(value))));
  }
}

TEST_CASE("every instruction set gives the same bits, at any length") {
  const auto kernels = srgb_kernels();
  REQUIRE_FALSE(kernels.empty());
  for (const int width : {2, 6, 34, 514})
    for (const int channels : {1, 3}) {
      Image codes(width, 6, channels);
      std::uint64_t index = 0;
      for (float& v : codes.data()) v = static_cast<float>(random_below(2, "code", index++, 256)) / 255.0f;
      const Image linear = halved(to_linear(codes, Encoding::srgb), Weighting::plain);
      Image values(width, 3, channels);
      for (float& v : values.data()) // some of them off the curve's pieces
        v = static_cast<float>(random_below(3, "value", index++, 1 << 16)) / 60000.0f - 0.02f;
      Image encoded = values;
      encode_srgb(encoded, kernels.back());
      for (const SrgbKernel& kernel : kernels) {
        INFO(kernel.target << ' ' << width << " x " << channels);
        CHECK(halved_from_srgb(codes, kernel) == linear);
        Image got = values;
        encode_srgb(got, kernel);
        CHECK(got == encoded);
        Image strayed = codes;
        strayed.data().back() = 0.1234f;
        CHECK(halved_from_srgb(strayed, kernel) ==
              halved(to_linear(strayed, Encoding::srgb), Weighting::plain));
      }
    }
}
