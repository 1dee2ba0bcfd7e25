#include "tilepack/error/error.h"
#include "tilepack/measure/image_metrics.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

using namespace tilepack;

namespace {

// 24 x 17 texels of multiples of 8/255.
Image lattice(int twist, int channels = 1) {
  Image image(24, 17, channels);
  for (int y = 0; y < 17; ++y)
    for (int x = 0; x < 24; ++x)
      for (float& v : image.texel(x, y))
        v = static_cast<float>((x * 7 + y * 13 + twist * x * y) % 32 * 8) / 255.0f;
  return image;
}

} // namespace

TEST_CASE("equal images: infinite PSNR, SSIM 1, no difference") {
  const Image a = lattice(1, 3);
  const ImageDifference d = difference(a, a, FullRange::unit, 255);
  CHECK(d.equal);
  CHECK_FALSE(d.psnr);
  CHECK(d.ssim == Approx(1));
  CHECK(d.largest == 0);
  CHECK(d.differing == 0);
}

TEST_CASE("figures of a known pair, computed by the definitions in another program") {
  for (const int channels : {1, 2, 3, 4}) {
    const Image a = lattice(1, channels);
    const Image twisted = lattice(2, channels);
    Image b = a;
    for (std::size_t i = 0; i < b.data().size(); ++i)
      b.data()[i] = 0.75f * a.data()[i] + 0.25f * twisted.data()[i];
    const ImageDifference d = difference(a, b, FullRange::unit, 255);
    CHECK(d.psnr.value() == Approx(19.9951245).epsilon(1e-6));
    CHECK(d.ssim == Approx(0.9204577).epsilon(1e-5));
    CHECK(d.largest == Approx(60.0));
    CHECK(d.mean == Approx(19.8627451));
  }
}

TEST_CASE("one step of 8 bits in one of 64 values: 18 dB above the 48.13 of a step everywhere") {
  const Image a(8, 8, 1, 100.0f / 255.0f);
  Image b = a;
  b.texel(5, 6)[0] = 101.0f / 255.0f;
  const ImageDifference d = difference(a, b, FullRange::unit, 255);
  CHECK_FALSE(d.equal);
  CHECK(d.differing == 1);
  CHECK(d.largest == Approx(1).epsilon(1e-5));
  CHECK(d.largest_x == 5);
  CHECK(d.largest_y == 6);
  CHECK(d.rms == Approx(1.0 / 8).epsilon(1e-5));
  CHECK(d.psnr.value() == Approx(20 * std::log10(255.0 * 8)).epsilon(1e-5));
}

TEST_CASE("SSIM does not see a shift of brightness as it sees lost structure") {
  Image brighter = lattice(1);
  for (float& v : brighter.data()) v += 0.05f;
  const Image flat(24, 17, 1, 0.5f);
  CHECK(structural_similarity(lattice(1), brighter, 1) > 0.95);
  CHECK(structural_similarity(lattice(1), flat, 1) < 0.1);
}

TEST_CASE("images smaller than the window are compared with a smaller one") {
  for (const int side : {1, 2, 3, 10, 11}) {
    const Image a(side, 1, 1, 0.25f);
    const Image b(side, 1, 1, 0.75f);
    // Constant images: only the term of the means is left.
    CHECK(structural_similarity(a, b, 1) == Approx((2 * 0.25 * 0.75 + 1e-4) / (0.0625 + 0.5625 + 1e-4)));
  }
}

TEST_CASE("floats are held against their own range") {
  const Image a(4, 4, 1, 100.0f);
  const Image b(4, 4, 1, 99.0f);
  const ImageDifference d = difference(a, b, FullRange::unbounded, 1);
  CHECK(d.peak == 100);
  CHECK(d.largest == 1);
  CHECK(d.psnr.value() == Approx(40));
}

TEST_CASE("NaN and infinity are equal to themselves, and counted apart where only one image has them") {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  constexpr float infinity = std::numeric_limits<float>::infinity();
  Image a(4, 1, 1, 0.5f);
  a.texel(0, 0)[0] = nan;
  a.texel(1, 0)[0] = infinity;
  CHECK(difference(a, a, FullRange::unbounded, 1).equal);
  Image b = a;
  b.texel(1, 0)[0] = -infinity;
  b.texel(2, 0)[0] = nan;
  const ImageDifference d = difference(a, b, FullRange::unbounded, 1);
  CHECK_FALSE(d.equal);
  CHECK(d.differing == 2);
  CHECK(d.not_comparable == 2);
  CHECK(d.largest == 0);
  CHECK(std::isfinite(d.ssim));
}

TEST_CASE("images of different shape can't be compared") {
  CHECK_THROWS_AS(difference(Image(2, 2, 1), Image(2, 3, 1), FullRange::unit, 255), Error);
  CHECK_THROWS_AS(difference(Image(2, 2, 1), Image(2, 2, 3), FullRange::unit, 255), Error);
  CHECK_THROWS_AS(difference(Image(), Image(), FullRange::unit, 255), Error);
}

TEST_CASE("the picture shows the difference magnified, and in magenta what can't be compared") {
  Image a(3, 1, 1, 0.5f);
  Image b = a;
  b.texel(0, 0)[0] = 0.5f + 4.0f / 255.0f;
  b.texel(1, 0)[0] = std::numeric_limits<float>::quiet_NaN();
  const Image picture = difference_picture(a, b, 8);
  CHECK(picture.channels() == 3);
  CHECK(picture.texel(0, 0)[2] == Approx(32.0 / 255).epsilon(1e-4));
  CHECK(picture.texel(1, 0)[0] == 1);
  CHECK(picture.texel(1, 0)[1] == 0);
  CHECK(picture.texel(2, 0)[1] == 0);
}
