#include "support/samples.h"

#include "tilepack/error/error.h"
#include "tilepack/transition/joined_samples.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <vector>

using namespace tilepack;
using Catch::Matchers::Contains;

namespace {

using Maps = std::vector<SampleMap>;

Maps material(int width, int height, std::uint64_t seed, bool with_height = false) {
  Maps maps{testing::color_map(test::noise(width, height, 3, seed))};
  if (with_height)
    maps.push_back({"height", Role::height, Encoding::linear, Depth::u16,
                    test::noise(width, height, 1, seed + 100, Depth::u16)});
  return maps;
}

JoinedSamples joined_of(const std::vector<Maps>& materials) {
  std::vector<std::span<const SampleMap>> list(materials.begin(), materials.end());
  return joined(list);
}

} // namespace

TEST_CASE("joined samples hold each material's maps in register, and nothing of one lies beside another",
          "[exemplar]") {
  const std::vector<Maps> materials{material(9, 6, 1, true), material(5, 8, 2, true),
                                    material(7, 7, 3, true)};
  const JoinedSamples all = joined_of(materials);
  REQUIRE(all.places.size() == 3);
  REQUIRE(all.maps.size() == 2);
  CHECK(all.maps[1].depth == Depth::u16);
  for (std::size_t m = 0; m < materials.size(); ++m) {
    const Rect& place = all.places[m];
    for (std::size_t k = 0; k < 2; ++k) {
      const Image& from = materials[m][k].image;
      CHECK(crop(all.maps[k].image, place) == from);
      for (int y = -1; y <= from.height(); ++y) // a texel round it continues it
        for (int x = -1; x <= from.width(); ++x) {
          const int i = place.x + x;
          if (i < 0 || y < 0 || i >= all.maps[k].image.width() || y >= all.maps[k].image.height()) continue;
          const auto there = all.maps[k].image.texel(i, y);
          const auto here =
              from.texel(std::clamp(x, 0, from.width() - 1), std::clamp(y, 0, from.height() - 1));
          CHECK(std::equal(there.begin(), there.end(), here.begin()));
          CHECK(all.material_at(i) == static_cast<int>(m));
        }
    }
  }
}

TEST_CASE("materials whose maps differ are refused, with the map and the way out named", "[exemplar]") {
  const Maps plain = material(8, 8, 1);
  Maps other = material(8, 8, 2);
  SECTION("a map that one of them lacks") {
    CHECK_THROWS_WITH(joined_of({plain, material(8, 8, 2, true)}),
                      Contains("height") && Contains("does not have"));
    CHECK_THROWS_WITH(joined_of({material(8, 8, 2, true), plain}),
                      Contains("height") && Contains("does not have"));
  }
  SECTION("role") {
    other[0].role = Role::data;
    CHECK_THROWS_WITH(joined_of({plain, other}), Contains("role data"));
  }
  SECTION("channels") {
    other[0].image = test::noise(8, 8, 4, 2);
    CHECK_THROWS_WITH(joined_of({plain, other}), Contains("has 4 channels, not 3 channels"));
  }
  SECTION("encoding") {
    other[0].encoding = Encoding::linear;
    CHECK_THROWS_WITH(joined_of({plain, other}), Contains("linear, not srgb"));
  }
  SECTION("ranges of heights") {
    Maps a = material(8, 8, 1, true), b = material(8, 8, 2, true);
    b[1].range = ValueRange{0, 3};
    CHECK_THROWS_WITH(joined_of({a, b}), Contains("another range"));
  }
}
