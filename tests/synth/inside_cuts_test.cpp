#include "support/samples.h"

#include "tilepack/exemplar/structure.h"
#include "tilepack/synth/inside_cuts.h"
#include "tilepack/synth/interiors.h"
#include "tilepack/synth/tile_levels.h"

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
            std::min({x, y, 31 - x, 31 - y}) < space.shape.reach.x ? SourceTexel{48 + x, 64 + y} : no_source;
    const InsideCuts cuts(space, framed, 10);
    CHECK(cuts.cost({48 / scale, 64 / scale}) == 0);
    for (const SourceTexel place : {SourceTexel{0, 0}, SourceTexel{96, 100}, SourceTexel{52, 64}})
      CHECK(cuts.cost({place.x / scale, place.y / scale}) > 0);
  }
}

TEST_CASE("what a coarser cut settled stays, but not against what must be kept or taken") {
  const SampleAnalysis sample = analysed(testing::features(testing::blobs(160, 144)), Periodicity{});
  FeaturePyramid pyramid(sample.features);
  pyramid.add_half();
  const SearchSpace space(
      sample, frame_shape(testing::two_colors({32, 32}, Coloring::corner, 2), {}, 0.25, 0.3), pyramid);
  SourceCanvas framed(32, 32);
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 32; ++x)
      framed.at(x, y) =
          std::min({x, y, 31 - x, 31 - y}) < space.shape.reach.x ? SourceTexel{48 + x, 64 + y} : no_source;
  for (const CutConstraint all : {CutConstraint::take, CutConstraint::keep}) {
    InsideCuts cuts(space, framed, 10, 1);
    cuts.settle(std::vector<CutConstraint>(16 * 16, all));
    const std::vector<std::uint8_t> taken = cuts.taken({3, 5});
    CHECK(taken[0] == 0);          // the guard
    CHECK(taken[8 * 16 + 8] == 1); // where there is nothing else
    CHECK(taken[8 * 16 + 2] == (all == CutConstraint::take ? 1 : 0));
  }
}

TEST_CASE("the best place near another is found row by row as by an overlap") {
  const SampleAnalysis sample = analysed(testing::features(testing::blobs(160, 144)), Periodicity{});
  FeaturePyramid pyramid(sample.features);
  pyramid.add_half();
  const SearchSpace space(
      sample, frame_shape(testing::two_colors({32, 32}, Coloring::corner, 1), {}, 0.25, 0.3), pyramid);
  SourceCanvas framed(32, 32);
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 32; ++x)
      framed.at(x, y) =
          std::min({x, y, 31 - x, 31 - y}) < space.shape.reach.x ? SourceTexel{51 + x, 63 + y} : no_source;
  const TileLevels levels(space, framed);
  for (const std::size_t level : {0u, 1u})
    for (const SourceTexel start : {SourceTexel{0, 0}, SourceTexel{50, 62}, SourceTexel{126, 111}})
      CHECK(levels.best_near(level, start, 2) ==
            best_near(space.pyramid[level], levels.overlap(level), start, 2));
  CHECK(levels.best_near(0, {50, 62}, 2) == SourceTexel{51, 63});
}
