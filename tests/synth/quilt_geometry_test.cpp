#include "tilepack/synth/quilt_geometry.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <vector>

using namespace tilepack;

namespace {

const std::vector<QuiltGeometry> geometries{QuiltGeometry({16, 16}, 0), QuiltGeometry({17, 12}, 2),
                                            QuiltGeometry({4, 5}, 0), QuiltGeometry({9, 31}, 1)};

} // namespace

TEST_CASE("the four quadrants hold each texel of a quilted tile once, counted from its corners") {
  for (const QuiltGeometry& geometry : geometries) {
    const Size tile = geometry.tile;
    std::vector<int> met(static_cast<std::size_t>(tile.width * tile.height));
    for (int quadrant = 0; quadrant < QuiltGeometry::quadrants; ++quadrant)
      for (int row = 0; row < geometry.rows(quadrant); ++row)
        for (int column = 0; column < geometry.columns(quadrant); ++column) {
          const SourceTexel t = geometry.texel(quadrant, row, column);
          REQUIRE((t.x >= 0 && t.x < tile.width && t.y >= 0 && t.y < tile.height));
          ++met[static_cast<std::size_t>(t.y * tile.width + t.x)];
        }
    CHECK(met == std::vector<int>(met.size(), 1));
    CHECK(geometry.texel(0, 0, 0) == SourceTexel{0, 0});
    CHECK(geometry.texel(1, 0, 0) == SourceTexel{tile.width - 1, 0});
    CHECK(geometry.texel(2, 0, 0) == SourceTexel{0, tile.height - 1});
    CHECK(geometry.texel(3, 0, 0) == SourceTexel{tile.width - 1, tile.height - 1});
  }
}

TEST_CASE("windows lie in the sample as tiles do, and run on across the edge in their middle") {
  for (const QuiltGeometry& geometry : geometries) {
    const Size tile = geometry.tile;
    for (int quadrant = 0; quadrant < QuiltGeometry::quadrants; ++quadrant)
      for (int row = 0; row < geometry.rows(quadrant); ++row)
        for (int column = 0; column < geometry.columns(quadrant); ++column) {
          const SourceTexel t = geometry.texel(quadrant, row, column);
          for (const SourceTexel w :
               {geometry.in_horizontal_window(quadrant, t), geometry.in_vertical_window(quadrant, t)})
            REQUIRE((w.x >= 0 && w.x < tile.width && w.y >= 0 && w.y < tile.height));
        }
    // The last row of a tile above a horizontal edge and the first of the tile below, likewise columns.
    for (int x = 0; x < tile.width; ++x) {
      const int side = x < geometry.columns(0) ? 0 : 1;
      const SourceTexel above = geometry.in_horizontal_window(2 + side, {x, tile.height - 1});
      const SourceTexel below = geometry.in_horizontal_window(side, {x, 0});
      CHECK(below == SourceTexel{above.x, above.y + 1});
    }
    for (int y = 0; y < tile.height; ++y) {
      const int side = y < geometry.rows(0) ? 0 : 2;
      const SourceTexel before = geometry.in_vertical_window(side + 1, {tile.width - 1, y});
      const SourceTexel after = geometry.in_vertical_window(side, {0, y});
      CHECK(after == SourceTexel{before.x + 1, before.y});
    }
  }
}

TEST_CASE("cuts run in a band about the diagonal, off the guards of both edges") {
  for (const QuiltGeometry& geometry : geometries)
    for (int quadrant = 0; quadrant < QuiltGeometry::quadrants; ++quadrant) {
      const auto ranges = geometry.allowed(quadrant);
      const int rows = geometry.rows(quadrant);
      const int columns = geometry.columns(quadrant);
      const int reach = std::max(1, std::min(geometry.tile.width, geometry.tile.height) / 5);
      REQUIRE(ranges.size() == static_cast<std::size_t>(rows));
      for (int row = 0; row < rows; ++row) {
        const CutRange range = ranges[static_cast<std::size_t>(row)];
        CHECK((0 <= range.first && range.first <= range.last && range.last <= columns));
        // Within the guard of the horizontal edge its patch shows from the guard of the vertical edge on;
        // beyond it the vertical edge's patch shows up to that guard.
        if (row < geometry.guard)
          CHECK(range.last <= geometry.guard);
        else
          CHECK(range.first >= std::min(geometry.guard, columns));
        const double diagonal = (row + 0.5) * columns / rows;
        if (row >= geometry.guard && diagonal > geometry.guard + reach) {
          CHECK(range.first >= diagonal - reach - 1);
          CHECK(range.last <= diagonal + reach + 1);
        }
      }
    }
}
