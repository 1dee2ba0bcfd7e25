#include "tilepack/exemplar/fireflies.h"

#include <catch2/catch.hpp>

using namespace tilepack;
using Catch::Matchers::Contains;

namespace {

SampleMap light(Depth depth) {
  Image image(64, 64, 3);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x)
      for (float& v : image.texel(x, y)) v = 0.2f + 0.01f * static_cast<float>((x * 7 + y * 13) % 20);
  return {"color", Role::color, Encoding::linear, depth, image};
}

} // namespace

TEST_CASE("fireflies are found where they are, the brightest first") {
  SampleMap map = light(Depth::f32);
  CHECK(fireflies(map).empty());
  map.image.texel(12, 40)[1] = 80.0f;
  map.image.texel(0, 0)[0] = 9000.0f;
  const auto found = fireflies(map);
  REQUIRE(found.size() == 2);
  CHECK(found[0].x == 0);
  CHECK(found[1].x == 12);
  CHECK(found[1].y == 40);
  CHECK(found[1].times == Approx(80.0 / 0.39).epsilon(0.05));
  CHECK_THAT(listed(found), Contains("2 texels") && Contains("(12, 40)"));
  CHECK(listed({}).empty());
}

TEST_CASE("lamps, bright rows and integers are no fireflies") {
  SampleMap lamp = light(Depth::f16);
  for (int y = 20; y < 25; ++y)
    for (int x = 20; x < 25; ++x) lamp.image.texel(x, y)[0] = 100.0f;
  CHECK(fireflies(lamp).empty());
  SampleMap codes = light(Depth::u8);
  for (float& v : codes.image.data()) v *= 0.1f;
  codes.image.texel(3, 3)[0] = 1.0f;
  CHECK(fireflies(codes).empty());
}
