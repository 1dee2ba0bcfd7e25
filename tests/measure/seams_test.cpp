#include "support/good_pack.h"

#include "tilepack/measure/seams.h"

#include <catch2/catch.hpp>

using namespace tilepack;
using namespace tilepack::test;

namespace {

// Every tile the same ramp from west to east and north to south, closed by its own wrap: |step| is 1/255
// inside, and `jump` across borders.
Pack ramps(float jump) {
  Pack pack = good_pack({.tile = {16, 16}, .channels = 1, .depth = Depth::f32, .mips = MipMode::none});
  std::vector<Image> tiles;
  for (int id = 0; id < 16; ++id) {
    Image tile(16, 16, 1);
    for (int y = 0; y < 16; ++y)
      for (int x = 0; x < 16; ++x) {
        const auto wave = [](int i) { return static_cast<float>(i < 8 ? i : 15 - i); };
        tile.texel(x, y)[0] = wave(x) + wave(y) + (x == 0 ? jump : 0);
      }
    tiles.push_back(tile);
  }
  pack.maps[0].levels[0] = atlas(tiles, pack.layout);
  return pack;
}

} // namespace

TEST_CASE("all pairs of tiles that may be neighbours are measured") {
  // Per axis and color 8 tiles on either side of the border.
  CHECK(seam_figures(ramps(0), 0, 0, 5).pairs == 2 * 2 * 8 * 8);
  CHECK(seam_figures(good_pack({.colors = {1, 1, 0}}), 0, 0, 5).pairs == 2);
  CHECK(seam_figures(ramps(0), 0, 0, 5).worst.size() == 5);
  CHECK(seam_figures(ramps(0), 0, 0, 0).worst.empty());
}

TEST_CASE("a texture that goes on across borders as inside has seam near 1 or below") {
  // The ramps turn at the border: no step there, and 14 of 15 steps inside are 1.
  CHECK(seam_figures(ramps(0), 0, 0, 1).seam == Approx(0));
  // Step 1 across vertical borders: half of all borders, over 14/15 inside or a little more.
  CHECK(seam_figures(ramps(1), 0, 0, 1).seam == Approx(0.5 / (14.0 / 15)).epsilon(0.05));
}

TEST_CASE("the worst run of texels is found, with its tile, side and place") {
  Pack pack = ramps(0);
  const Cell cell = pack.layout.cells[5];
  // 20 along eight texels, and 5 along a few after them.
  const auto raise = [&](int from, int to, float by) {
    for (int y = from; y < to; ++y)
      pack.maps[0].levels[0].texel(cell.column * 16 + 15, cell.row * 16 + y)[0] += by;
  };
  raise(2, 10, 20);
  raise(12, 16, 5);
  const SeamFigures figures = seam_figures(pack, 0, 0, 1);
  REQUIRE(figures.worst.size() == 1);
  CHECK(figures.worst[0].tile == 5);
  CHECK(figures.worst[0].side == Side::east);
  CHECK(figures.worst[0].window_at == 2);
  CHECK(figures.worst[0].window > 5);
  CHECK(figures.worst[0].ratio < figures.worst[0].window);
}

TEST_CASE("flat tiles have no measure: a flat border is right, a step is not") {
  Pack pack = ramps(0);
  std::ranges::fill(pack.maps[0].levels[0].data(), 0.5f);
  CHECK(seam_figures(pack, 0, 0, 1).seam == 1);
  CHECK(seam_figures(pack, 0, 0, 1).worst[0].window == 1);
}
