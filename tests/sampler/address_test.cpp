#include "tilepack/sampler/address.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

using namespace tilepack;

TEST_CASE("normalised moves whole tiles out of the fraction") {
  CHECK(normalised({3, 0.25}) == TileCoordinate{3, 0.25});
  CHECK(normalised({3, 1.0}) == TileCoordinate{4, 0.0});
  CHECK(normalised({3, 2.5}) == TileCoordinate{5, 0.5});
  CHECK(normalised({0, -0.25}) == TileCoordinate{-1, 0.75});
  CHECK(normalised({-7, -3.0}) == TileCoordinate{-10, 0.0});
  CHECK(normalised({0, -0.0}).fraction == 0.0);
}

TEST_CASE("normalised never gives a fraction of 1") {
  // -1e-20 + 1 rounds to 1, which is no fraction: the place counts as the border itself.
  CHECK(normalised({5, -1e-20}) == TileCoordinate{5, 0.0});
  const double below_one = std::nextafter(1.0, 0.0);
  CHECK(normalised({5, below_one}) == TileCoordinate{5, below_one});
}

TEST_CASE("normalised is defined for every fraction and tile") {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double odd : {std::nan(""), infinity, -infinity, 0x1p62, -0x1p62, 1e300})
    CHECK(normalised({9, odd}) == TileCoordinate{9, 0.0});
  const auto largest = std::numeric_limits<std::int64_t>::max();
  const TileCoordinate around = normalised({largest, 1.5});
  CHECK(around.fraction == 0.5);
  CHECK(around.tile == std::numeric_limits<std::int64_t>::min());
}

TEST_CASE("from_texels finds tile and fraction, negative too") {
  CHECK(from_texels(0.0, 8) == TileCoordinate{0, 0.0});
  CHECK(from_texels(20.0, 8) == TileCoordinate{2, 0.5});
  CHECK(from_texels(-2.0, 8) == TileCoordinate{-1, 0.75});
  CHECK(from_texels(-16.0, 8) == TileCoordinate{-2, 0.0});
  CHECK(from_texels(std::nan(""), 8) == TileCoordinate{0, 0.0});
  for (const double huge : {1e300, -1e300}) CHECK(from_texels(huge, 7).fraction < 1.0);
}

TEST_CASE("from_texels keeps the fraction however far out") {
  const std::int64_t far = (std::int64_t{1} << 31) * 96 * 4096 + 5;
  CHECK(from_texels(far, 0.25, 96) == TileCoordinate{(std::int64_t{1} << 31) * 4096, 5.25 / 96});
  CHECK(from_texels(-far, 0.25, 96) == TileCoordinate{-(std::int64_t{1} << 31) * 4096 - 1, 91.25 / 96});
  CHECK(from_texels(std::int64_t{7}, 1.5, 8) == TileCoordinate{1, 0.5 / 8});
}
