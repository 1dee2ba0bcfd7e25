#include "tilepack/error/error.h"
#include "tilepack/tileset/border_colors.h"
#include "tilepack/tileset/sequential_set.h"

#include <catch2/catch.hpp>
#include <set>
#include <tuple>

using namespace tilepack;

TEST_CASE("a sequential set offers two different tiles for each north and west color") {
  const std::pair<int, int> counts[] = {{2, 2}, {3, 3}, {1, 2}, {4, 2}, {8, 8}};
  for (const auto& [horizontal, vertical] : counts) {
    CAPTURE(horizontal, vertical);
    const std::vector<EdgeTile> tiles = sequential_edge_set(horizontal, vertical);
    REQUIRE(static_cast<int>(tiles.size()) == 2 * horizontal * vertical);
    std::set<std::tuple<int, int, int, int>> different;
    std::vector<int> choices(static_cast<std::size_t>(horizontal * vertical));
    for (const EdgeTile& tile : tiles) {
      different.insert({tile.north, tile.east, tile.south, tile.west});
      CHECK((tile.south >= 0 && tile.south < horizontal && tile.east >= 0 && tile.east < vertical));
      ++choices[static_cast<std::size_t>(tile.north * vertical + tile.west)];
    }
    CHECK(different.size() == tiles.size());
    for (const int count : choices) CHECK(count == 2);
  }
  CHECK_THROWS_AS(sequential_edge_set(1, 1), Error);
  CHECK_THROWS_AS(sequential_edge_set(9, 2), Error);
  CHECK_THROWS_AS(sequential_edge_set(2, 0), Error);
}

TEST_CASE("border colors tell which tiles fit, for either coloring") {
  const auto edges = border_colors(std::vector<EdgeTile>{{1, 2, 3, 4}});
  CHECK(edges == std::vector<BorderColors>{{1, 2, 3, 4}});
  const std::vector<CornerTile> corners = complete_corner_set(3);
  const auto borders = border_colors(corners);
  for (std::size_t a = 0; a < corners.size(); ++a)
    for (std::size_t b = 0; b < corners.size(); ++b) {
      const bool beside = corners[a].ne == corners[b].nw && corners[a].se == corners[b].sw;
      const bool below = corners[a].sw == corners[b].nw && corners[a].se == corners[b].ne;
      CHECK((borders[a].east == borders[b].west) == beside);
      CHECK((borders[a].south == borders[b].north) == below);
    }
}
