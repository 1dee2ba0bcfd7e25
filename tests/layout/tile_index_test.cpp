#include "tilepack/error/error.h"
#include "tilepack/layout/tile_index.h"

#include <catch2/catch.hpp>
#include <set>
#include <tuple>
#include <utility>

using namespace tilepack;

TEST_CASE("TileIndex1D is a bijection, and color_pair_at inverts it") {
  for (int n = 1; n <= 8; ++n) {
    std::set<int> places;
    for (int a = 0; a < n; ++a)
      for (int b = 0; b < n; ++b) {
        const int place = tile_index_1d(a, b);
        CAPTURE(n, a, b, place);
        CHECK(place >= 0);
        CHECK(place < n * n); // with the bijection: nested, the first m² places hold the colors below m
        CHECK(color_pair_at(place) == ColorPair{a, b});
        places.insert(place);
      }
    CHECK(static_cast<int>(places.size()) == n * n);
  }
}

TEST_CASE("neighbours in a TileIndex1D strip share their color, last to first too") {
  for (int n = 1; n <= 8; ++n)
    for (int place = 0; place < n * n; ++place) {
      CAPTURE(n, place);
      CHECK(color_pair_at(place).second == color_pair_at((place + 1) % (n * n)).first);
    }
}

TEST_CASE("TileIndex1D gives the strip of three colors drawn in Wei 2004, figure 4") {
  // 0 0 | 0 1 | 1 1 | 1 0 | 0 2 | 2 1 | 1 2 | 2 2 | 2 0
  const std::pair<int, int> strip[] = {{0, 0}, {0, 1}, {1, 1}, {1, 0}, {0, 2},
                                       {2, 1}, {1, 2}, {2, 2}, {2, 0}};
  for (int place = 0; place < 9; ++place)
    CHECK(tile_index_1d(strip[place].first, strip[place].second) == place);
}

TEST_CASE("the tile-index layout holds each tile once and agrees along every border of the torus") {
  const std::tuple<int, int, int> counts[] = {{1, 1, 1}, {1, 3, 1}, {2, 2, 1}, {3, 2, 1}, {4, 4, 1},
                                              {8, 8, 1}, {1, 1, 3}, {2, 3, 2}, {3, 2, 8}};
  for (const auto& [horizontal, vertical, variants] : counts) {
    CAPTURE(horizontal, vertical, variants);
    const TileColors set = complete_set({horizontal, vertical, 0, variants});
    const auto& tiles = std::get<std::vector<EdgeTile>>(set);
    const Layout layout = tile_index_layout(tiles);
    REQUIRE(layout.columns == vertical * vertical);
    REQUIRE(layout.rows == variants * horizontal * horizontal);
    REQUIRE(layout.cells.size() == tiles.size());

    std::vector<int> at(tiles.size(), -1);
    for (std::size_t id = 0; id < tiles.size(); ++id) {
      const Cell& cell = layout.cells[id];
      REQUIRE(cell.tile == static_cast<int>(id));
      int& place = at.at(static_cast<std::size_t>(cell.row * layout.columns + cell.column));
      REQUIRE(place == -1);
      place = cell.tile;
    }
    const auto tile = [&](int column, int row) {
      const int place = (row % layout.rows) * layout.columns + column % layout.columns;
      return tiles[static_cast<std::size_t>(at[static_cast<std::size_t>(place)])];
    };
    int disagreements = 0;
    for (int row = 0; row < layout.rows; ++row)
      for (int column = 0; column < layout.columns; ++column) {
        if (tile(column, row).east != tile(column + 1, row).west) ++disagreements;
        if (tile(column, row).south != tile(column, row + 1).north) ++disagreements;
      }
    CHECK(disagreements == 0);
  }
}

TEST_CASE("the tile-index layout names the tile that is missing or there twice") {
  std::vector<EdgeTile> tiles = complete_edge_set(2, 2);
  const EdgeTile lost = tiles[6];
  tiles[6] = tiles[5];
  try {
    tile_index_layout(tiles);
    FAIL("a repeated tile was accepted");
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::invalid_content);
    CHECK(std::string(error.what()).find("tiles 5 and 6") != std::string::npos);
  }
  tiles.erase(tiles.begin() + 6);
  try {
    tile_index_layout(tiles);
    FAIL("a missing tile was accepted");
  } catch (const Error& error) {
    const std::string expected = "north " + std::to_string(lost.north) + ", east " +
                                 std::to_string(lost.east) + ", south " + std::to_string(lost.south) +
                                 ", west " + std::to_string(lost.west);
    CHECK(std::string(error.what()).find(expected) != std::string::npos);
  }
  CHECK_THROWS_AS(tile_index_layout({}), Error);
  CHECK_THROWS_WITH(tile_index_layout({{0, 0, 0, 8}}), Catch::Contains("0 to 7"));
  CHECK_THROWS_WITH(tile_index_layout({{0, -1, 0, 0}}), Catch::Contains("-1"));
}
