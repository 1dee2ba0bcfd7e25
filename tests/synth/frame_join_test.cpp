#include "support/samples.h"

#include "tilepack/synth/frame.h"
#include "tilepack/synth/strip_axes.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>

using namespace tilepack;

namespace {

constexpr int guard = 3;

// A frame of two corner patches, whose parts lie anywhere in the sample.
struct SomeFrame {
  FeatureImage image = testing::features(testing::blobs(128, 120));
  FrameShape shape;
  FrameSources sources;
  Frame frame;

  SomeFrame() {
    SynthOptions options = testing::two_colors({40, 32}, Coloring::corner, 0);
    options.guard = guard;
    shape = frame_shape(options, {}, {0.2, 0.3}, {0.45, 0.4});
    sources.corners = {{30, 40}, {90, 70}};
    for (int i = 0; i < 4; ++i) {
      sources.horizontal.push_back({5 + 20 * i, 11 * i});
      sources.vertical.push_back({17 * i, 80 - 20 * i});
    }
    frame = joined_frame(FeaturePyramid(image), shape, sources);
  }

  const SourceCanvas& strip(Direction direction, std::size_t i) const {
    return direction == Direction::horizontal ? frame.horizontal[i] : frame.vertical[i];
  }
  SourceTexel place(Direction direction, std::size_t i) const {
    return direction == Direction::horizontal ? sources.horizontal[i] : sources.vertical[i];
  }
  SourceTexel corner(Direction direction, std::size_t i, End end) const {
    const auto& ends = direction == Direction::horizontal ? shape.horizontal[i] : shape.vertical[i];
    return sources.corners[static_cast<std::size_t>(end == End::first ? ends.first : ends.second)];
  }
};

// The canvas with straight cuts so far from its two ends.
SourceCanvas cut_straight(const SomeFrame& some, Direction direction, std::size_t i, int from_first,
                          int from_second) {
  const StripAxes axes = axes_of(some.shape, direction);
  SourceCanvas canvas(axes.width(), axes.height());
  for (int along = 0; along < axes.length; ++along)
    for (int across = 0; across < 2 * axes.reach; ++across) {
      const SourceTexel t = axes.at(along, across);
      SourceTexel origin = some.place(direction, i);
      if (along < from_first) origin = corner_origin(axes, some.corner(direction, i, End::first), End::first);
      if (along >= axes.length - from_second)
        origin = corner_origin(axes, some.corner(direction, i, End::second), End::second);
      canvas.at(t.x, t.y) = sum(origin, t);
    }
  return canvas;
}

} // namespace

TEST_CASE("a joined strip shows its corner patches at the ends, itself in the middle, and nothing else") {
  const SomeFrame some;
  for (const Direction direction : {Direction::horizontal, Direction::vertical}) {
    const StripAxes axes = axes_of(some.shape, direction);
    REQUIRE(2 * axes.corner_reach < axes.length);
    for (std::size_t i = 0; i < 4; ++i) {
      const SourceCanvas& canvas = some.strip(direction, i);
      REQUIRE((canvas.width == axes.width() && canvas.height == axes.height()));
      int wrong = 0;
      for (int along = 0; along < axes.length; ++along)
        for (int across = 0; across < 2 * axes.reach; ++across) {
          const SourceTexel t = axes.at(along, across);
          const End end = 2 * along < axes.length ? End::first : End::second;
          const int from_end = end == End::first ? along : axes.length - 1 - along;
          const SourceTexel own = sum(some.place(direction, i), t);
          const SourceTexel corners = sum(corner_origin(axes, some.corner(direction, i, end), end), t);
          const SourceTexel shown = canvas.at(t.x, t.y);
          wrong += from_end < guard                ? shown != corners
                   : from_end >= axes.corner_reach ? shown != own
                                                   : shown != own && shown != corners;
        }
      CHECK(wrong == 0);
    }
  }
}

TEST_CASE("strips of either direction that meet in a lattice point show the same round it") {
  const SomeFrame some;
  // Which texel lies (x, y) from the lattice point at a strip's end, -guard <= x, y < guard.
  const auto shown = [&](Direction direction, std::size_t i, End end, int x, int y) {
    const StripAxes axes = axes_of(some.shape, direction);
    const SourceTexel point = axes.at(end == End::first ? 0 : axes.length, axes.reach);
    return some.strip(direction, i).at(point.x + x, point.y + y);
  };
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      if (some.corner(Direction::horizontal, i, End::first) !=
          some.corner(Direction::vertical, j, End::first))
        continue;
      for (int y = 0; y < guard; ++y)
        for (int x = 0; x < guard; ++x)
          CHECK(shown(Direction::horizontal, i, End::first, x, y) ==
                shown(Direction::vertical, j, End::first, x, y));
    }
}

TEST_CASE("the cuts of a joined strip cost no more than any straight ones") {
  const SomeFrame some;
  std::int64_t all_cut = 0, all_straight = 0;
  for (const Direction direction : {Direction::horizontal, Direction::vertical})
    for (std::size_t i = 0; i < 4; ++i) {
      std::int64_t straight = std::numeric_limits<std::int64_t>::max();
      const int reach = axes_of(some.shape, direction).corner_reach;
      for (int a = guard; a <= reach; ++a)
        for (int b = guard; b <= reach; ++b)
          straight = std::min(straight, seam_energy(some.image, cut_straight(some, direction, i, a, b)));
      const std::int64_t cut = seam_energy(some.image, some.strip(direction, i));
      CHECK(cut <= straight); // equal where the straight one is the best there is
      all_cut += cut;
      all_straight += straight;
    }
  CHECK(all_cut < all_straight);
}
