#include "support/samples.h"

#include "tilepack/exemplar/cheapest_lines.h"
#include "tilepack/exemplar/structure.h"

#include <catch2/catch.hpp>

using namespace tilepack;

namespace {

// A wall of `brick` and half that size high, laid by half, in joints of 4 texels, the first of which begin at `first`.
FeatureImage wall(int brick, int first, int joint) {
  const int course = brick / 2;
  FeatureImage image{6 * brick, 6 * brick, 1, {}};
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const int row = (y - first + 8 * course) / course;
      const int shifted = x - first + 8 * brick + (row % 2) * brick / 2;
      const bool in_joint = (y - first + 8 * course) % course < 4 || shifted % brick < 4;
      const auto own = static_cast<std::uint8_t>(60 + (37 * row + 71 * (shifted / brick)) % 120);
      image.values.push_back(in_joint ? static_cast<std::uint8_t>(joint) : own);
    }
  return image;
}

Periodicity bond(double x, double y) {
  Periodicity periods;
  periods.x.length = x;
  periods.y.length = y;
  return periods;
}

} // namespace

TEST_CASE("cuts cost least in the joints of a wall, wherever they lie and whatever their color") {
  for (const int first : {0, 5, 21})
    for (const int joint : {20, 120, 240}) {
      const FeatureImage image = with_structure(wall(32, first, joint));
      const SourceTexel lines = cheapest_lines(image, bond(32, 32));
      // Joints of a course lie in the middles of the bricks of the next, so either will do across.
      const int x = (lines.x - first + 32) % 16, y = (lines.y - first + 32) % 16;
      CAPTURE(first, joint, lines.x, lines.y);
      CHECK(x < 4);
      CHECK(y < 4);
    }
}

TEST_CASE("lines are found for axes with a period alone") {
  const FeatureImage image = with_structure(wall(32, 9, 240));
  CHECK(cheapest_lines(image, {}) == SourceTexel{0, 0});
  CHECK(cheapest_lines(image, bond(0, 32)).x == 0);
  CHECK(cheapest_lines(image, bond(0, 32)).y == cheapest_lines(image, bond(32, 32)).y);
}

TEST_CASE("all joints of a wall are outlines, though some bricks stand out from them more") {
  const FeatureImage plain = wall(64, 0, 240); // bricks from 60 to 179
  StructureOptions options;
  options.most_strong_share = 0.35;
  const FeatureImage image = with_structure(plain, options), steepest = with_structure(plain);
  int on_steepest = 0;
  int beside_joints = 0, on_outline = 0;
  for (int y = 40; y < 150; ++y)
    for (int x = 40; x < 150; ++x) {
      const bool at_joint = image.texel(x, y)[0] == 240 && image.texel(x + 1, y)[0] != 240;
      beside_joints += at_joint;
      on_outline += at_joint && image.texel(x, y)[1] < 40;
      on_steepest += at_joint && steepest.texel(x, y)[1] < 40;
    }
  CHECK(beside_joints > 100);
  CHECK(on_outline == beside_joints);
  CHECK(on_steepest < beside_joints); // what there is to mend
}
