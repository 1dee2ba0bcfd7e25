#include "support/samples.h"

#include "tilepack/exemplar/feature_image.h"

#include <catch2/catch.hpp>

using namespace tilepack;
using testing::blobs;

TEST_CASE("an 8-bit color map's features are its codes") {
  const Image image = quantised(blobs(20, 10), Depth::u8);
  const SampleMap map = testing::color_map(image);
  const FeatureImage features = feature_image(std::span(&map, 1));
  REQUIRE(features.channels == 3);
  bool equal = true;
  for (std::size_t i = 0; i < image.data().size(); ++i)
    equal = equal && features.values[i] == static_cast<int>(image.data()[i] * 255.0f + 0.5f);
  CHECK(equal);
}

TEST_CASE("features of a linear map do not depend on exposure, and have no upper end") {
  SampleMap map{"light", Role::color, Encoding::linear, Depth::f32, blobs(30, 30)};
  map.image.texel(3, 4)[0] = 900.0f;
  SampleMap brighter = map;
  for (float& v : brighter.image.data()) v *= 64.0f;
  CHECK(feature_image(std::span(&map, 1)).values == feature_image(std::span(&brighter, 1)).values);
}

TEST_CASE("hidden color, constant channels and surplus channels are not looked at") {
  Image image = blobs(16, 16, 2, 4);
  for (int x = 0; x < 16; ++x) image.texel(x, 5)[3] = 0.0f;
  SampleMap map = testing::color_map(image);
  const FeatureImage features = feature_image(std::span(&map, 1));
  REQUIRE(features.channels == 4);
  for (int x = 0; x < 16; ++x) CHECK(features.texel(x, 5)[0] == 0);

  SampleMap flat = testing::color_map(Image(16, 16, 3, 0.5f));
  CHECK(feature_image(std::span(&flat, 1)).channels == 1);

  std::vector<SampleMap> many(6, map);
  CHECK(feature_image(many).channels == max_feature_channels);
}

TEST_CASE("a height map is stretched to its own range") {
  Image low(8, 1, 1);
  for (int x = 0; x < 8; ++x) low.texel(x, 0)[0] = 0.5f + 0.001f * static_cast<float>(x);
  const SampleMap map{"height", Role::height, Encoding::linear, Depth::u16, low};
  const FeatureImage features = feature_image(std::span(&map, 1));
  CHECK(features.texel(0, 0)[0] == 0);
  CHECK(features.texel(7, 0)[0] == 159); // 255 * 5/8
}

TEST_CASE("halving takes the mean of two by two and drops an odd last row") {
  const FeatureImage image{4, 3, 1, {1, 2, 10, 20, 3, 4, 30, 40, 99, 99, 99, 99}};
  const FeatureImage half = halved(image);
  CHECK(half.width == 2);
  CHECK(half.height == 1);
  CHECK(half.values == std::vector<std::uint8_t>{3, 25});
}

TEST_CASE("a few sparks change neither the brightness of a linear map nor the range of a height map") {
  SampleMap light{"light", Role::color, Encoding::linear, Depth::f32, blobs(60, 60)};
  SampleMap height{"height", Role::height, Encoding::linear, Depth::f32, blobs(60, 60, 3, 1)};
  SampleMap bright = light, high = height;
  for (const int x : {5, 25, 45}) {
    for (float& v : bright.image.texel(x, 30)) v = 1e6f;
    high.image.texel(x, 30)[0] = 40.0f;
  }
  const auto largest_change = [](const SampleMap& a, const SampleMap& b) {
    const FeatureImage before = feature_image(std::span(&a, 1)), after = feature_image(std::span(&b, 1));
    int most = 0;
    for (int y = 0; y < 60; ++y)
      for (int x = 0; x < 60; ++x)
        if (y != 30 || x % 20 != 5)
          most = std::max(most, std::abs(before.texel(x, y)[0] - after.texel(x, y)[0]));
    return most;
  };
  CHECK(largest_change(light, bright) <= 3);
  CHECK(largest_change(height, high) <= 40); // of 159: a quarter of the usual range is kept for them
}
