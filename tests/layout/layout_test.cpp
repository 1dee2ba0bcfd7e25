#include "tilepack/error/error.h"
#include "tilepack/layout/tile_index.h"

#include <catch2/catch.hpp>

using namespace tilepack;

namespace {

// Each texel tells its tile and its place in it.
std::vector<Image> numbered_tiles(int count, Size size) {
  std::vector<Image> tiles;
  for (int id = 0; id < count; ++id) {
    Image tile(size.width, size.height, 2);
    for (int y = 0; y < size.height; ++y)
      for (int x = 0; x < size.width; ++x) {
        tile.texel(x, y)[0] = static_cast<float>(id);
        tile.texel(x, y)[1] = static_cast<float>(y * size.width + x);
      }
    tiles.push_back(tile);
  }
  return tiles;
}

} // namespace

TEST_CASE("an atlas has every tile in its cell, and gives them back") {
  const Layout layout = tile_index_layout(complete_edge_set(3, 2));
  const std::vector<Image> tiles = numbered_tiles(36, {5, 3});
  const Image image = atlas(tiles, layout);
  REQUIRE(image.size() == Size{4 * 5, 9 * 3});
  const Cell& cell = layout.cells[17];
  CHECK(image.texel(cell.column * 5 + 4, cell.row * 3 + 2)[0] == 17.0f);
  CHECK(image.texel(cell.column * 5 + 4, cell.row * 3 + 2)[1] == 14.0f);
  CHECK(tiles_of(image, layout) == tiles);
  std::vector<Image> given_up = tiles;
  CHECK(atlas(std::move(given_up), layout) == image);
  for (const Image& tile : given_up) CHECK(tile.empty());
}

TEST_CASE("atlas and tiles_of refuse what doesn't fit the grid") {
  const Layout layout = tile_index_layout(complete_edge_set(2, 2));
  CHECK_THROWS_AS(atlas(numbered_tiles(15, {4, 4}), layout), Error);
  std::vector<Image> uneven = numbered_tiles(16, {4, 4});
  uneven[3] = Image(4, 5, 2);
  CHECK_THROWS_AS(atlas(uneven, layout), Error);
  CHECK_THROWS_AS(atlas(std::move(uneven), layout), Error);
  CHECK_THROWS_AS(tiles_of(Image(17, 16, 1), layout), Error);
}
