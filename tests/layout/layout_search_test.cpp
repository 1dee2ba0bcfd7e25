#include "tilepack/error/error.h"
#include "tilepack/layout/layout_search.h"
#include "tilepack/tileset/sequential_set.h"

#include <algorithm>
#include <catch2/catch.hpp>

using namespace tilepack;

TEST_CASE("the planner wastes least, then resamples least") {
  // 50 tiles of 64: two plain grids of 5 x 5 side by side fit exactly and copy.
  const std::vector<LayoutCandidate> fifty = layout_plans({50, 64, {}, 0, false});
  REQUIRE(fifty.size() == 4);
  CHECK(fifty[0].scheme == RotatedScheme{5, 0, 2});
  CHECK(fifty[0].wasted == 0);
  CHECK(fifty[0].copied);
  CHECK(fifty[0].size == Size{640, 320});
  for (std::size_t i = 1; i < fifty.size(); ++i) {
    CHECK(fifty[i].wasted >= fifty[i - 1].wasted);
    CHECK_FALSE(fifty[i].copied);
  }
  // 5 tiles of 128 in a texture of 287², where padding to a power of two would take 8 tiles' room.
  const std::vector<LayoutCandidate> five = layout_plans({5, 128, {}, 0, false});
  CHECK(five[0].scheme == RotatedScheme{2, 1, 1});
  CHECK(five[0].wasted == 287 * 287 - 5 * 128 * 128);
  CHECK(padded_texels(5, 128) == 8 * 128 * 128);
  CHECK(padded_texels(5, 100) == 8 * 128 * 128);
  CHECK(padded_texels(16, 64) == 16 * 64 * 64);
}

TEST_CASE("the planner's plans are those of trying all schemes and sides") {
  for (const bool power_of_two : {false, true})
    for (const int gutter : {0, 2})
      for (const int side : {2, 7, 64})
        for (int tiles = 1; tiles <= 60; ++tiles) {
          // Every way to write the count, and the first side that holds it: a turned tile and its gutters
          // take the root of n² + k² times their own side.
          std::vector<std::int64_t> wasted;
          for (const int squares : {1, 2})
            for (int n = 1; n <= tiles; ++n)
              for (int k = 0; k <= n; ++k) {
                if (squares * (n * n + k * k) != tiles) continue;
                const std::int64_t cell = side + 2 * gutter;
                std::int64_t height = 1;
                while (height * height < cell * cell * (n * n + k * k))
                  height = power_of_two ? 2 * height : height + 1;
                wasted.push_back(height * height * squares - std::int64_t{tiles} * side * side);
              }
          std::sort(wasted.begin(), wasted.end());
          CAPTURE(tiles, side, gutter, power_of_two);
          if (wasted.empty()) {
            CHECK_THROWS_AS(layout_plans({tiles, side, {}, gutter, power_of_two}), Error);
            continue;
          }
          std::vector<std::int64_t> planned;
          for (const LayoutCandidate& plan : layout_plans({tiles, side, {}, gutter, power_of_two}))
            planned.push_back(plan.wasted);
          CHECK(planned == wasted);
        }
}

TEST_CASE("sides that are powers of two are kept when asked for") {
  for (const LayoutCandidate& plan : layout_plans({18, 60, {}, {}, true})) {
    CAPTURE(formula(plan.scheme));
    CHECK((plan.size.width & (plan.size.width - 1)) == 0);
    CHECK((plan.size.height & (plan.size.height - 1)) == 0);
  }
}

TEST_CASE("gutters are planned where colors don't match, and only there") {
  const TileColors sequential = sequential_edge_set(3, 3);
  const LayoutCandidate matched =
      layout_plans({18, 64, RotatedScheme{3, 3, 1}, {}, false}, &sequential).at(0);
  CHECK(matched.matching == Matching::found);
  CHECK(matched.gutter == 0);
  const TileColors unmatched =
      std::vector<EdgeTile>{{0, 0, 0, 0}, {1, 1, 1, 1}, {2, 2, 2, 2}, {3, 3, 3, 3}, {4, 4, 4, 4}};
  const LayoutCandidate guttered = layout_plans({5, 64, {}, {}, false}, &unmatched).at(0);
  CHECK(guttered.matching == Matching::none);
  CHECK(guttered.gutter == default_gutter);
  CHECK(layout_plans({5, 64, {}, 7, false}, &unmatched).at(0).gutter == 7);
  const Layout layout = planned_layout(guttered, 64);
  CHECK(layout.rotated.size == guttered.size);
  CHECK(layout.rotated.gutter == 2);
}

TEST_CASE("the planner names the way out") {
  CHECK_THROWS_WITH(layout_plans({7, 64, {}, {}, false}), Catch::Contains("5 and 8"));
  CHECK_THROWS_WITH(layout_plans({5, 64, RotatedScheme{3, 0, 1}, {}, false}), Catch::Contains("2² + 1²"));
  CHECK_THROWS_AS(layout_plans({0, 64, {}, {}, false}), Error);
  CHECK_THROWS_AS(layout_plans({5, 64, {}, -1, false}), Error);
}
