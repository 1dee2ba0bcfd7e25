#include "support/samples.h"

#include "tilepack/exemplar/structure.h"
#include "tilepack/synth/inside_cuts.h"
#include "tilepack/synth/interiors.h"

#include <catch2/catch.hpp>

using namespace tilepack;

TEST_CASE("an inside that goes on where its strips come from costs nothing, at any scale") {
  const SampleAnalysis sample = analysed(testing::features(testing::blobs(160, 144)), Periodicity{});
  const FeatureImage image = with_structure(sample.features);
  for (const int levels : {1, 2}) {
    FeaturePyramid pyramid(image);
    for (int level = 1; level < levels; ++level) pyramid.add_half();
    const SearchSpace space(
        sample, frame_shape(testing::two_colors({32, 32}, Coloring::corner, 1), {}, 0.25, 0.3), pyramid);
    const int scale = space.scale();
    SourceCanvas framed(32, 32); // a window of the sample without its middle
    for (int y = 0; y < 32; ++y)
      for (int x = 0; x < 32; ++x)
        framed.at(x, y) =
            std::min({x, y, 31 - x, 31 - y}) < space.shape.reach ? SourceTexel{48 + x, 64 + y} : no_source;
    const InsideCuts cuts(space, framed, 10);
    CHECK(cuts.cost({48 / scale, 64 / scale}) == 0);
    for (const SourceTexel place : {SourceTexel{0, 0}, SourceTexel{96, 100}, SourceTexel{52, 64}})
      CHECK(cuts.cost({place.x / scale, place.y / scale}) > 0);
  }
}
