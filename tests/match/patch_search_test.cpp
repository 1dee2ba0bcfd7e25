#include "support/images.h"
#include "support/samples.h"

#include "tilepack/match/patch_search.h"

#include <catch2/catch.hpp>

using namespace tilepack;

TEST_CASE("mismatches by Fourier transform equal those counted texel by texel") {
  struct Case {
    int width, height, channels, patch_width, patch_height;
  };
  for (const Case& c :
       {Case{37, 23, 3, 9, 5}, Case{16, 16, 1, 16, 16}, Case{41, 50, 4, 1, 1}, Case{64, 30, 16, 30, 30}}) {
    const FeatureImage image = test::noise_features(c.width, c.height, c.channels, 3);
    const FeatureImage layers = test::noise_features(c.patch_width, c.patch_height, c.channels, 4);
    Overlap overlap(c.patch_width, c.patch_height, c.channels);
    std::vector<int> weights;
    for (int y = 0; y < c.patch_height; ++y)
      for (int x = 0; x < c.patch_width; ++x) {
        weights.push_back(static_cast<int>(random_below(5, "weight", weights.size(), 65)));
        overlap.add(x, y, layers.texel(x, y), weights.back());
        overlap.add(x, y, layers.texel(0, 0), 1);
      }
    const PositionMap map = PatchSearch(image).mismatches(overlap);
    REQUIRE(map.width == c.width - c.patch_width + 1);
    REQUIRE(map.height == c.height - c.patch_height + 1);
    bool equal = true;
    for (int y = 0; y < map.height; ++y)
      for (int x = 0; x < map.width; ++x) {
        std::int64_t sum = 0;
        for (int j = 0; j < c.patch_height; ++j)
          for (int i = 0; i < c.patch_width; ++i) {
            const auto* texel = image.texel(x + i, y + j);
            sum += std::int64_t{weights[static_cast<std::size_t>(j * c.patch_width + i)]} *
                   squared_difference(texel, layers.texel(i, j), c.channels);
            sum += squared_difference(texel, layers.texel(0, 0), c.channels);
          }
        equal = equal && sum == map.at(x, y);
      }
    CHECK(equal);
  }
}

TEST_CASE("a patch taken from the image is found where it was taken") {
  const FeatureImage image = test::noise_features(60, 44, 3, 9);
  Overlap overlap(12, 8, 3);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 12; ++x) overlap.add(x, y, image.texel(31 + x, 17 + y));
  const PositionMap map = PatchSearch(image).mismatches(overlap);
  CHECK(map.at(31, 17) == 0);
  REQUIRE(map.parts.size() == 1);
  CHECK(std::count(map.parts[0].values.begin(), map.parts[0].values.end(), 0) == 1);
}

TEST_CASE("of a large image four parts are searched, and what is found there is what a full search finds") {
  const FeatureImage image = test::noise_features(200, 160, 2, 9);
  Overlap overlap(20, 12, 2);
  for (int y = 0; y < 12; ++y)
    for (int x = 0; x < 20; ++x) overlap.add(x, y, image.texel(40 + x, 30 + y));
  const PositionMap all = PatchSearch(image).mismatches(overlap);
  PositionMap parts = PatchSearch(image, {20, 12}, 8'000).mismatches(overlap);
  REQUIRE((parts.width == all.width && parts.height == all.height));
  // 8000 of 32000 texels: a half of each side, in two parts.
  std::size_t open = 0;
  bool equal = true;
  parts.for_each([&](int x, int y, std::int64_t& value) {
    ++open;
    equal = equal && value == all.at(x, y) && value == parts.at(x, y);
  });
  CHECK(equal);
  CHECK(open == 4 * (50 - 20 + 1) * (40 - 12 + 1));
  CHECK(parts.at(40, 30) == 0);
  CHECK(parts.at(0, 0) == ruled_out);
  CHECK(parts.at(90, 30) == ruled_out); // between two parts
  // Small images are searched whole, and parts hold patches of the size asked for with room to choose.
  CHECK(PatchSearch(image, {20, 12}, 32'000).mismatches(overlap).parts[0].values == all.parts[0].values);
  const auto positions = [&](Size largest) {
    std::size_t count = 0;
    for (const auto& part : PatchSearch(image, largest, 1).mismatches(overlap).parts)
      count += part.values.size();
    return count;
  };
  CHECK(positions({20, 12}) == 4 * (40 - 20 + 1) * (24 - 12 + 1));
  // Parts that would overlap are one: 200 columns wide, twice 24 rows high.
  CHECK(positions({60, 12}) == 2 * (200 - 20 + 1) * (24 - 12 + 1));
}
