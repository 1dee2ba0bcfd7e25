#include "support/samples.h"

#include "tilepack/exemplar/object_scale.h"

#include <catch2/catch.hpp>

using namespace tilepack;
using testing::blobs;
using testing::features;

TEST_CASE("larger things have a larger scale") {
  double before = 0.0;
  for (const int reach : {1, 2, 4, 7, 10}) {
    const double scale = object_scale(features(blobs(192, 160, 5, 1, reach)));
    INFO("blobs of reach " << reach << " after a scale of " << before);
    CHECK(scale > 1.2 * before);
    // Means over squares a side apart have no noise in common.
    CHECK(scale > 0.6 * (2 * reach + 1));
    CHECK(scale < 1.1 * (2 * reach + 1));
    before = scale;
  }
}

TEST_CASE("the scale does not depend on contrast, brightness or slow shading") {
  const Image image = blobs(192, 160, 6, 1, 5);
  const double scale = object_scale(features(image));
  Image faint = image, shaded = image;
  for (float& v : faint.data()) v = 0.6f + 0.2f * v;
  for (int y = 0; y < 160; ++y)
    for (int x = 0; x < 192; ++x) {
      float& v = shaded.texel(x, y)[0];
      v = 0.5f * v + 0.5f * static_cast<float>(x) / 191.0f;
    }
  CHECK(object_scale(features(faint)) == Approx(scale).epsilon(0.02));
  CHECK(object_scale(features(shaded)) == Approx(scale).epsilon(0.1));
}

TEST_CASE("a flat sample has the least scale, and no sample more than the longest lag") {
  CHECK(object_scale(features(Image(40, 30, 3, 0.5f))) == 1.0);
  Image halves(256, 64, 1);
  for (int y = 0; y < 64; ++y)
    for (int x = 128; x < 256; ++x) halves.texel(x, y)[0] = 1.0f;
  CHECK(object_scale(features(halves)) <= largest_object_scale({256, 64}));
}
