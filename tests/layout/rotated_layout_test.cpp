#include "tilepack/error/error.h"
#include "tilepack/layout/rotated_lattice.h"
#include "tilepack/layout/rotated_layout.h"

#include <catch2/catch.hpp>
#include <numeric>

using namespace tilepack;

namespace {

std::vector<int> in_order(int count) {
  std::vector<int> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), 0);
  return order;
}

} // namespace

TEST_CASE("the texture of a rotated layout is the smallest that keeps the tiles their size") {
  CHECK(rotated_texture_size({2, 1, 1}, {128, 0, false}) == Size{287, 287}); // 128 √5 = 286.2
  CHECK(rotated_texture_size({3, 0, 1}, {128, 0, false}) == Size{384, 384});
  CHECK(rotated_texture_size({3, 0, 2}, {128, 0, false}) == Size{768, 384});
  CHECK(rotated_texture_size({2, 1, 1}, {128, 0, true}) == Size{512, 512});
  CHECK(rotated_texture_size({4, 0, 1}, {64, 0, true}) == Size{256, 256});
  CHECK(rotated_texture_size({3, 4, 1}, {64, 2, false}) == Size{340, 340});
  CHECK_THROWS_AS(rotated_texture_size({2, 1, 1}, {0, 0, false}), Error);
  CHECK_THROWS_AS(rotated_texture_size({2, 1, 1}, {64, 65, false}), Error);
  CHECK_THROWS_AS(rotated_texture_size({2, 1, 1}, {64, -1, false}), Error);
  CHECK_THROWS_WITH(rotated_texture_size({20, 1, 1}, {4096, 0, false}), Catch::Contains("65536"));
}

TEST_CASE("placements follow the turned sides, inside their gutters") {
  const Layout layout = rotated_layout({2, 1, 1}, {100, 10, false}, in_order(5));
  const Size texture = texture_size(layout, {100, 100}, 0);
  REQUIRE(texture == Size{269, 269}); // 120 √5 = 268.3
  for (int tile = 0; tile < 5; ++tile) {
    const Placement place = placement(layout, tile, {100, 100}, 0);
    const RotatedLattice lattice({2, 1, 1});
    const Cell& cell = layout.cells[static_cast<std::size_t>(tile)];
    CHECK(place.east.y == Approx(place.east.x / 2)); // tangent k / n
    CHECK(place.south.x == -place.east.y);
    CHECK(place.south.y == place.east.x);
    const double side = texture.width / std::sqrt(5.0) * 100 / 120;
    CHECK(std::hypot(place.east.x, place.east.y) == Approx(side));
    // The middle of the tile is the middle of the cell, gutter or not.
    const Placement::Vector middle = place.at(0.5, 0.5);
    CHECK(middle.x == Approx((cell.column + (2 - 1) * 0.5) * texture.width / 5));
    CHECK(middle.y == Approx((cell.row + (1 + 2) * 0.5) * texture.height / 5));
  }
}

TEST_CASE("a rotated layout keeps levels while every tile owns a texel") {
  const Size tile{64, 64};
  for (const RotatedScheme scheme : {RotatedScheme{2, 1, 1}, {3, 3, 1}, {4, 1, 2}, {3, 0, 1}, {8, 1, 1}}) {
    const Layout layout = rotated_layout(scheme, {64, 0, false}, in_order(tile_count(scheme)));
    const RotatedLattice lattice(scheme);
    const int levels = levels_held(layout, tile, 7);
    CHECK(levels == (scheme.k == 0 ? 7 : 6));
    for (int level = 0; level < levels; ++level) {
      const Size size = texture_size(layout, tile, level);
      std::vector<bool> owns(static_cast<std::size_t>(lattice.sites()));
      for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
          owns[static_cast<std::size_t>(lattice.owner_of(size, x, y).site)] = true;
      CHECK(std::find(owns.begin(), owns.end(), false) == owns.end());
    }
  }
}
