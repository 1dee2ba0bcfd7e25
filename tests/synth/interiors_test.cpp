#include "support/samples.h"

#include "tilepack/synth/frame_search.h"
#include "tilepack/synth/interiors.h"

#include <catch2/catch.hpp>

using namespace tilepack;

namespace {

// A frame for 16 tiles, and what is chosen inside it.
struct FramedTiles {
  SampleAnalysis sample = analysed(testing::features(testing::blobs(160, 144)), Periodicity{});
  SearchSpace space{
      sample, frame_shape(testing::two_colors({32, 32}, Coloring::corner, 1), Periodicity{}, 0.125, 0.1875),
      FeaturePyramid(sample.features)};
  FrameSources sources = searched_frame(space, {}, {});
  std::vector<SourceCanvas> tiles =
      framed_tiles(space.shape, joined_frame(FeaturePyramid(sample.features), space.shape, sources));

  InteriorChoice chosen(int starts, std::uint64_t seed) const {
    InteriorOptions options;
    options.starts = starts;
    options.seed = seed;
    return chosen_interiors(space, sources, tiles, options);
  }
};

} // namespace

TEST_CASE("more orders of choosing insides never end worse, and sixteen better than one by far") {
  const FramedTiles framed;
  int better = 0;
  double of_one = 0, of_sixteen = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const double one = framed.chosen(1, seed).cost;
    const double four = framed.chosen(4, seed).cost;
    const double sixteen = framed.chosen(16, seed).cost;
    CHECK(four <= one); // its orders are among the four
    CHECK(sixteen <= four);
    better += sixteen < one;
    of_one += one;
    of_sixteen += sixteen;
  }
  CHECK(better >= 5); // of 6; one order may be the best of all
  CHECK(of_sixteen < 0.96 * of_one);
}

TEST_CASE("every tile's window lies inside the sample, and no two tiles show the same one") {
  const FramedTiles framed;
  const InteriorChoice choice = framed.chosen(16, 3);
  REQUIRE(choice.places.size() == 16);
  CHECK(choice.cost > 0.0);
  for (std::size_t i = 0; i < choice.places.size(); ++i) {
    const SourceTexel p = choice.places[i];
    CHECK((p.x >= 0 && p.y >= 0 && p.x + 32 <= 160 && p.y + 32 <= 144));
    for (std::size_t j = 0; j < i; ++j) CHECK(p != choice.places[j]);
  }
}
