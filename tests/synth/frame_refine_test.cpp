#include "support/samples.h"

#include "tilepack/match/patch_search.h"
#include "tilepack/synth/border_step.h"
#include "tilepack/synth/frame_refine.h"
#include "tilepack/synth/strip_axes.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <limits>

using namespace tilepack;

namespace {

FrameShape shape_of(const Periodicity& periods = {}) {
  return frame_shape(testing::two_colors({32, 32}, Coloring::corner, 0), periods, 0.125, 0.1875);
}

// Found in an image of half the size.
FrameSources some_sources(const FrameShape& shape) {
  FrameSources sources;
  sources.alignment = shape.alignment.through({20, 22});
  sources.corners = {{10, 11}, {40, 33}};
  for (int i = 0; i < 4; ++i) {
    sources.horizontal.push_back({4 + 9 * i, 5 + 11 * i});
    sources.vertical.push_back({7 + 12 * i, 30 - 8 * i});
  }
  return sources;
}

// The strip's ends at a place of the sample.
std::int64_t mismatch_of(const FeatureImage& image, const FrameShape& shape, const FrameSources& sources,
                         Direction direction, std::size_t i, SourceTexel place) {
  const auto& ends = direction == Direction::horizontal ? shape.horizontal[i] : shape.vertical[i];
  return mismatch_at(image,
                     end_overlap(image, shape, axes_of(shape, direction),
                                 sources.corners[static_cast<std::size_t>(ends.first)],
                                 sources.corners[static_cast<std::size_t>(ends.second)]),
                     place);
}

// The mean step across all edges of a direction, of the sample's own.
double mean_step_of(const FeatureImage& image, const FrameShape& shape, const FrameSources& sources,
                    Direction direction) {
  const auto& places = direction == Direction::horizontal ? sources.horizontal : sources.vertical;
  const auto& ends = direction == Direction::horizontal ? shape.horizontal : shape.vertical;
  double steps = 0.0;
  for (std::size_t i = 0; i < places.size(); ++i)
    steps += step_across(image, axes_of(shape, direction), places[i],
                         sources.corners[static_cast<std::size_t>(ends[i].first)],
                         sources.corners[static_cast<std::size_t>(ends[i].second)]);
  return steps / static_cast<double>(places.size()) / mean_step(image, direction);
}

} // namespace

TEST_CASE("a frame brought to twice the size has strips where they fit best, near twice their places") {
  const FeatureImage image = testing::features(testing::blobs(128, 128));
  const FrameShape shape = shape_of();
  const FrameSources before = some_sources(shape);
  FrameSources sources = before;
  refine_frame(image, shape, 2, {}, sources);
  for (std::size_t i = 0; i < 2; ++i)
    CHECK(sources.corners[i] == SourceTexel{2 * before.corners[i].x, 2 * before.corners[i].y});
  for (const Direction direction : {Direction::horizontal, Direction::vertical})
    for (std::size_t i = 0; i < 4; ++i) {
      const bool horizontal = direction == Direction::horizontal;
      const SourceTexel half = horizontal ? before.horizontal[i] : before.vertical[i];
      const SourceTexel place = horizontal ? sources.horizontal[i] : sources.vertical[i];
      CHECK((std::abs(place.x - 2 * half.x) <= 2 && std::abs(place.y - 2 * half.y) <= 2));
      std::int64_t least = std::numeric_limits<std::int64_t>::max();
      for (int dy = -2; dy <= 2; ++dy)
        for (int dx = -2; dx <= 2; ++dx)
          least = std::min(
              least, mismatch_of(image, shape, sources, direction, i, {2 * half.x + dx, 2 * half.y + dy}));
      CHECK(mismatch_of(image, shape, sources, direction, i, place) == least);
    }
}

TEST_CASE("at full size strips are chosen so that the step across edges comes out as wanted") {
  const FeatureImage image = testing::features(testing::blobs(128, 128));
  const FrameShape shape = shape_of();
  FrameRefineOptions options;
  const auto off = [&](double step_weight, double wanted, Direction direction) {
    options.step_weight = step_weight;
    options.wanted_step = wanted;
    FrameSources sources = some_sources(shape);
    refine_frame(image, shape, 1, options, sources);
    return std::abs(mean_step_of(image, shape, sources, direction) - wanted);
  };
  for (const Direction direction : {Direction::horizontal, Direction::vertical})
    for (const double wanted : {0.9, 1.1}) {
      CHECK(off(400.0, wanted, direction) < 0.06);
      CHECK(off(400.0, wanted, direction) <= off(0.0, wanted, direction));
    }
}

TEST_CASE("at full size corner patches are exactly in step, and strips within a texel") {
  const FeatureImage image = testing::features(testing::blobs(128, 128));
  const FrameShape shape = shape_of({{8.0, 1.0}, {16.0, 1.0}});
  REQUIRE_FALSE(shape.alignment.free());
  FrameSources sources = some_sources(shape);
  for (int i = 0; i < 4; ++i) { // a texel of the half size out of step, in x and in y
    const auto n = static_cast<std::size_t>(i);
    sources.horizontal[n] = {11 + 4 * i, 10 + 8 * i};
    sources.vertical[n] = {7 + 8 * i, 12 + 8 * i};
  }
  refine_frame(image, shape, 1, {}, sources);
  CHECK(sources.corners[0] == SourceTexel{20, 22}); // through which the alignment goes
  CHECK((sources.corners[1].x - 20) % 8 == 0);
  CHECK((sources.corners[1].y - 22) % 16 == 0);
  for (const Direction direction : {Direction::horizontal, Direction::vertical}) {
    const PeriodAlignment own = sources.alignment.seen_from(strip_place(axes_of(shape, direction), 1));
    for (const SourceTexel place : direction == Direction::horizontal ? sources.horizontal : sources.vertical)
      CHECK(own.allows(place, 1));
  }
}

TEST_CASE("strips at the border of a sample stay in step, though the nearest place in step lies beyond it") {
  const FeatureImage image = testing::features(testing::blobs(128, 128));
  Periodicity periods;
  periods.x.length = periods.y.length = 16;
  const FrameShape shape = shape_of(periods);
  for (const SourceTexel through : {SourceTexel{20, 22}, {27, 17}, {31, 28}}) {
    FrameSources sources = some_sources(shape);
    sources.alignment = shape.alignment.through(through);
    sources.horizontal = {{0, 0}, {48, 0}, {0, 60}, {48, 60}};
    sources.vertical = {{0, 0}, {60, 0}, {0, 48}, {60, 48}};
    refine_frame(image, shape, 1, {}, sources);
    for (const Direction direction : {Direction::horizontal, Direction::vertical})
      for (const SourceTexel place :
           direction == Direction::horizontal ? sources.horizontal : sources.vertical) {
        CAPTURE(through.x, through.y, place.x, place.y);
        CHECK(sources.alignment.seen_from(strip_place(axes_of(shape, direction), 1)).allows(place, 1));
      }
  }
}
