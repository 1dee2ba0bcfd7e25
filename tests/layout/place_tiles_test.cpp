#include "support/images.h"

#include "tilepack/error/error.h"
#include "tilepack/layout/arrangement.h"
#include "tilepack/layout/de_bruijn.h"
#include "tilepack/layout/place_tiles.h"
#include "tilepack/layout/rotated_lattice.h"
#include "tilepack/layout/rotated_layout.h"
#include "tilepack/layout/surroundings.h"
#include "tilepack/layout/tile_index.h"
#include "tilepack/tileset/sequential_set.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

using namespace tilepack;

namespace {

std::vector<int> in_order(int count) {
  std::vector<int> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), 0);
  return order;
}

// Tiles whose colors are all different, so that none may lie beside another.
std::vector<EdgeTile> strangers(int count) {
  std::vector<EdgeTile> tiles;
  for (int i = 0; i < count; ++i) tiles.push_back({i, i, i, i});
  return tiles;
}

float constant_of(int tile) {
  return static_cast<float>((37 * tile + 11) % 256) / 255.0f;
}

TileMap constant_tiles(int count, Size size) {
  TileMap map{"color", Role::color, Encoding::srgb, Depth::u8, {}};
  for (int i = 0; i < count; ++i) map.tiles.emplace_back(size.width, size.height, 3, constant_of(i));
  return map;
}

// Smooth and different in each tile, so that a tile in the wrong place or turned the wrong way shows.
TileMap wavy_tiles(int count, int side) {
  TileMap map{"height", Role::height, Encoding::linear, Depth::f32, {}};
  for (int i = 0; i < count; ++i) {
    Image tile(side, side, 1);
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x)
        tile.texel(x, y)[0] = static_cast<float>(0.5 + 0.2 * std::sin(0.2 * x + 0.13 * y + i) +
                                                 0.2 * std::cos(0.17 * y - 0.05 * x + 2 * i));
    map.tiles.push_back(tile);
  }
  return map;
}

double rms(const std::vector<Image>& a, const std::vector<Image>& b) {
  double sum = 0;
  double count = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < a[i].data().size(); ++j) {
      const double d = static_cast<double>(a[i].data()[j]) - static_cast<double>(b[i].data()[j]);
      sum += d * d;
      ++count;
    }
  return std::sqrt(sum / count);
}

} // namespace

TEST_CASE("constant tiles come back from a rotated texture exactly constant, at every level") {
  const Size tile{16, 16};
  for (const int count : {5, 8, 10, 13, 17, 18, 25, 34, 50, 65})
    for (const RotatedScheme& scheme : rotated_schemes(count))
      for (const ResampleFilter filter :
           {ResampleFilter::bilinear, ResampleFilter::bicubic, ResampleFilter::lanczos}) {
        CAPTURE(count, formula(scheme), name_of(filter));
        const Layout layout = rotated_layout(scheme, {16, 0, false}, in_order(count));
        const int levels = levels_held(layout, tile, 5);
        CHECK(levels >= 4);
        for (int level = 0; level < levels; ++level) {
          const TileMap tiles = constant_tiles(count, {16 >> level, 16 >> level});
          const Image texture =
              place_tiles(tiles, strangers(count), layout, tile, level, {filter, Outside::own});
          CHECK(quantised(tiles_at_level(quantised(texture, Depth::u8), layout, tile, level)[0], Depth::u8) ==
                tiles.tiles[0]);
          const std::vector<Image> back = tiles_at_level(quantised(texture, Depth::u8), layout, tile, level);
          CHECK(back == tiles.tiles);
        }
      }
}

TEST_CASE("every tile comes back in place from its rotated texture") {
  for (const int count : {2, 5, 8, 10, 13, 17, 18, 25, 34, 50, 65})
    for (const RotatedScheme& scheme : rotated_schemes(count))
      for (const int gutter : {0, 3}) {
        CAPTURE(count, formula(scheme), gutter);
        const TileMap tiles = wavy_tiles(count, 32);
        const Layout layout = rotated_layout(scheme, {32, gutter, false}, in_order(count));
        const Image texture = place_tiles(tiles, strangers(count), layout, {32, 32}, 0,
                                          {ResampleFilter::lanczos, Outside::own});
        // The waves are 2 pi / 0.24 = 26 texels long; bilinear reading loses a few thousandths of them.
        CHECK(rms(tiles_at_level(texture, layout, {32, 32}, 0), tiles.tiles) < 0.006);
      }
}

TEST_CASE("tiles that are not turned are copied") {
  const TileMap tiles = wavy_tiles(18, 16);
  for (const int gutter : {0, 2}) {
    const Layout layout = rotated_layout({3, 0, 2}, {16, gutter, false}, in_order(18));
    const Image texture = place_tiles(tiles, strangers(18), layout, {16, 16}, 0);
    CHECK(tiles_at_level(texture, layout, {16, 16}, 0) == tiles.tiles);
  }
}

TEST_CASE("better filters lose less in the round trip") {
  TileMap tiles{"height", Role::height, Encoding::linear, Depth::f32, {}};
  for (std::uint64_t i = 0; i < 5; ++i) tiles.tiles.push_back(test::noise(32, 32, 1, i));
  const Layout layout = rotated_layout({2, 1, 1}, {32, 0, false}, in_order(5));
  std::vector<double> losses;
  for (const ResampleFilter filter :
       {ResampleFilter::bilinear, ResampleFilter::bicubic, ResampleFilter::lanczos})
    losses.push_back(rms(tiles_at_level(place_tiles(tiles, strangers(5), layout, {32, 32}, 0, {filter, {}}),
                                        layout, {32, 32}, 0),
                         tiles.tiles));
  CHECK(losses[1] < losses[0]);
  CHECK(losses[2] < losses[1]);
}

