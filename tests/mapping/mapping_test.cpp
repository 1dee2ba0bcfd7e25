#include "tilepack/error/error.h"
#include "tilepack/image/wrap.h"
#include "tilepack/mapping/mapping.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cstdint>
#include <limits>
#include <set>

using namespace tilepack;

namespace {

const ColorCounts edges_3x2{3, 2, 0};
const ColorCounts corners_3{0, 0, 3};

// The origins of the windows that are looked at: around zero, negative, across 2^31, and at the ends of the
// range.
const std::array<std::int64_t, 7> origins{-5,
                                          0,
                                          250,
                                          (std::int64_t{1} << 31) - 3,
                                          -(std::int64_t{1} << 40),
                                          std::numeric_limits<std::int64_t>::max() - 8,
                                          std::numeric_limits<std::int64_t>::min()};

void check_edges_agree(const Mapping& mapping) {
  for (const std::int64_t ox : origins)
    for (const std::int64_t oy : origins)
      for (std::int64_t y = oy; y < oy + 6; ++y)
        for (std::int64_t x = ox; x < ox + 6; ++x) {
          const EdgeTile tile = edge_tile_at(mapping, edges_3x2, x, y);
          REQUIRE(tile.east == edge_tile_at(mapping, edges_3x2, x + 1, y).west);
          REQUIRE(tile.south == edge_tile_at(mapping, edges_3x2, x, y + 1).north);
          const CornerTile c = corner_tile_at(mapping, corners_3, x, y);
          const CornerTile east = corner_tile_at(mapping, corners_3, x + 1, y);
          const CornerTile south = corner_tile_at(mapping, corners_3, x, y + 1);
          REQUIRE(c.ne == east.nw);
          REQUIRE(c.se == east.sw);
          REQUIRE(c.sw == south.nw);
          REQUIRE(c.se == south.ne);
        }
}

} // namespace

TEST_CASE("a permutation table holds each number once") {
  for (const int length : {1, 2, 7, 512}) {
    std::vector<int> table = permutation_table(length, 42);
    std::sort(table.begin(), table.end());
    for (int i = 0; i < length; ++i) REQUIRE(table[static_cast<std::size_t>(i)] == i);
  }
  CHECK(permutation_table(64, 1) != permutation_table(64, 2));
}

TEST_CASE("the table is long enough to repeat no row, and a multiple of the color counts") {
  CHECK(permutation_mapping({256, 256}, {2, 2, 0}, 0).table.size() == 512);
  CHECK(permutation_mapping({256, 100}, {3, 4, 0}, 0).table.size() == 516);
  CHECK(permutation_mapping({1, 1}, {1, 1, 0}, 0).table.size() == 2);
  CHECK(permutation_mapping({10, 20}, {0, 0, 3}, 0).table.size() == 42);
}

TEST_CASE("the permutation hash is that of the paper, coordinate for coordinate") {
  Mapping m;
  m.size = {7, 5};
  m.table = permutation_table(11, 3); // odd: indices wrap often
  const auto p = [&](std::int64_t i) {
    return static_cast<std::int64_t>(m.table[static_cast<std::size_t>(i % 11)]);
  };
  for (std::int64_t y = -6; y < 12; ++y)
    for (std::int64_t x = -8; x < 15; ++x) {
      const std::int64_t x0 = wrapped(x, std::int64_t{7});
      const std::int64_t y0 = wrapped(y, std::int64_t{5});
      const EdgeTile tile = edge_tile_at(m, edges_3x2, x, y);
      REQUIRE(tile.north == p(p(x0) + y0) % 3);
      REQUIRE(tile.west == p(x0 + p(2 * y0)) % 2);
      REQUIRE(tile.south == p(p(x0) + (y0 + 1) % 5) % 3);
      REQUIRE(tile.east == p((x0 + 1) % 7 + p(2 * y0)) % 2);
      REQUIRE(corner_tile_at(m, corners_3, x, y).nw == p(p(x0) + y0) % 3);
    }
}

TEST_CASE("neighbours agree on the edge and the corners between them, anywhere") {
  check_edges_agree(permutation_mapping({256, 256}, edges_3x2, 9));
  check_edges_agree(permutation_mapping({5, 3}, edges_3x2, 9));
  check_edges_agree(permutation_mapping({1, 1}, edges_3x2, 9));
  check_edges_agree(mix_mapping({std::int64_t{1} << 31, std::int64_t{1} << 31}, 9));
  check_edges_agree(mix_mapping({1000, 7}, 9));
}

TEST_CASE("a mapping wraps at its size") {
  for (const Mapping& m : {permutation_mapping({13, 6}, edges_3x2, 1), mix_mapping({13, 6}, 1)})
    for (std::int64_t y = 0; y < 6; ++y)
      for (std::int64_t x = 0; x < 13; ++x) {
        REQUIRE(tile_at(m, edges_3x2, x, y) == tile_at(m, edges_3x2, x - 13, y + 18));
        REQUIRE(tile_at(m, corners_3, x, y) == tile_at(m, corners_3, x + 130000000, y - 6));
      }
}

TEST_CASE("an index map holds what its mapping says") {
  const Mapping m = mix_mapping({9, 4}, 77);
  const Mapping index = index_mapping(m, edges_3x2);
  REQUIRE(index.ids.size() == 36);
  for (std::int64_t y = -9; y < 9; ++y)
    for (std::int64_t x = -20; x < 20; ++x)
      REQUIRE(tile_at(index, edges_3x2, x, y) == tile_at(m, edges_3x2, x, y));
}

TEST_CASE("every tile of the set comes up, and another seed gives another plane") {
  const Mapping permutation = permutation_mapping({64, 64}, edges_3x2, 5);
  const Mapping mix = mix_mapping({64, 64}, 5);
  for (const Mapping* m : {&permutation, &mix}) {
    std::set<int> seen;
    for (std::int64_t y = 0; y < 64; ++y)
      for (std::int64_t x = 0; x < 64; ++x) seen.insert(tile_at(*m, edges_3x2, x, y));
    CHECK(seen.size() == 36);
  }
  CHECK(index_mapping(mix, edges_3x2).ids != index_mapping(mix_mapping({64, 64}, 6), edges_3x2).ids);
}

TEST_CASE("sizes out of range are refused") {
  CHECK_THROWS_AS(permutation_mapping({4097, 1}, edges_3x2, 0), Error);
  CHECK_THROWS_AS(permutation_mapping({0, 4}, edges_3x2, 0), Error);
  CHECK_THROWS_AS(mix_mapping({4, -1}, 0), Error);
  CHECK_THROWS_AS(mix_mapping({(std::int64_t{1} << 31) + 1, 1}, 0), Error);
  CHECK_THROWS_AS(index_mapping(mix_mapping({std::int64_t{1} << 31, std::int64_t{1} << 31}, 0), edges_3x2),
                  Error);
}
