#include "support/small_pack.h"

#include "tilepack/error/error.h"
#include "tilepack/sampler/ground_truth.h"
#include "tilepack/sampler/reference_sampler.h"
#include "tilepack/sampler/virtual_texture.h"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>

using namespace tilepack;

namespace {

std::array<double, 3> value(const GroundTruth& truth, double x, double y, double level, Filter filter) {
  std::array<double, 3> out{};
  truth.sample({0, x}, {0, y}, level, filter, out);
  return out;
}

SmallPack linear_pack() {
  SmallPack wanted;
  wanted.encoding = Encoding::linear;
  wanted.depth = Depth::f32;
  return wanted;
}

} // namespace

TEST_CASE("inside a tile the ground truth of the stored levels is the reference sampler, bit for bit") {
  const Pack pack = small_pack();
  const GroundTruth truth = GroundTruth::of_stored_levels(pack, 0);
  const ReferenceSampler reference(pack, 0);
  for (const double x : {0.1, 1.5, 4.3, -7.77})
    for (const double y : {0.0625, 2.9, -1.2}) {
      std::array<double, 3> wanted{};
      reference.sample({0, x}, {0, y}, 0, Filter::bilinear, wanted);
      CHECK(value(truth, x, y, 0, Filter::bilinear) == wanted);
    }
}

TEST_CASE("across borders the ground truth is a filter on the texture written out") {
  const Pack pack = small_pack(linear_pack());
  const GroundTruth truth = GroundTruth::of_stored_levels(pack, 0);
  for (int level = 0; level < 3; ++level) {
    const int side = 8 >> level;
    const Image whole = virtual_texture(pack, 0, level, {-side, -side, 8 * side, 8 * side});
    for (int step = 0; step < 300; ++step) {
      const double x = 0.01 * step + 0.001; // tiles
      const double y = 0.0131 * step;
      const double px = (x + 1) * side - 0.5;
      const double py = (y + 1) * side - 0.5;
      const int i = static_cast<int>(std::floor(px));
      const int j = static_cast<int>(std::floor(py));
      const auto got = value(truth, x, y, level, Filter::bilinear);
      for (std::size_t c = 0; c < 3; ++c) {
        const auto at = [&](int dx, int dy) { return static_cast<double>(whole.texel(i + dx, j + dy)[c]); };
        const double wanted = (at(0, 0) * (i + 1 - px) + at(1, 0) * (px - i)) * (j + 1 - py) +
                              (at(0, 1) * (i + 1 - px) + at(1, 1) * (px - i)) * (py - j);
        REQUIRE(got[c] == Approx(wanted).margin(1e-9));
      }
    }
  }
}

TEST_CASE("the true mips are boxes of level 0 and not what the pack stores") {
  const Pack pack = small_pack(linear_pack()); // its coarser levels are noise of their own
  const GroundTruth truth = GroundTruth::of_level_0(pack, 0);
  CHECK(truth.levels() == 4);
  const Image fine = virtual_texture(pack, 0, 0, {0, 0, 48, 40});
  for (int level = 1; level < 4; ++level) {
    const int box = 1 << level;
    for (int y = 0; y + box <= 40; y += box)
      for (int x = 0; x + box <= 48; x += box) {
        const auto got = value(truth, (x + box / 2.0) / 8, (y + box / 2.0) / 8, level, Filter::nearest);
        for (std::size_t c = 0; c < 3; ++c) {
          double sum = 0;
          for (int j = 0; j < box; ++j)
            for (int i = 0; i < box; ++i) sum += static_cast<double>(fine.texel(x + i, y + j)[c]);
          REQUIRE(got[c] == Approx(sum / (box * box)).margin(1e-6));
        }
      }
  }
}

TEST_CASE("the ground truth wraps and blends levels as the sampler does") {
  const Pack pack = small_pack(linear_pack());
  const GroundTruth truth = GroundTruth::of_level_0(pack, 0);
  CHECK(value(truth, -0.01, 0.3, 0, Filter::bilinear)[0] ==
        Approx(value(truth, 5.99, 5.3, 0, Filter::bilinear)[0]).margin(1e-9));
  const double fine = value(truth, 1.3, 2.2, 1, Filter::bilinear)[1];
  const double coarse = value(truth, 1.3, 2.2, 2, Filter::bilinear)[1];
  CHECK(value(truth, 1.3, 2.2, 1.25, Filter::trilinear)[1] ==
        Approx(0.75 * fine + 0.25 * coarse).margin(1e-12));
}

TEST_CASE("the tile set of a pack is what was packed") {
  const Pack pack = small_pack();
  const TileSet set = tile_set_of(pack);
  REQUIRE(set.maps.size() == 1);
  CHECK(set.maps[0].tiles == tiles_of(pack.maps[0].levels[0], pack.layout));
  CHECK(set.tiles == pack.tiles);
  CHECK_THROWS_AS(GroundTruth::of_level_0(pack, 1), Error);
}
