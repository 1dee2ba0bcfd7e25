#include "support/enlarged.h"
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

TEST_CASE("a large sample has the scale of its things, however many texels they are wide") {
  const Image small = blobs(520, 512, 9, 1, 7);
  const double scale = object_scale(features(small));
  CHECK(object_scale(features(testing::enlarged(small, 2))) == Approx(2 * scale).epsilon(0.05));
  CHECK(object_scale(features(testing::enlarged(small, 4))) == Approx(4 * scale).epsilon(0.05));
  CHECK(4 * scale > largest_object_scale({520, 512})); // which no look at full size can tell
  CHECK(largest_object_scale({2080, 2048}) == 4 * largest_object_scale({520, 512}));
  CHECK(largest_object_scale({4000, 1023}) == largest_object_scale({520, 512}));
}

TEST_CASE("grain stays grain, however large the sample") {
  const double scale = object_scale(features(blobs(256, 256, 4, 1, 1)));
  CHECK(object_scale(features(blobs(1024, 1024, 4, 1, 1))) == Approx(scale).epsilon(0.1));
}
