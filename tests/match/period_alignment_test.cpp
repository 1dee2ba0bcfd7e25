#include "support/samples.h"

#include "tilepack/match/period_alignment.h"
#include "tilepack/synth/synthesize.h"

#include <catch2/catch.hpp>
#include <set>

using namespace tilepack;

namespace {

constexpr Period none{};

PeriodAlignment along_x(double period, int tile) {
  return {{{period, 1.0}, none}, {tile, tile}};
}

// Dark lines round cells of 20 x 16 texels, each cell of a tone of its own.
Image cells(int width, int height) {
  Image image(width, height, 3);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const auto cell = static_cast<std::uint64_t>(y / 16 * 100 + x / 20);
      const float tone = 0.55f + 0.004f * static_cast<float>(random_below(3, "cell", cell, 100));
      const bool line = x % 20 < 2 || y % 16 < 2;
      for (std::size_t c = 0; c < 3; ++c) image.texel(x, y)[c] = line ? 0.1f : tone;
    }
  return image;
}

} // namespace

TEST_CASE("parts are in step that lie whole periods apart, along axes where a tile holds whole periods") {
  CHECK(PeriodAlignment().free());
  CHECK(along_x(0.0, 128).free());
  CHECK(along_x(50.0, 128).free()); // 2.56 periods
  CHECK_FALSE(along_x(42.69, 128).free());
  CHECK_FALSE(along_x(85.34, 86).free()); // a texel off is near enough

  const PeriodAlignment alignment = along_x(42.69, 128).through({10, 7});
  for (const int whole : {10, 53, 95, 138, -33}) CHECK(alignment.allows({whole, 1000}, 1));
  for (const int other : {12, 20, 31, 50, 97}) CHECK_FALSE(alignment.allows({other, 7}, 1));
  CHECK(alignment.allows({12, 0}, 4)); // a search by fours has no nearer place
  CHECK_FALSE(alignment.allows({14, 0}, 4));

  const PeriodAlignment from_the_middle = alignment.seen_from({-5, 3});
  CHECK(from_the_middle.allows({5, 0}, 1));
  CHECK_FALSE(from_the_middle.allows({10, 0}, 1));
}

TEST_CASE("where courses lie even, a texel off is out of step") {
  const PeriodAlignment even = PeriodAlignment({{32.0, 1.0, false, 0.1}, none}, {128, 128}).through({5, 0});
  for (const int whole : {5, 37, 69, -27}) CHECK(even.allows({whole, 0}, 1));
  for (const int other : {4, 6, 36, 38}) CHECK_FALSE(even.allows({other, 0}, 1));
  CHECK(even.allows({39, 0}, 4)); // of a coarse search
  const PeriodAlignment fraction = PeriodAlignment({{42.5, 1.0, false, 0.1}, none}, {85, 85}).through({0, 0});
  for (const int near : {0, 42, 43, 85}) CHECK(fraction.allows({near, 0}, 1));
  for (const int other : {41, 44, 84, 86}) CHECK_FALSE(fraction.allows({other, 0}, 1));
}

TEST_CASE("a lattice repeats along both axes, and boards along one alone") {
  const PeriodAlignment wall({{32, 1.0}, {16, 1.0}}, {64, 64});
  CHECK(wall.lattice());
  CHECK(wall.holds_first_part());
  const PeriodAlignment boards({none, {16, 1.0}}, {64, 64});
  CHECK_FALSE(boards.lattice());
  CHECK_FALSE(boards.free());
  CHECK_FALSE(boards.holds_first_part());
}

TEST_CASE("of a sample that is nothing but lines all parts show the same ones") {
  Period lines;
  lines.lines = 512;
  const PeriodAlignment fixed({none, lines}, {128, 128});
  CHECK_FALSE(fixed.free());
  CHECK(fixed.holds_first_part());
  CHECK_FALSE(fixed.lattice());
  CHECK(PeriodAlignment({none, lines}, {300, 300}).free()); // too few to choose from
  const PeriodAlignment anywhere = fixed.through({77, 5});
  CHECK(anywhere.allows({3, 192}, 1));
  for (const int other : {5, 64, 191, 193, 320}) CHECK_FALSE(anywhere.allows({3, other}, 1));
  CHECK(anywhere.allows({3, 196}, 8)); // of a coarse search
  CHECK(anywhere.seen_from({0, -16}).allows({3, 176}, 1));
  CHECK(anywhere.nearest({40, 9}, {0, 0}, {400, 400}) == SourceTexel{40, 192});
}

TEST_CASE("the nearest place in step lies within the bounds wherever one does") {
  const PeriodAlignment alignment = along_x(40.0, 120).through({10, 0});
  CHECK(alignment.nearest({48, 33}, {0, 0}, {200, 200}) == SourceTexel{50, 33});
  CHECK(alignment.nearest({32, 33}, {0, 0}, {200, 200}) == SourceTexel{50, 33});
  CHECK(alignment.nearest({28, 33}, {0, 0}, {200, 200}) == SourceTexel{10, 33});
  CHECK(alignment.nearest({28, 33}, {20, 0}, {200, 200}) == SourceTexel{50, 33});
  CHECK(alignment.nearest({195, 33}, {0, 0}, {195, 200}) == SourceTexel{170, 33});
}

TEST_CASE("of a map of positions some in every period stay, all of them in step") {
  for (const int scale : {1, 2, 4}) {
    const double period = 21.34;
    const PeriodAlignment alignment =
        PeriodAlignment({{period, 1.0}, {period, 1.0}}, {64, 64}).through({5, 9});
    PositionMap map(64, 50, 1);
    rule_out_of_step(map, alignment, scale);
    std::set<int> columns, rows;
    for (int y = 0; y < map.height; ++y)
      for (int x = 0; x < map.width; ++x) {
        if (map.at(x, y) == ruled_out) continue;
        const double off_x = std::remainder(x * scale - 5, period);
        const double off_y = std::remainder(y * scale - 9, period);
        CHECK(std::max(std::abs(off_x), std::abs(off_y)) <= std::max(1.0, 0.5 * scale));
        columns.insert(static_cast<int>(std::lround((x * scale - 5 - off_x) / period)));
        rows.insert(static_cast<int>(std::lround((y * scale - 9 - off_y) / period)));
      }
    CHECK(columns.size() >= static_cast<std::size_t>(64 * scale / period));
    CHECK(rows.size() >= static_cast<std::size_t>(50 * scale / period));
  }
}

TEST_CASE("the lines of a sample run on through tiles that hold whole periods") {
  const SampleMap map = testing::color_map(cells(320, 256));
  for (const Coloring coloring : {Coloring::edge, Coloring::corner}) {
    const SourceMap made = synthesize(std::span(&map, 1), testing::two_colors({60, 64}, coloring, 3));
    // Where the first tile has its lines all others have theirs.
    const auto is_line = [&](std::size_t id, int x, int y) {
      const SourceTexel s = made.texels[id][static_cast<std::size_t>(y * 60 + x)];
      return map.image.texel(s.x, s.y)[0] < 0.3f;
    };
    int differing = 0;
    int lines = 0;
    for (std::size_t id = 0; id < made.texels.size(); ++id)
      for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 60; ++x) {
          lines += is_line(id, x, y);
          differing += is_line(id, x, y) != is_line(0, x, y);
        }
    const double all = 60.0 * 64.0 * static_cast<double>(made.texels.size());
    CHECK(lines / all == Approx(1.0 - 18.0 * 14.0 / 320.0).margin(0.02));
    CHECK(differing / all < 0.01);
  }
}
