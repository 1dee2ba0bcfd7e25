#include "tilepack/error/error.h"
#include "tilepack/layout/arrangement.h"
#include "tilepack/layout/rotated_lattice.h"
#include "tilepack/tileset/sequential_set.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <set>

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

} // namespace

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
