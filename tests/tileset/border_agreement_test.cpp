#include "support/framed_pack.h"

#include "tilepack/tileset/border_agreement.h"

#include <catch2/catch.hpp>

using namespace tilepack;

namespace {

// Tiles whose quarters are noise that the two edge colors at their corner decide.
TileSet quartered_set(const std::vector<EdgeTile>& tiles, int side) {
  TileSet set = framed_set(tiles, {side, side}, 3);
  for (std::size_t id = 0; id < tiles.size(); ++id) {
    const EdgeTile& tile = tiles[id];
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        const int corner = (x < side / 2 ? 0 : 1) + (y < side / 2 ? 0 : 2);
        const int across = y < side / 2 ? tile.north : tile.south;
        const int down = x < side / 2 ? tile.west : tile.east;
        const int place = (((corner * 8 + across) * 8 + down) * 256 + y) * 256 + x;
        for (std::size_t c = 0; c < 3; ++c)
          set.maps[0].tiles[id].texel(x, y)[c] =
              static_cast<float>(random_below(7, "quarter", static_cast<std::uint64_t>(place) * 3 + c, 256)) /
              255.0f;
      }
  }
  return set;
}

void change(Image& tile, int x, int y) {
  float& value = tile.texel(x, y)[1];
  value = value > 0.5f ? 0.0f : 1.0f;
}

} // namespace

TEST_CASE("a corner pack is read as far as tiles with the same edges at a corner agree") {
  const std::vector<EdgeTile> tiles = complete_edge_set(2, 2);
  TileSet set = quartered_set(tiles, 32);
  CHECK(agreed_corner_width(set) == 15.5); // lookups half a texel from the middle read the next quarter
  // A lookup reads texels whose centres are less than a texel away along both axes: (9, 4) has its own at
  // (9.5, 4.5), and the nearest lookup that reads it is at (8.5, 3.5), 9.19 texels from the corner.
  change(set.maps[0].tiles[5], 9, 4);
  CHECK(agreed_corner_width(set) == 9.0);
  change(set.maps[0].tiles[11], 31 - 3, 31 - 2); // (2.5, 1.5) from the south-east corner: 2.9 texels
  CHECK(agreed_corner_width(set) == 3.25);
  change(set.maps[0].tiles[2], 2, 31 - 1); // (1.5, 0.5) from the south-west corner: 1.58 texels
  CHECK(agreed_corner_width(set) == 3.0);
  change(set.maps[0].tiles[2], 31, 0); // the corner itself
  CHECK(agreed_corner_width(set) == 0.0);
}

TEST_CASE("all maps count for the width of the corner pack") {
  TileSet set = quartered_set(complete_edge_set(2, 2), 32);
  set.maps.push_back(set.maps[0]);
  change(set.maps[1].tiles[3], 9, 4);
  CHECK(agreed_corner_width(set) == 9.0);
}

TEST_CASE("no corner pack is read where corners agree without one") {
  TileSet set = quartered_set(complete_edge_set(2, 2), 32);
  for (Image& tile : set.maps[0].tiles)
    for (const int y : {0, 31})
      for (const int x : {0, 31}) std::ranges::fill(tile.texel(x, y), 0.25f);
  CHECK(agreed_corner_width(set) == 0.0);
  CHECK(agreed_corner_width(framed_set(complete_corner_set(2), {16, 16}, 1)) == 0.0);
  CHECK(agreed_corner_width(framed_set(complete_edge_set(2, 2), {16, 16}, 1)) ==
        1.25); // a frame of one texel
}

TEST_CASE("drawings that agree have a guard as deep as they do") {
  TileSet set = quartered_set(complete_edge_set(2, 2), 32);
  CHECK(agreed_guard(set) == 0); // each half of an edge depends on the other edge at its corner too
  set = framed_set(complete_edge_set(2, 2), {32, 32}, 1);
  CHECK(agreed_guard(set) == 1);
  CHECK(border_differences(set).empty());
  change(set.maps[0].tiles[6], 17, 1);
  CHECK(agreed_guard(set) == 1);
  for (Image& tile : set.maps[0].tiles) tile = Image(32, 32, 3, 0.5f);
  CHECK(agreed_guard(set) == 4); // an eighth
}

TEST_CASE("where drawings disagree is told by tile, side, texel and amount, the worst first") {
  TileSet set = framed_set(complete_edge_set(2, 2), {16, 16}, 1);
  set.maps[0].tiles[6].texel(15, 9)[2] += 0.25f; // north 0, east 1, south 1, west 0
  set.maps[0].tiles[6].texel(15, 3)[0] += 0.125f;
  set.maps[0].tiles[9].texel(4, 0)[1] -= 0.5f; // north 1, east 0, south 0, west 1
  const std::vector<BorderDifference> found = border_differences(set);
  REQUIRE(found.size() == 2);
  CHECK(found[0].tile == 9);
  CHECK(found[0].side == "north");
  CHECK(found[0].color == "color 1");
  CHECK(found[0].reference == 8);
  CHECK(found[0].difference == Approx(0.5));
  CHECK(found[1].tile == 6);
  CHECK(found[1].side == "east");
  CHECK((found[1].x == 15 && found[1].y == 9 && found[1].channel == 2));
  CHECK(found[1].difference == Approx(0.25));
  CHECK(found[1].texels == 2);
  CHECK(border_differences(set, 0.3).size() == 1);
}
