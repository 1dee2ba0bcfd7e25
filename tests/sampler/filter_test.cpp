#include "tilepack/sampler/filter.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

using namespace tilepack;

TEST_CASE("levels are clamped to those stored, NaN is the finest") {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const Filter filter : {Filter::nearest, Filter::bilinear, Filter::trilinear}) {
    CHECK(level_blend(-3, 4, filter) == LevelBlend{0, 0, 0});
    CHECK(level_blend(9, 4, filter) == LevelBlend{3, 3, 0});
    CHECK(level_blend(infinity, 4, filter) == LevelBlend{3, 3, 0});
    CHECK(level_blend(-infinity, 4, filter) == LevelBlend{0, 0, 0});
    CHECK(level_blend(std::nan(""), 4, filter) == LevelBlend{0, 0, 0});
    CHECK(level_blend(0.5, 1, filter) == LevelBlend{0, 0, 0});
  }
}

TEST_CASE("trilinear blends the two levels around, the others round") {
  CHECK(level_blend(1.25, 4, Filter::trilinear) == LevelBlend{1, 2, 0.25});
  CHECK(level_blend(2.0, 4, Filter::trilinear) == LevelBlend{2, 2, 0});
  CHECK(level_blend(1.25, 4, Filter::bilinear) == LevelBlend{1, 1, 0});
  CHECK(level_blend(1.5, 4, Filter::nearest) == LevelBlend{2, 2, 0});
}

TEST_CASE("bilinear taps weigh the two texel centres around a place") {
  const auto taps = [](double fraction, int side) {
    const Taps t = bilinear_taps(fraction, side);
    return std::pair(t.first, t.weight);
  };
  CHECK(taps(0.0, 8) == std::pair(-1, 0.5));
  CHECK(taps(0.5 / 8, 8) == std::pair(0, 0.0));
  CHECK(taps(4.75 / 8, 8) == std::pair(4, 0.25));
  CHECK(taps(std::nextafter(1.0, 0.0), 8).first == 7);
  CHECK(taps(0.0, 1) == std::pair(-1, 0.5));
  CHECK(taps(0.75, 1) == std::pair(0, 0.25));
}

TEST_CASE("nearest_texel stays in the tile") {
  CHECK(nearest_texel(0.0, 5) == 0);
  CHECK(nearest_texel(0.2, 5) == 1);
  CHECK(nearest_texel(std::nextafter(1.0, 0.0), 5) == 4);
  CHECK(nearest_texel(std::nextafter(1.0, 0.0), 1) == 0);
}

TEST_CASE("filter names lead back to their filter") {
  for (const Filter filter : {Filter::nearest, Filter::bilinear, Filter::trilinear})
    CHECK(enum_named<Filter>(name_of(filter)) == filter);
  CHECK_FALSE(enum_named<Filter>("cubic"));
}
