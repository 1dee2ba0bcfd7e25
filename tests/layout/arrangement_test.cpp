#include "tilepack/error/error.h"
#include "tilepack/layout/arrangement.h"
#include "tilepack/layout/rotated_lattice.h"
#include "tilepack/numeric/random.h"
#include "tilepack/tileset/sequential_set.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <numeric>
#include <set>
#include <utility>

using namespace tilepack;

namespace {

// Checked apart from the search, on the tiles' own colors.
void check_agreement(const std::vector<EdgeTile>& tiles, const RotatedScheme& scheme,
                     const std::vector<int>& arrangement) {
  const RotatedLattice lattice(scheme);
  REQUIRE(static_cast<int>(arrangement.size()) == lattice.sites());
  CHECK(std::set<int>(arrangement.begin(), arrangement.end()).size() == tiles.size());
  const auto tile = [&](int site) {
    return tiles.at(static_cast<std::size_t>(arrangement[static_cast<std::size_t>(site)]));
  };
  for (int site = 0; site < lattice.sites(); ++site) {
    CHECK(tile(site).east == tile(lattice.east_of(site)).west);
    CHECK(tile(site).south == tile(lattice.south_of(site)).north);
  }
}

// East and south neighbours of the sites of a scheme, found by walking over the texture in units of
// 1 / (n² + k²) of its height; apart from RotatedLattice.
struct Walk {
  std::vector<std::size_t> east, south;

