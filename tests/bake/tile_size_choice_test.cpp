#include "tilepack/bake/tile_size_choice.h"

#include <algorithm>
#include <catch2/catch.hpp>

using namespace tilepack;

namespace {

double times_sample(Size sample, int side, int tiles) {
  return static_cast<double>(tiles) * side * side / (static_cast<double>(sample.width) * sample.height);
}

} // namespace

TEST_CASE("tiles follow the size of the sample and what it shows") {
  CHECK(tile_side_for({512, 512}, 3.8, 16) == 128);  // gravel
  CHECK(tile_side_for({512, 512}, 10.6, 16) == 160); // a stone wall
  CHECK(tile_side_for({1024, 1024}, 3.8, 16) == 256);
  CHECK(tile_side_for({2048, 2048}, 15, 16) == 640);
  CHECK(tile_side_for({4096, 4096}, 15, 16) == 1280);
  CHECK(tile_side_for({8192, 8192}, 32, 16) == 2560);
  CHECK(tile_side_for({256, 256}, 3.8, 16) == 80);
  CHECK(tile_side_for({512, 512}, 3.8, 81) == 128); // further colors are for more variety
}

TEST_CASE("the memory of a pack is bounded, and the tile fits the sample") {
  for (const Size sample : {Size{64, 64}, Size{200, 300}, Size{513, 700}, Size{1023, 1500}, Size{4096, 300},
                            Size{5000, 5000}, Size{8192, 8192}})
    for (const double scale : {1.0, 4.0, 9.0, 20.0, 32.0})
      for (const int tiles : {1, 16, 81, 256, 4096}) {
        const int side = tile_side_for(sample, scale, tiles);
        INFO(sample.width << " x " << sample.height << ", scale " << scale << ", " << tiles
                          << " tiles: " << side);
        CHECK(2 * side <= std::min(sample.width, sample.height));
        if (side > 4)
          CHECK(times_sample(sample, side, tiles) <= (tiles <= 16 ? 2.5 : 8.0)); // no smaller tiles are made
        CHECK(side <= largest_tile_side_for(sample, tiles));
        if (tiles == 16 && sample.width < 2 * sample.height && sample.height < 2 * sample.width)
          CHECK(times_sample(sample, side, tiles) >= 0.9);
      }
  CHECK(tile_side_for({8, 8}, 1, 16) == 4);
  CHECK(tile_side_for({4, 4}, 1, 16) == 4); // no smaller tiles are made
}

TEST_CASE("tiles in step keep their mip levels where they can") {
  const auto periods = [](double x, double y) { return Periodicity{{x, 0.9}, {y, 0.9}}; };
  CHECK(tile_size_in_step(periods(0, 0), 160, {512, 512}) == Size{160, 160});
  CHECK(tile_size_in_step(periods(2, 0), 128, {512, 512}) == Size{128, 128});
  // 32 bricks of 5 would be 160; whole ones of 48 near it are 144 and 192, of which 192 halves more often.
  CHECK(tile_size_in_step(periods(48, 32), 160, {512, 512}) == Size{192, 160});
  const Size odd = tile_size_in_step(periods(37.3, 0), 128, {512, 512}); // nothing round fits
  CHECK(whole_periods({37.3, 0.9}, odd.width) > 0);
  CHECK(odd.height == 128);
}
