#include "tilepack/error/error.h"
#include "tilepack/layout/corner_grid.h"

#include <catch2/catch.hpp>
#include <set>

using namespace tilepack;

TEST_CASE("each combination of four edges round a point lies once in the corner grid, tiles agreeing") {
  const std::pair<int, int> counts[] = {{1, 1}, {2, 2}, {3, 2}, {2, 4}};
  for (const auto& [horizontal, vertical] : counts) {
    CAPTURE(horizontal, vertical);
    const CornerGrid grid = corner_grid(horizontal, vertical);
    const std::vector<EdgeTile> tiles = complete_edge_set(horizontal, vertical);
    REQUIRE(grid.columns == horizontal * horizontal);
    REQUIRE(grid.rows == vertical * vertical);
    const auto tile = [&](int column, int row) {
      const int cell = (row % grid.rows) * grid.columns + column % grid.columns;
      return tiles.at(static_cast<std::size_t>(grid.tiles.at(static_cast<std::size_t>(cell))));
    };
    std::set<std::pair<int, int>> cells;
    for (int left = 0; left < horizontal; ++left)
      for (int right = 0; right < horizontal; ++right)
        for (int up = 0; up < vertical; ++up)
          for (int down = 0; down < vertical; ++down) {
            const CornerCell cell = corner_cell(left, right, up, down);
            cells.insert({cell.column, cell.row});
            const EdgeTile nw = tile(cell.column, cell.row);
            const EdgeTile ne = tile(cell.column + 1, cell.row);
            const EdgeTile sw = tile(cell.column, cell.row + 1);
            const EdgeTile se = tile(cell.column + 1, cell.row + 1);
            CHECK((nw.east == up && ne.west == up));
            CHECK((sw.east == down && se.west == down));
            CHECK((nw.south == left && sw.north == left));
            CHECK((ne.south == right && se.north == right));
          }
    CHECK(static_cast<int>(cells.size()) == grid.columns * grid.rows);
    CHECK(static_cast<int>(std::set<int>(grid.tiles.begin(), grid.tiles.end()).size()) ==
          horizontal * vertical);
  }
  CHECK_THROWS_AS(corner_grid(0, 2), Error);
  CHECK_THROWS_AS(corner_grid(2, 9), Error);
}

TEST_CASE("the corner atlas shows the grid's tiles") {
  const CornerGrid grid = corner_grid(2, 2);
  std::vector<Image> tiles;
  for (int id = 0; id < 16; ++id) tiles.emplace_back(3, 2, 1, static_cast<float>(id));
  const Image image = corner_atlas(tiles, grid);
  REQUIRE(image.size() == Size{12, 8});
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      CHECK(image.texel(column * 3 + 2, row * 2 + 1)[0] ==
            static_cast<float>(grid.tiles[static_cast<std::size_t>(row * 4 + column)]));
}