  explicit Walk(const RotatedScheme& scheme) {
    const int side = scheme.n * scheme.n + scheme.k * scheme.k;
    const auto moved = [&](std::pair<int, int> from, int dx, int dy) {
      const int width = side * scheme.squares;
      return std::pair((from.first + dx + width) % width, (from.second + dy + side) % side);
    };
    std::map<std::pair<int, int>, std::size_t> number{{{0, 0}, 0}};
    std::vector<std::pair<int, int>> places{{0, 0}};
    const auto visit = [&](std::pair<int, int> place) {
      const auto [found, added] = number.try_emplace(place, places.size());
      if (added) places.push_back(place);
      return found->second;
    };
    for (std::size_t i = 0; i < places.size(); ++i) {
      east.push_back(visit(moved(places[i], scheme.n, scheme.k)));
      south.push_back(visit(moved(places[i], -scheme.k, scheme.n)));
    }
  }
};

// All orders of the tiles, one after another.
bool some_order_agrees(const std::vector<EdgeTile>& tiles, const Walk& walk) {
  std::vector<std::size_t> order(tiles.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  do {
    bool agrees = true;
    for (std::size_t site = 0; agrees && site < order.size(); ++site)
      agrees = tiles[order[site]].east == tiles[order[walk.east[site]]].west &&
               tiles[order[site]].south == tiles[order[walk.south[site]]].north;
    if (agrees) return true;
  } while (std::next_permutation(order.begin(), order.end()));
  return false;
}

// Tiles of random colors; every second set has as many of each color on opposite sides, and every fourth is
// cut from a texture where all agree.
std::vector<EdgeTile> random_set(const Walk& walk, std::uint64_t number) {
  const std::size_t count = walk.east.size();
  std::uint64_t draw = 100 * number;
  std::vector<int> across(count), down(count);
  for (int& color : across) color = static_cast<int>(random_below(1, "across", draw++, 3));
  for (int& color : down) color = static_cast<int>(random_below(1, "down", draw++, 3));
  std::vector<EdgeTile> tiles(count);
  for (std::size_t i = 0; i < count; ++i) {
    tiles[i].west = across[i];
    tiles[i].north = down[i];
    const bool shuffled = number % 4 == 1;
    tiles[i].east = across[shuffled ? (i + 1) % count : walk.east[i]];
    tiles[i].south = down[shuffled ? (i + 2) % count : walk.south[i]];
  }
  if (number % 2 == 0) tiles[0].east = (tiles[0].east + static_cast<int>(number % 3)) % 3;
  return tiles;
}

} // namespace

TEST_CASE("the search finds an arrangement exactly where trying all orders does") {
  int found = 0;
  int none = 0;
  for (const RotatedScheme& scheme :
       {RotatedScheme{1, 0, 1}, RotatedScheme{1, 1, 1}, RotatedScheme{1, 0, 2}, RotatedScheme{2, 0, 1},
        RotatedScheme{1, 1, 2}, RotatedScheme{2, 1, 1}, RotatedScheme{2, 2, 1}, RotatedScheme{2, 0, 2}}) {
    const Walk walk(scheme);
    REQUIRE(static_cast<int>(walk.east.size()) == tile_count(scheme));
    for (std::uint64_t number = 0; number < (walk.east.size() < 8 ? 60 : 8); ++number) {
      INFO(formula(scheme) << ", set " << number);
      const std::vector<EdgeTile> tiles = random_set(walk, number);
      const Arrangement searched = matching_arrangement(tiles, scheme);
      const bool exists = some_order_agrees(tiles, walk);
      CHECK(searched.matching == (exists ? Matching::found : Matching::none));
      if (searched.matching == Matching::found) check_agreement(tiles, scheme, searched.tiles);
      ++(exists ? found : none);
    }
  }
  CHECK(found > 100);
  CHECK(none > 100);
}

TEST_CASE("the complete set of two by two colors fits its torus") {
  const std::vector<EdgeTile> tiles = complete_edge_set(2, 2);
  const Arrangement result = matching_arrangement(tiles, {4, 0, 1});
  REQUIRE(result.matching == Matching::found);
  check_agreement(tiles, {4, 0, 1}, result.tiles);
}

TEST_CASE("complete sets of three colors lie on their known grids") {
  const std::vector<EdgeTile> tiles = complete_edge_set(3, 3);
  const Arrangement result = matching_arrangement(tiles, {9, 0, 1});
  REQUIRE(result.matching == Matching::found);
  check_agreement(tiles, {9, 0, 1}, result.tiles);
  CHECK(matching_arrangement(complete_corner_set(3), {9, 0, 1}).matching == Matching::found);
}

TEST_CASE("where colors can't agree the search says so") {
  // Five different tiles whose east colors don't balance their west colors.
  const std::vector<EdgeTile> unbalanced{
      {0, 1, 0, 0}, {0, 1, 0, 1}, {1, 1, 0, 0}, {0, 0, 1, 0}, {1, 1, 1, 0}};
  CHECK(matching_arrangement(unbalanced, {2, 1, 1}).matching == Matching::none);
  // Balanced, but each tile only fits itself.
  const std::vector<EdgeTile> strangers{{0, 0, 0, 0}, {1, 1, 1, 1}, {2, 2, 2, 2}, {3, 3, 3, 3}, {4, 4, 4, 4}};
  CHECK(matching_arrangement(strangers, {2, 1, 1}).matching == Matching::none);
  CHECK(matching_arrangement(sequential_edge_set(3, 3), {3, 3, 1}, 300).matching == Matching::not_found);
  CHECK_THROWS_AS(matching_arrangement(complete_edge_set(2, 2), {2, 1, 1}), Error);
}

TEST_CASE("a tile that is its own neighbour must agree with itself") {
  CHECK(matching_arrangement(std::vector<EdgeTile>{{0, 0, 0, 0}}, {1, 0, 1}).matching == Matching::found);
  CHECK(matching_arrangement(std::vector<EdgeTile>{{0, 0, 1, 0}}, {1, 0, 1}).matching == Matching::none);
  // Two squares side by side: each tile lies above itself, and together these would balance.
  const std::vector<EdgeTile> flipped{{0, 0, 1, 0}, {1, 0, 0, 0}};
  CHECK(matching_arrangement(flipped, {1, 0, 2}).matching == Matching::none);
}

TEST_CASE("sequential sets of 8 and 18 tiles fill turned tori with all borders agreeing") {
  const std::pair<int, RotatedScheme> cases[] = {
      {2, {2, 2, 1}}, {3, {3, 3, 1}}, {2, {2, 0, 2}}, {3, {3, 0, 2}}};
  for (const auto& [colors, scheme] : cases) {
    CAPTURE(colors, formula(scheme));
    const std::vector<EdgeTile> tiles = sequential_edge_set(colors, colors);
    const Arrangement result = matching_arrangement(tiles, scheme);
    REQUIRE(result.matching == Matching::found);
    check_agreement(tiles, scheme, result.tiles);
  }
}
