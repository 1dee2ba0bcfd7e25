#include "support/samples.h"

#include "tilepack/numeric/random.h"
#include "tilepack/seam/source_canvas.h"
#include "tilepack/synth/frame_search.h"
#include "tilepack/synth/interiors.h"
#include "tilepack/synth/set_repair.h"
#include "tilepack/synth/shared_window.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <utility>

using namespace tilepack;

namespace {

// A set whose insides are joined, in need of repair.
struct JoinedSet {
  SampleAnalysis sample = analysed(testing::features(testing::blobs(160, 144)), Periodicity{});
  SearchSpace space;
  FrameSources sources;
  std::vector<SourceCanvas> tiles;

  explicit JoinedSet(Coloring coloring = Coloring::corner, int levels = 1)
      : space(sample, frame_shape(testing::two_colors({64, 64}, coloring, 1), Periodicity{}, 0.25, 0.3),
              pyramid(sample, levels)),
        sources(searched_frame(space, {}, {})),
        tiles(
            framed_tiles(space.shape, joined_frame(FeaturePyramid(sample.features), space.shape, sources))) {
    join_interiors(space, chosen_interiors(space, sources, tiles, {}).places, 10, tiles);
  }

  static FeaturePyramid pyramid(const SampleAnalysis& sample, int levels) {
    FeaturePyramid result(sample.features);
    while (static_cast<int>(result.size()) < levels) result.add_half();
    return result;
  }

  // Each tile once, and each border as often as there are tiles that have it in the north or west.
  std::int64_t energy() const {
    const FrameShape& shape = space.shape;
    std::int64_t sum = 0;
    for (const SourceCanvas& tile : tiles) sum += seam_energy(sample.features, tile);
    for (std::size_t a = 0; a < tiles.size(); ++a)
      for (std::size_t b = 0; b < tiles.size(); ++b)
        for (int i = 0; i < 64; ++i) {
          // Of all tiles before it the first stands for all: what they show at the border is shared.
          const auto first = [&](auto&& same) {
            std::size_t id = 0;
            while (!same(shape.tiles[id])) ++id;
            return id;
          };
          const FrameShape::Tile& after = shape.tiles[b];
          if (a == first([&](const FrameShape::Tile& t) { return t.east == after.west; }))
            sum += seam_cost(sample.features, tiles[a].at(63, i), tiles[b].at(0, i), 1, 0);
          if (a == first([&](const FrameShape::Tile& t) { return t.south == after.north; }))
            sum += seam_cost(sample.features, tiles[a].at(i, 63), tiles[b].at(i, 0), 0, 1);
        }
    return sum;
  }

  // What tiles share within the guard they show alike.
  bool borders_agree() const {
    const FrameShape& shape = space.shape;
    for (std::size_t a = 0; a < tiles.size(); ++a)
      for (std::size_t b = 0; b < a; ++b)
        for (int i = 0; i < 64; ++i) {
          const FrameShape::Tile &s = shape.tiles[a], &t = shape.tiles[b];
          if (s.north == t.north && tiles[a].at(i, 0) != tiles[b].at(i, 0)) return false;
          if (s.south == t.south && tiles[a].at(i, 63) != tiles[b].at(i, 63)) return false;
          if (s.west == t.west && tiles[a].at(0, i) != tiles[b].at(0, i)) return false;
          if (s.east == t.east && tiles[a].at(63, i) != tiles[b].at(63, i)) return false;
        }
    return true;
  }
};

} // namespace

