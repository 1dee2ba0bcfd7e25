#include "tilepack/exemplar/exact_repeat.h"
#include "tilepack/exemplar/period.h"

#include <catch2/catch.hpp>
#include <vector>

using namespace tilepack;

namespace {

SampleMap drawn(int width, int height, auto value_at) {
  SampleMap map;
  map.image = Image(width, height, 1);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) map.image.texel(x, y)[0] = value_at(x, y) ? 1.0f : 0.0f;
  return map;
}

ExactRepeat repeat_of(const std::vector<SampleMap>& maps) {
  return exact_repeat(maps);
}

} // namespace

TEST_CASE("drawn patterns repeat exactly, however short the repeat is") {
  const auto squares = [](int side) {
    return [side](int x, int y) { return (x / side + y / side) % 2 != 0; };
  };
  const ExactRepeat checker = repeat_of({drawn(64, 96, squares(1))});
  CHECK(checker.x == 2);
  CHECK(checker.y == 2);
  CHECK(checker.both());
  const ExactRepeat coarse = repeat_of({drawn(300, 300, squares(25))});
  CHECK(coarse.x == 50);
  CHECK(coarse.y == 50);
  const ExactRepeat stripes = repeat_of({drawn(64, 64, [](int x, int) { return x / 2 % 2 != 0; })});
  CHECK(stripes.x == 4);
  CHECK(stripes.y == 1);
}

TEST_CASE("all maps and all texels count") {
  SampleMap pattern = drawn(64, 64, [](int x, int y) { return (x + y) % 2 != 0; });
  SampleMap other = drawn(64, 64, [](int x, int) { return x % 8 == 0; });
  CHECK(repeat_of({pattern, other}).x == 8);
  pattern.image.texel(63, 63)[0] = 0.5f;
  CHECK(repeat_of({pattern}).x == 0);
  CHECK_FALSE(repeat_of({pattern}).both());
  CHECK(exact_repeat({}).x == 0);
  CHECK(repeat_of({drawn(64, 64, [](int x, int) { return x % 20 == 0; })}).x == 0); // more than a quarter
}

TEST_CASE("exact repeats are periods, of stripes along one axis alone") {
  const std::vector<SampleMap> stripes{drawn(64, 64, [](int x, int) { return x / 2 % 2 != 0; })};
  const Periodicity found = detect_periods(stripes);
  CHECK(found.x.length == 4.0);
  CHECK(found.x.exact);
  CHECK(found.y.length == 0.0);
  CHECK(found.y.exact);
}
