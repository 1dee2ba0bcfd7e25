#include "tilepack/error/error.h"
#include "tilepack/layout/de_bruijn.h"
#include "tilepack/layout/tile_index.h"
#include "tilepack/numeric/wrap.h"

#include <catch2/catch.hpp>
#include <set>

using namespace tilepack;

TEST_CASE("every 2 x 2 block of colors occurs once in the de Bruijn torus") {
  for (int colors = 1; colors <= 4; ++colors) {
    CAPTURE(colors);
    const int side = colors * colors;
    std::set<int> blocks;
    for (int row = 0; row < side; ++row)
      for (int column = 0; column < side; ++column) {
        const int east = (column + 1) % side;
        const int south = (row + 1) % side;
        const CornerTile tile{de_bruijn_color(colors, column, row), de_bruijn_color(colors, east, row),
                              de_bruijn_color(colors, column, south), de_bruijn_color(colors, east, south)};
        for (const int color : {tile.nw, tile.ne, tile.sw, tile.se}) CHECK((color >= 0 && color < colors));
        blocks.insert(id_in_complete_set(tile, colors));
      }
    CHECK(static_cast<int>(blocks.size()) == side * side);
  }
}

TEST_CASE("for odd K a block is found by arithmetic") {
  const int n = 9;
  const Layout layout = de_bruijn_layout(complete_corner_set(3));
  const std::vector<CornerTile> tiles = complete_corner_set(3);
  for (const Cell& cell : layout.cells) {
    const CornerTile& tile = tiles[static_cast<std::size_t>(cell.tile)];
    const int p = tile_index_1d(tile.nw, tile.sw);
    const int q = tile_index_1d(tile.ne, tile.se);
    const int column = wrapped(q - p, n);
    CHECK(cell.column == column);
    CHECK(cell.row == wrapped(p - column * (column - 1) / 2, n));
  }
}

TEST_CASE("the de Bruijn layout holds each tile once and agrees at every corner of the torus") {
  for (int colors = 1; colors <= 4; ++colors) {
    CAPTURE(colors);
    const std::vector<CornerTile> tiles = complete_corner_set(colors);
    const Layout layout = de_bruijn_layout(tiles);
    CHECK(layout.kind == LayoutKind::de_bruijn);
    REQUIRE(layout.columns == colors * colors);
    REQUIRE(layout.rows == colors * colors);
    std::set<std::pair<int, int>> places;
    for (std::size_t id = 0; id < tiles.size(); ++id) {
      const Cell& cell = layout.cells[id];
      CHECK(cell.tile == static_cast<int>(id));
      CHECK(de_bruijn_color(colors, cell.column, cell.row) == tiles[id].nw);
      CHECK(de_bruijn_color(colors, (cell.column + 1) % layout.columns, (cell.row + 1) % layout.rows) ==
            tiles[id].se);
      places.insert({cell.column, cell.row});
    }
    CHECK(places.size() == tiles.size());
  }
}

TEST_CASE("variants lie on copies of the torus one below the other, and agree where these meet") {
  for (const ColorCounts& counts :
       {ColorCounts{0, 0, 2, 2}, ColorCounts{0, 0, 3, 4}, ColorCounts{0, 0, 1, 8}}) {
    const TileColors set = complete_set(counts);
    const auto& tiles = std::get<std::vector<CornerTile>>(set);
    const Layout layout = de_bruijn_layout(tiles);
    const int side = counts.corner * counts.corner;
    REQUIRE(layout.columns == side);
    REQUIRE(layout.rows == counts.variants * side);
    std::vector<int> at(tiles.size(), -1);
    for (const Cell& cell : layout.cells) {
      CHECK(cell.row / side == cell.tile / combinations(counts)); // the variant
      at[static_cast<std::size_t>(cell.row * side + cell.column)] = cell.tile;
    }
    const auto tile = [&](int column, int row) {
      return tiles[static_cast<std::size_t>(
          at.at(static_cast<std::size_t>(row % layout.rows * side + column % side)))];
    };
    for (int row = 0; row < layout.rows; ++row)
      for (int column = 0; column < side; ++column) {
        CHECK(tile(column, row).ne == tile(column + 1, row).nw);
        CHECK(tile(column, row).se == tile(column, row + 1).ne);
        CHECK(tile(column, row).se == tile(column + 1, row + 1).nw);
      }
  }
  std::vector<CornerTile> tiles = std::get<std::vector<CornerTile>>(complete_set({0, 0, 2, 2}));
  tiles[20] = tiles[21];
  CHECK_THROWS_WITH(de_bruijn_layout(tiles), Catch::Contains("tiles 20 and 21"));
}

TEST_CASE("the de Bruijn layout refuses what is no complete set of 1 to 4 colors") {
  CHECK_THROWS_AS(de_bruijn_color(5, 0, 0), Error);
  CHECK_THROWS_AS(de_bruijn_layout({}), Error);
  CHECK_THROWS_AS(de_bruijn_layout(complete_corner_set(5)), Error);
  std::vector<CornerTile> tiles = complete_corner_set(2);
  tiles[3] = tiles[2];
  CHECK_THROWS_WITH(de_bruijn_layout(tiles), Catch::Contains("tiles 2 and 3"));
  tiles.erase(tiles.begin() + 3);
  CHECK_THROWS_WITH(de_bruijn_layout(tiles), Catch::Contains("nw 0, ne 0, sw 1, se 1"));
}