TEST_CASE("alpha weighs colors when tiles are turned") {
  TileMap tiles{"color", Role::color, Encoding::linear, Depth::f32, {}};
  for (int i = 0; i < 5; ++i) {
    Image tile(16, 16, 4);
    for (int y = 0; y < 16; ++y)
      for (int x = 0; x < 16; ++x) {
        const bool seen = (x / 4 + y / 4) % 2 == 0;
        const float values[] = {seen ? 0.25f : 1.0f, seen ? 0.5f : 0.0f, 0.5f, seen ? 1.0f : 0.0f};
        std::copy(std::begin(values), std::end(values), tile.texel(x, y).begin());
      }
    tiles.tiles.push_back(tile);
  }
  const Layout layout = rotated_layout({2, 1, 1}, {16, 0, false}, in_order(5));
  const Image texture =
      place_tiles(tiles, strangers(5), layout, {16, 16}, 0, {ResampleFilter::bilinear, Outside::own});
  for (int y = 0; y < texture.height(); ++y)
    for (int x = 0; x < texture.width(); ++x)
      if (texture.texel(x, y)[3] > 1e-3f) {
        REQUIRE(texture.texel(x, y)[0] == Approx(0.25f).epsilon(1e-4));
        REQUIRE(texture.texel(x, y)[1] == Approx(0.5f).epsilon(1e-4));
      }
}

TEST_CASE("an array's borders are those of fitting neighbours, halved from level to level") {
  const std::vector<EdgeTile> tiles = complete_edge_set(2, 2);
  Layout layout;
  layout.kind = LayoutKind::array;
  layout.columns = 1;
  layout.rows = 16;
  layout.border = 4;
  for (int i = 0; i < 16; ++i) layout.cells.push_back({i, 0, i});
  CHECK(levels_held(layout, {8, 8}, 4) == 3);
  for (int level = 0; level < 3; ++level) {
    const TileMap map = wavy_tiles(16, 8 >> level);
    const Image texture = place_tiles(map, tiles, layout, {8, 8}, level);
    CHECK(texture.size() == Size{16 >> level, 16 * (16 >> level)});
    CHECK(tiles_at_level(texture, layout, {8, 8}, level) == map.tiles);
    const int border = 4 >> level;
    for (int id = 0; id < 16; ++id) {
      const Surroundings round = fitting_surroundings(tiles)[static_cast<std::size_t>(id)];
      CHECK(tiles[static_cast<std::size_t>(round.e)].west == tiles[static_cast<std::size_t>(id)].east);
      CHECK(tiles[static_cast<std::size_t>(round.se)].north ==
            tiles[static_cast<std::size_t>(round.e)].south);
      CHECK(tiles[static_cast<std::size_t>(round.se)].west == tiles[static_cast<std::size_t>(round.s)].east);
      const int layer = id * (16 >> level);
      const int side = 8 >> level;
      CHECK(texture.texel(border + side, layer + border)[0] ==
            map.tiles[static_cast<std::size_t>(round.e)].texel(0, 0)[0]);
      CHECK(texture.texel(0, layer)[0] ==
            map.tiles[static_cast<std::size_t>(round.nw)].texel(side - border, side - border)[0]);
    }
  }
}

TEST_CASE("a rotated texture of matching neighbours is read across borders without a jump") {
  // Each tile is a window of one image that repeats with the lattice of 2 x 2 tiles: cut by color so that
  // tiles with equal edge colors continue each other. Here all colors are 0 and all tiles are equal and wrap.
  const std::vector<EdgeTile> tiles(8, EdgeTile{});
  TileMap map{"height", Role::height, Encoding::linear, Depth::f32, {}};
  Image wave(32, 32, 1);
  const double turn = 2 * std::acos(-1.0) / 32;
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 32; ++x)
      wave.texel(x, y)[0] = static_cast<float>(0.5 + 0.25 * std::sin(turn * (2 * x + y + 1.5)));
  map.tiles.assign(8, wave);
  const Layout layout = rotated_layout({2, 2, 1}, {32, 0, false}, in_order(8));
  const Image texture = place_tiles(map, tiles, layout, {32, 32}, 0);
  const RotatedLattice lattice({2, 2, 1});
  double worst = 0;
  for (int y = 0; y < texture.height(); ++y)
    for (int x = 0; x < texture.width(); ++x) {
      const auto owner = lattice.owner_of(texture.size(), x, y);
      const double expected = 0.5 + 0.25 * std::sin(turn * (64 * owner.x + 32 * owner.y));
      worst = std::max(worst, std::fabs(static_cast<double>(texture.texel(x, y)[0]) - expected));
    }
  CHECK(worst < 0.004);
}

TEST_CASE("textures of another size are refused") {
  const Layout layout = rotated_layout({2, 1, 1}, {16, 0, false}, in_order(5));
  CHECK_THROWS_AS(tiles_at_level(Image(36, 35, 1), layout, {16, 16}, 0), Error);
  CHECK_THROWS_AS(place_tiles(constant_tiles(4, {16, 16}), strangers(4), layout, {16, 16}, 0), Error);
}
