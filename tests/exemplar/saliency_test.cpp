#include "support/enlarged.h"
#include "support/samples.h"

#include "tilepack/exemplar/saliency.h"
#include "tilepack/synth/framed_set.h"
#include "tilepack/synth/set_report.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <vector>

using namespace tilepack;
using testing::blobs;
using testing::features;

namespace {

// Grey blobs, and one spot of them that is no brighter and no darker but red.
Image with_red_spot(int side, int west, int north, int width) {
  Image image = blobs(side, side);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const auto texel = image.texel(x, y);
      const float grey = 0.3f + 0.4f * texel[0];
      const bool red = x >= west && x < west + width && y >= north && y < north + width;
      texel[0] = red ? grey + 0.1f : grey;
      texel[1] = grey;
      texel[2] = red ? grey - 0.1f : grey;
    }
  return image;
}

} // namespace

TEST_CASE("a cell of another hue stands out, though it is as bright as the rest") {
  const Saliency cells = saliency_of(features(with_red_spot(256, 96, 160, 16)));
  REQUIRE((cells.wide == 16 && cells.high == 16));
  const auto most = std::max_element(cells.values.begin(), cells.values.end());
  CHECK(most - cells.values.begin() == 10 * 16 + 6);
  CHECK(*most > 10);
  CHECK(std::count_if(cells.values.begin(), cells.values.end(),
                      [](double d) { return d > salient_deviation; }) < 10);
  // A sample of one value, and one too small for a cell.
  const Saliency plain = saliency_of(features(Image(40, 33, 3, 0.5f)));
  CHECK(plain.values == std::vector<double>(4, 0.0));
  CHECK(saliency_of(features(Image(15, 40, 3, 0.5f))).values.empty());
}

TEST_CASE("an area stands out by the cells that it holds half of") {
  Saliency cells{3, 2, {1, 2, 3, 4, 5.5, 6}};
  CHECK(excess_in(cells, {0, 0, 48, 16}) == 0.0);
  CHECK(excess_in(cells, {0, 0, 48, 24}) == 3.0);
  CHECK(excess_in(cells, {0, 0, 48, 23}) == 0.0); // 7 of 16 rows
  CHECK(excess_in(cells, {0, 16, 32, 16}) == 2.5);
  CHECK(excess_in(cells, {-50, -50, 500, 500}) == 3.0);
  CHECK(excess_in(cells, {100, 100, 10, 10}) == 0.0);
  CHECK(excess_in({}, {0, 0, 10, 10}) == 0.0);
}

TEST_CASE("what the eye would find again is shown by few tiles") {
  // Wherever it lies: neither corner patches and strips, which half and a quarter of the tiles show, nor the
  // insides of several tiles should show it.
  double with = 0.0, without = 0.0;
  for (const int place : {32, 64, 96}) {
    const Image image = with_red_spot(160, place, place, 32);
    const SampleAnalysis sample = analysed(features(image), {});
    for (const Coloring coloring : {Coloring::corner, Coloring::edge})
      for (std::uint64_t seed = 0; seed < 4; ++seed) {
        SynthOptions options = testing::two_colors({64, 64}, coloring, 0);
        options.seed = seed;
        FramedSetSettings settings = settings_for(0, seed);
        const auto shown = [&] {
          return set_report(sample, framed_set(sample, options, settings)).landmark.shown;
        };
        with += shown();
        settings.frame.saliency_weight = settings.interiors.saliency_weight = 0.0;
        without += shown();
      }
  }
  INFO(with / 24 << " of the tiles, and " << without / 24 << " where nothing is done about it");
  // One of 16 tiles is 0.0625, and the sample holds six. The spot is the largest thing in this noise, so strips
  // reach 3/8 of a tile for its sake; of narrow ones .12 is shown.
  CHECK(with < 0.5 * without);
  CHECK(with / 24 < 0.16);
  CHECK(with < 0.6 * without);
}

TEST_CASE("what stands out in a sample for larger tiles is as many texels larger") {
  const Image small = with_red_spot(512, 96, 160, 16);
  const Saliency cells = saliency_of(features(small)),
                 large = saliency_of(features(testing::enlarged(small, 2)), 1);
  CHECK(cells.side == 16);
  REQUIRE(large.side == 32);
  REQUIRE((large.wide == cells.wide && large.high == cells.high));
  const auto first = [](const Saliency& s) {
    return std::max_element(s.values.begin(), s.values.end()) - s.values.begin();
  };
  CHECK(first(large) == first(cells));
  CHECK(excess_in(large, {192, 320, 32, 32}) == Approx(excess_in(cells, {96, 160, 16, 16})).epsilon(0.05));
}
