#include "tilepack/error/error.h"
#include "tilepack/mapping/index_fill.h"
#include "tilepack/tileset/border_colors.h"
#include "tilepack/tileset/sequential_set.h"

#include <catch2/catch.hpp>
#include <cstdlib>

using namespace tilepack;

namespace {

struct Counts {
  int disagreements = 0;
  int repeats = 0;   ///< side neighbours that are the same tile
  int avoidable = 0; ///< of those, cells where another tile that fits on the west and north repeats neither
};

Counts counted(const Mapping& mapping, const TileColors& tiles) {
  const std::vector<BorderColors> borders = border_colors(tiles);
  const auto w = mapping.size.width;
  const auto h = mapping.size.height;
  const auto id = [&](std::int64_t x, std::int64_t y) {
    return mapping.ids[static_cast<std::size_t>(((y + h) % h) * w + (x + w) % w)];
  };
  const auto at = [&](std::int64_t x, std::int64_t y) { return borders[static_cast<std::size_t>(id(x, y))]; };
  Counts counts;
  for (std::int64_t y = 0; y < h; ++y)
    for (std::int64_t x = 0; x < w; ++x) {
      if (at(x, y).east != at(x + 1, y).west) ++counts.disagreements;
      if (at(x, y).south != at(x, y + 1).north) ++counts.disagreements;
      if (id(x, y) != id(x - 1, y) && id(x, y) != id(x, y - 1)) continue;
      ++counts.repeats;
      // Row and column 0 have no such neighbours yet when they are filled. Near its end a row closes on its
      // start, and the last rows on the first: there tiles may be forced.
      if (x == 0 || y == 0 || x > w - 12 || y > h - 34) continue;
      for (std::size_t other = 0; other < borders.size(); ++other) {
        const BorderColors& b = borders[other];
        const int candidate = static_cast<int>(other);
        if (candidate != id(x - 1, y) && candidate != id(x, y - 1) && b.north == at(x, y).north &&
            b.west == at(x, y).west)
          ++counts.avoidable;
      }
    }
  return counts;
}

} // namespace

TEST_CASE("sequential sets fill index maps that agree everywhere and wrap") {
  const std::pair<int, int> colors[] = {{2, 2}, {3, 3}, {2, 4}, {1, 2}, {4, 4}, {8, 8}};
  for (const auto& [horizontal, vertical] : colors)
    for (const VirtualSize size : {VirtualSize{24, 16}, VirtualSize{37, 41}}) {
      CAPTURE(horizontal, vertical, size.width);
      const TileColors tiles = sequential_edge_set(horizontal, vertical);
      const Mapping mapping = filled_index_mapping(size, tiles, 3);
      CHECK(mapping.kind == MappingKind::index);
      REQUIRE(static_cast<std::int64_t>(mapping.ids.size()) == size.width * size.height);
      CHECK(counted(mapping, tiles).disagreements == 0);
    }
}

TEST_CASE("row by row, no cell repeats its west or north neighbour where the other tile would not") {
  const std::pair<int, int> colors[] = {{2, 2}, {3, 3}, {2, 4}, {1, 2}, {4, 4}};
  for (const auto& [horizontal, vertical] : colors) {
    CAPTURE(horizontal, vertical);
    const TileColors tiles = sequential_edge_set(horizontal, vertical);
    for (const std::uint64_t seed : {1, 2, 3})
      CHECK(counted(filled_index_mapping({64, 80}, tiles, seed), tiles).avoidable == 0);
  }
}

TEST_CASE("repeats are rare, and all tiles are used alike") {
  const TileColors tiles = sequential_edge_set(2, 2);
  const Mapping mapping = filled_index_mapping({64, 64}, tiles, 1);
  // With no preference, a cell repeats its west or north neighbour with a probability of about 1/5.
  CHECK(counted(mapping, tiles).repeats < 64 * 64 / 50);
  std::vector<int> uses(8);
  for (const int id : mapping.ids) ++uses[static_cast<std::size_t>(id)];
  for (const int count : uses) CHECK(std::abs(count - 512) < 128);
}

TEST_CASE("the seed alone decides the filling") {
  const TileColors tiles = sequential_edge_set(3, 3);
  CHECK(filled_index_mapping({20, 20}, tiles, 5).ids == filled_index_mapping({20, 20}, tiles, 5).ids);
  CHECK(filled_index_mapping({20, 20}, tiles, 5).ids != filled_index_mapping({20, 20}, tiles, 6).ids);
}

TEST_CASE("corner-colored and complete sets are filled as well") {
  for (const TileColors& tiles : {TileColors(complete_corner_set(2)), TileColors(complete_edge_set(2, 3))})
    CHECK(counted(filled_index_mapping({15, 17}, tiles, 9), tiles).disagreements == 0);
}

TEST_CASE("sets that can't fill the map are refused, and sizes out of range") {
  const TileColors dead_end = std::vector<EdgeTile>{{0, 1, 0, 0}};
  CHECK_THROWS_WITH(filled_index_mapping({8, 8}, dead_end, 0), Catch::Contains("8x8"));
  CHECK_THROWS_AS(filled_index_mapping({8, 8}, std::vector<EdgeTile>{}, 0), Error);
  const TileColors tiles = sequential_edge_set(2, 2);
  CHECK_THROWS_AS(filled_index_mapping({0, 8}, tiles, 0), Error);
  CHECK_THROWS_AS(filled_index_mapping({65537, 8}, tiles, 0), Error);
  CHECK_THROWS_AS(filled_index_mapping({65536, 65536}, tiles, 0), Error);
  // A lone tile that fits itself fills anything.
  CHECK(filled_index_mapping({3, 2}, std::vector<EdgeTile>{{0, 0, 0, 0}}, 0).ids == std::vector<int>(6, 0));
}
