#include "support/samples.h"

#include "tilepack/synth/border_step.h"

#include <catch2/catch.hpp>

using namespace tilepack;

TEST_CASE("the step across a strip is that of the corner patches near its ends and its own between") {
  // Rows of 0 and 90 in turn in the west, flat in the east.
  Image image(64, 64, 1);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) image.texel(x, y)[0] = x < 40 && y % 2 == 1 ? 90.0F / 255.0F : 0.0F;
  const SampleMap map{"height.png", Role::data, Encoding::linear, Depth::u8, std::move(image)};
  const FeatureImage features = feature_image(std::span(&map, 1));
  const int high = features.texel(0, 1)[0];
  CHECK(mean_step(features, Direction::horizontal) == Approx(high * 40.0 / 64.0));
  CHECK(mean_step(features, Direction::vertical) == Approx(high * 0.5 / 63.0));
  FrameShape shape;
  shape.tile = {16, 16};
  shape.reach = {2, 2};
  shape.corner_reach = {4, 4};
  const StripAxes axes = axes_of(shape, Direction::horizontal);
  const SourceTexel flat{56, 32};
  const SourceTexel striped{20, 32};
  CHECK(step_across(features, axes, {0, 30}) == Approx(high));
  CHECK(step_across(features, axes, {44, 30}) == 0.0);
  CHECK(step_across(features, axes, {0, 30}, striped, striped) == Approx(high));
  CHECK(step_across(features, axes, {0, 30}, flat, striped) == Approx(high * 14.0 / 16.0));
  CHECK(step_across(features, axes, {44, 30}, flat, striped) == Approx(high * 2.0 / 16.0));
}
