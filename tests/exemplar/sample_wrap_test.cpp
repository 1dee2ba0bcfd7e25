#include "tilepack/exemplar/sample_wrap.h"
#include "tilepack/numeric/random.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

using namespace tilepack;

namespace {

// Bumps at random places, on a torus or not.
SampleMap bumps(int width, int height, bool wraps_x, bool wraps_y) {
  SampleMap map;
  map.image = Image(width, height, 1);
  const auto random = [](int i, const char* what, int most) {
    return static_cast<int>(
        random_below(3, what, static_cast<std::uint64_t>(i), static_cast<std::uint32_t>(most)));
  };
  for (int i = 0; i < width * height / 20; ++i) {
    const int cx = random(i, "x", width), cy = random(i, "y", height);
    const float sign = i % 2 == 0 ? 0.1f : -0.1f;
    for (int y = cy - 6; y <= cy + 6; ++y)
      for (int x = cx - 6; x <= cx + 6; ++x) {
        const auto inside = [](int& at, int side, bool wraps) {
          if (wraps) at = (at + side) % side;
          return at >= 0 && at < side;
        };
        int at_x = x, at_y = y;
        if (!inside(at_x, width, wraps_x) || !inside(at_y, height, wraps_y)) continue;
        const float d = static_cast<float>((x - cx) * (x - cx) + (y - cy) * (y - cy)) / 36.0f;
        if (d < 1) map.image.texel(at_x, at_y)[0] += sign * (1 - d);
      }
  }
  for (float& v : map.image.data()) v = std::clamp(0.5f + v, 0.0f, 1.0f);
  return map;
}

SampleWrap found_of(const SampleMap& map) {
  const std::vector<SampleMap> maps{map};
  return detect_wrap(feature_image(maps), {});
}

} // namespace

TEST_CASE("a sample that was made to repeat is told from one that was cut out, along each axis") {
  CHECK(found_of(bumps(192, 160, true, true)) == SampleWrap{true, true});
  CHECK(found_of(bumps(192, 160, true, false)) == SampleWrap{true, false});
  CHECK(found_of(bumps(192, 160, false, true)) == SampleWrap{false, true});
  CHECK(found_of(bumps(192, 160, false, false)) == SampleWrap{});
}

TEST_CASE("a pattern may end at its lines") {
  SampleMap squares;
  squares.image = Image(300, 300, 1);
  for (int y = 0; y < 300; ++y)
    for (int x = 0; x < 300; ++x) squares.image.texel(x, y)[0] = static_cast<float>((x / 25 + y / 25) % 2);
  const std::vector<SampleMap> maps{squares};
  const FeatureImage image = feature_image(maps);
  CHECK(detect_wrap(image, detect_periods(maps)) == SampleWrap{true, true});
  CHECK(detect_wrap(image, {}) == SampleWrap{}); // its border is a line, where few texels lie at one
}

TEST_CASE("maps go on by themselves") {
  SampleMap map;
  map.image = Image(3, 2, 1);
  for (int i = 0; i < 6; ++i) map.image.data()[static_cast<std::size_t>(i)] = static_cast<float>(i);
  const std::vector<SampleMap> maps{map};
  const std::vector<SampleMap> longer = continued(maps, {8, 3});
  REQUIRE(longer.size() == 1);
  CHECK(longer[0].image.size() == Size{8, 3});
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 8; ++x)
      CHECK(longer[0].image.texel(x, y)[0] == static_cast<float>(y % 2 * 3 + x % 3));
}
