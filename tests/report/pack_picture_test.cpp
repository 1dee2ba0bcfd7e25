#include "support/good_pack.h"

#include "tilepack/error/error.h"
#include "tilepack/report/pack_picture.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <set>

using namespace tilepack;
using namespace tilepack::test;

namespace {

bool near_paint(std::span<const float> texel, const Paint& paint) {
  // 0.88 opaque over anything.
  return std::abs(texel[0] - paint.red) < 0.13 && std::abs(texel[1] - paint.green) < 0.13 &&
         std::abs(texel[2] - paint.blue) < 0.13;
}

} // namespace

TEST_CASE("the picture of a pack shows on both sides of each border the color they share") {
  const Pack pack = good_pack({.colors = {3, 2, 0}});
  const VectorDrawing drawing = pack_picture(pack, {});
  const Image image = rasterised(drawing);
  const int side = 96; // 16 texels, magnified six times
  REQUIRE(image.size() == Size{4 * side, 9 * side});
  const auto& tiles = std::get<std::vector<EdgeTile>>(pack.tiles);
  for (const Cell& cell : pack.layout.cells) {
    const EdgeTile& tile = tiles[cell.tile];
    const int x = cell.column * side;
    const int y = cell.row * side;
    CHECK(near_paint(image.texel(x + side / 2, y + 3), color_paint(tile.north)));
    CHECK(near_paint(image.texel(x + side / 2, y + side - 4), color_paint(tile.south)));
    CHECK(near_paint(image.texel(x + 3, y + side / 2), color_paint(tile.west)));
    CHECK(near_paint(image.texel(x + side - 4, y + side / 2), color_paint(tile.east)));
  }
  for (int column = 0; column < 4; ++column) {
    const auto above = image.texel(column * side + side / 2, 2 * side - 4);
    const auto below = image.texel(column * side + side / 2, 2 * side + 3);
    for (std::size_t c = 0; c < 3; ++c) CHECK(std::abs(above[c] - below[c]) < 0.13f);
  }
}

TEST_CASE("corner colors are drawn as quarter discs") {
  Pack pack = good_pack();
  const auto corners = complete_corner_set(2);
  pack.tiles = corners;
  pack.colors = {0, 0, 2};
  const Image image = rasterised(pack_picture(pack, {}));
  for (const Cell& cell : pack.layout.cells) {
    const int x = cell.column * 96;
    const int y = cell.row * 96;
    CHECK(near_paint(image.texel(x + 6, y + 6), color_paint(corners[cell.tile].nw)));
    CHECK(near_paint(image.texel(x + 89, y + 6), color_paint(corners[cell.tile].ne)));
    CHECK(near_paint(image.texel(x + 6, y + 89), color_paint(corners[cell.tile].sw)));
    CHECK(near_paint(image.texel(x + 89, y + 89), color_paint(corners[cell.tile].se)));
  }
}

TEST_CASE("without marks the picture is the level itself") {
  const Pack pack = good_pack({.tile = {96, 96}});
  CHECK(rasterised(pack_picture(pack, {.marks = false})) == pack.maps[0].levels[0]);
  CHECK(rasterised(pack_picture(pack, {.level = 1, .marks = false, .min_tile_side = 1})) ==
        pack.maps[0].levels[1]);
}

TEST_CASE("a large pack is drawn from a coarser level") {
  const Pack pack = good_pack({.tile = {64, 64}});
  CHECK(pack_picture(pack, {.min_tile_side = 1, .max_side = 256}).background.width() == 256);
  CHECK(pack_picture(pack, {.min_tile_side = 1, .max_side = 255}).background.width() == 128);
  CHECK(pack_picture(pack, {.min_tile_side = 1, .max_side = 1}).background.width() == 4);
}

TEST_CASE("the expansion shows the tiles the mapping says") {
  const Pack pack = good_pack({.tile = {96, 96}});
  const Image image = rasterised(expansion_picture(pack, 3, 2, {.marks = false}));
  REQUIRE(image.size() == Size{3 * 96, 2 * 96});
  const Cell& cell = pack.layout.cells[static_cast<std::size_t>(tile_at(pack.mapping, pack.colors, 2, 1))];
  CHECK(crop(image, {192, 96, 96, 96}) ==
        crop(pack.maps[0].levels[0], {cell.column * 96, cell.row * 96, 96, 96}));
  CHECK(expansion_picture(pack, 3, 2, {}).numbers.size() == 6);
}

TEST_CASE("maps and levels that are not there are refused by name and range") {
  const Pack pack = good_pack();
  CHECK_THROWS_AS(pack_picture(pack, {.map = 1}), Error);
  CHECK_THROWS_AS(pack_picture(pack, {.map = -1}), Error);
  CHECK_THROWS_AS(pack_picture(pack, {.level = 5}), Error);
  CHECK_THROWS_AS(pack_picture(pack, {.level = -1}), Error);
}

TEST_CASE("any map can be looked at: grey, alpha, light beyond 1, negative heights, NaN") {
  const Image grey = viewable(Image(1, 1, 1, 0.25f), Role::height, Encoding::linear);
  CHECK(grey.channels() == 3);
  CHECK(grey.texel(0, 0)[2] == Approx(0.25));

  Image clear(1, 1, 4, 1.0f);
  clear.texel(0, 0)[3] = 0;
  CHECK(viewable(clear, Role::color, Encoding::srgb).texel(0, 0)[0] == Approx(0.5));

  Image bright(100, 1, 3, 2.0f);
  bright.texel(7, 0)[0] = 5000;
  CHECK(viewable(bright, Role::color, Encoding::linear).texel(0, 0)[0] == Approx(1));
  CHECK(viewable(Image(1, 1, 3, 0.21404f), Role::color, Encoding::linear).texel(0, 0)[0] ==
        Approx(0.5).epsilon(1e-3));

  Image heights(2, 1, 1);
  heights.texel(0, 0)[0] = -10;
  heights.texel(1, 0)[0] = 30;
  CHECK(viewable(heights, Role::height, Encoding::linear).texel(0, 0)[0] == 0);
  CHECK(viewable(heights, Role::height, Encoding::linear).texel(1, 0)[0] == 1);

  const Image broken(1, 1, 3, std::numeric_limits<float>::quiet_NaN());
  CHECK(viewable(broken, Role::color, Encoding::linear).texel(0, 0)[0] == 1);
}

TEST_CASE("the eight colors differ") {
  std::set<std::tuple<double, double, double>> seen;
  for (int color = 0; color < 8; ++color) {
    const Paint paint = color_paint(color);
    seen.insert({paint.red, paint.green, paint.blue});
  }
  CHECK(seen.size() == 8);
}
