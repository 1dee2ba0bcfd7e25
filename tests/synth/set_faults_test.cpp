#include "support/enlarged.h"
#include "support/samples.h"

#include "tilepack/synth/set_faults.h"

#include <catch2/catch.hpp>

using namespace tilepack;
using namespace tilepack::testing;

namespace {

// Grain that gets brighter from west to east, so slowly that no line in it is a step.
FeatureImage slow() {
  Image image(256, 96, 1);
  for (int y = 0; y < 96; ++y)
    for (int x = 0; x < 256; ++x)
      image.texel(x, y)[0] = (40.0f + static_cast<float>(x * 160 / 256 + (x * 7 + y * 13) % 5)) / 255.0f;
  return features(image);
}

// One tile that lies beside itself: from `left` on, and from `right` on east of its column 32.
SourceMap two_pieces(int left, int right, int slope) {
  SourceMap map{{64, 64}, {1, 1, 0}, std::vector<EdgeTile>(1), {{}}, 0};
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x)
      map.texels[0].push_back({(x < 32 + slope * (y - 32) / 8 ? left : right) + x, y + (x < 32 ? 0 : 2)});
  return map;
}

} // namespace

TEST_CASE("a tone that ends in a line is found, one that runs on is not", "[set_faults]") {
  const FeatureImage image = slow();
  const ToneBreaks broken = tone_breaks(image, two_pieces(4, 150, 0));
  REQUIRE_FALSE(broken.worst.empty());
  CHECK(broken.share > 0.25); // one line in the middle, of two borders, and the tile beside itself
  const TilePlace worst = broken.worst.front();
  CHECK(worst.tile == 0);
  CHECK(worst.strength > 2);
  CHECK((std::abs(worst.area.x + worst.area.width / 2 - 32) <= 2 ||
         std::abs(worst.area.x + worst.area.width / 2) <= 2));
  const ToneBreaks like = tone_breaks(image, two_pieces(40, 42, 0));
  CHECK(like.share == broken.share / 2); // the border alone, where dark meets bright

  CHECK(tone_breaks(image,
                    SourceMap{{8, 8}, {1, 1, 0}, std::vector<EdgeTile>(1), {std::vector<SourceTexel>(64)}, 0})
            .worst.empty()); // too small for a line
}

TEST_CASE("the dearest places are where cuts are seen, apart", "[set_faults]") {
  const FeatureImage image = slow();
  const auto places = dearest_places(image, two_pieces(4, 150, 0), 3);
  REQUIRE(places.size() == 3);
  for (const TilePlace& place : places) {
    CHECK(place.area.x <= 32);
    CHECK(place.area.x + place.area.width >= 32);
  }
  CHECK(places[0].strength >= places[1].strength);
  CHECK(std::abs(places[0].area.y - places[1].area.y) >= 16);
}

TEST_CASE("tones that end in lines are found at the scale of tiles, and told in their texels",
          "[set_faults]") {
  // The same twice: tiles of 128 texels, and of 256 with everything twice as large.
  const auto tile_of = [](int times) {
    SourceMap map{{128 * times, 128 * times}, {1, 1, 0}, std::vector<EdgeTile>(1), {{}}, 0};
    for (int y = 0; y < 128 * times; ++y)
      for (int x = 0; x < 128 * times; ++x)
        map.texels[0].push_back({(x < 64 * times ? 4 * times : 120 * times) + x, y});
    return map;
  };
  Image ramp(256, 128, 1);
  for (int y = 0; y < 128; ++y)
    for (int x = 0; x < 256; ++x)
      ramp.texel(x, y)[0] = (40.0f + static_cast<float>(x * 160 / 256 + (x * 7 + y * 13) % 5)) / 255.0f;
  const ToneBreaks small = tone_breaks(features(ramp), tile_of(1));
  const ToneBreaks large = tone_breaks(features(enlarged(ramp, 2)), tile_of(2));
  REQUIRE(small.share > 0.2);
  CHECK(large.share == Approx(small.share).epsilon(0.1));
  REQUIRE_FALSE(large.worst.empty());
  CHECK(large.worst.front().area.width == 2 * small.worst.front().area.width);
}