TEST_CASE("a window laid over all that meet lowers the energy of the set by what its cut says") {
  for (const Coloring coloring : {Coloring::corner, Coloring::edge}) {
    JoinedSet set(coloring);
    REQUIRE(set.borders_agree());
    int laid_windows = 0;
    for (std::uint64_t n = 0; n < 12; ++n) {
      const SharedWindow window =
          n % 3 == 0   ? window_at_corner(set.space.shape, 0, {-16, -12, 30, 24})
          : n % 3 == 1 ? window_on_edge(set.space.shape, Direction::horizontal, n % 2, {20, -14, 24, 28})
                       : window_on_edge(set.space.shape, Direction::vertical, n % 2, {-14, 0, 28, 40});
      const LaidWindow laid{
          window,
          {static_cast<int>(random_below(n, "x", 0, 120)), static_cast<int>(random_below(n, "y", 0, 100))}};
      const std::int64_t before = set.energy();
      const WindowCut cut = cut_of_window(set.sample.features, set.space.shape, laid, set.tiles);
      CHECK(cut.gain >= 0);
      laid_windows += apply(laid, cut.decisions, set.tiles);
      CHECK(before - set.energy() == cut.gain);
      CHECK(set.borders_agree());
    }
    CHECK(laid_windows > 0);
  }
}

TEST_CASE("a price on what only one tile shows keeps more of it") {
  JoinedSet set;
  const SharedWindow window = window_at_corner(set.space.shape, 0, {-24, -24, 48, 48});
  const auto taken = [&](std::int64_t price) {
    std::size_t count = 0;
    for (int n = 0; n < 6; ++n)
      for (const auto& part :
           cut_of_window(set.sample.features, set.space.shape, {window, {15 * n, 12 * n}, price}, set.tiles)
               .decisions)
        count += static_cast<std::size_t>(std::count(part.begin(), part.end(), CutConstraint::take));
    return count;
  };
  const std::size_t free = taken(0);
  CHECK(free > 0);
  CHECK(taken(100'000'000) < free);
}

TEST_CASE("what is decided at a smaller scale is decided, but for a band along its lines") {
  JoinedSet set;
  const SharedWindow window = window_on_edge(set.space.shape, Direction::horizontal, 0, {0, -16, 32, 32});
  WindowDecisions small;
  for (std::size_t n = 0; n < window.parts.size(); ++n) {
    std::vector<CutConstraint>& own = small.emplace_back();
    for (int i = 0; i < 4 * 8; ++i) own.push_back(i % 8 < 4 ? CutConstraint::take : CutConstraint::keep);
  }
  for (const auto& part : enlarged(small, window, 4)) {
    REQUIRE(part.size() == 16 * 32);
    for (std::size_t i = 0; i < part.size(); ++i)
      CHECK(part[i] == (i % 32 < 12   ? CutConstraint::take
                        : i % 32 < 20 ? CutConstraint::free
                                      : CutConstraint::keep));
  }
}

TEST_CASE("repairing a set lowers its energy, and tiles go on to match") {
  for (const auto& [coloring, levels] :
       {std::pair{Coloring::corner, 1}, std::pair{Coloring::corner, 2}, std::pair{Coloring::edge, 2}}) {
    JoinedSet set(coloring, levels);
    const std::int64_t before = set.energy();
    const UseTable none = prepared(UseCounts(set.space.small_image().width, set.space.small_image().height));
    const auto repaired = [&](const SetRepairOptions& options) {
      std::vector<SourceCanvas> tiles = set.tiles;
      repair_set(set.space, set.sources.alignment, none, options, tiles);
      return tiles;
    };
    const auto same = [&](const std::vector<SourceCanvas>& tiles) {
      return std::equal(tiles.begin(), tiles.end(), set.tiles.begin(),
                        [](const SourceCanvas& a, const SourceCanvas& b) { return a.texels == b.texels; });
    };
    SetRepairOptions nothing, never, any;
    nothing.corner_tries = nothing.edge_spots = 0;
    never.least_gain = 1.0; // no window mends all
    any.least_gain = 0.0;
    CHECK(same(repaired(nothing)));
    CHECK(same(repaired(never)));
    set.tiles = repaired(any);
    CHECK(set.energy() < before);
    CHECK(set.borders_agree());
  }
}
