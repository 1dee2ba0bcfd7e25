#include "tilepack/error/error.h"
#include "tilepack/numeric/random.h"
#include "tilepack/pattern/animation.h"
#include "tilepack/pattern/areas.h"
#include "tilepack/pattern/height_blend.h"
#include "tilepack/pattern/pattern_choice.h"
#include "tilepack/pattern/pixel_map.h"
#include "tilepack/pattern/sprite_map.h"
#include "tilepack/pattern/transition_tiles.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>
#include <vector>

using namespace tilepack;

TEST_CASE("grids are found in integers at any size", "[pattern]") {
  const std::int64_t units = std::int64_t{1} << 31;
  const GridAxis coarser{units / 8, units}, finer{units, units / 4};
  CHECK(coarser.cell_of({units - 1, 0.5}) == TileCoordinate{units / 8 - 1, 7.5 / 8});
  CHECK(finer.cell_of({units / 4 - 1, 0.8125}) == TileCoordinate{units - 1, 0.25});
  CHECK(finer.cell_of({-1, 0.8125}) == TileCoordinate{units - 1, 0.25});
  CHECK(coarser.cell_of({units, 0}) == TileCoordinate{0, 0});
  for (const GridAxis& axis : {coarser, finer, GridAxis{7, 7}})
    for (const std::int64_t cell : {std::int64_t{0}, std::int64_t{3}, axis.cells - 1})
      CHECK(axis.cell_of(axis.place_in(cell, 0.5)).tile == cell);
  CHECK(fits_scene(12, 4));
  CHECK(fits_scene(4, 12));
  CHECK_FALSE(fits_scene(9, 12));
}

TEST_CASE("a probability map has the shares asked for", "[pattern]") {
  CHECK(probability_map(std::vector<double>{0.5, 0.25, 0.25}, 4) == std::vector<int>{0, 0, 1, 2});
  CHECK(probability_map(std::vector<double>{1.0 / 3, 1.0 / 3, 1.0 / 3}, 16).size() == 16);
  const std::vector<double> shares{0.1, 0.2, 0, 0.7};
  const std::vector<double> got = shares_of(probability_map(shares, 64), 4);
  for (std::size_t i = 0; i < shares.size(); ++i) CHECK(std::fabs(got[i] - shares[i]) < 1.0 / 64);
  CHECK(got[2] == 0);
  CHECK_THROWS_AS(probability_map(std::vector<double>{0.5, 0.4}, 16), Error);
  CHECK_THROWS_AS(probability_map(std::vector<double>{1.5, -0.5}, 16), Error);
}

TEST_CASE("dithering has the wanted mean", "[pattern]") {
  for (const double bx : {0.0, 0.3, 1.0})
    for (const double by : {0.0, 0.25, 0.9}) {
      double sum[4] = {};
      constexpr int side = 200;
      for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i)
          sum[dithered(0, 1, 2, 3, bx, by, (i + 0.5) / side, (j + 0.5) / side)] += 1.0 / (side * side);
      CHECK(sum[0] == Approx((1 - bx) * (1 - by)).margin(1e-9));
      CHECK(sum[1] == Approx(bx * (1 - by)).margin(1e-9));
      CHECK(sum[2] == Approx((1 - bx) * by).margin(1e-9));
      CHECK(sum[3] == Approx(bx * by).margin(1e-9));
    }
}

TEST_CASE("an animation plays its frames, at rest before them", "[pattern]") {
  const AnimationCycle cycle{3, 2, 0};
  std::vector<int> frames;
  for (int t = -5; t < 10; ++t) frames.push_back(cycle.frame(t));
  CHECK(frames == std::vector<int>{0, 0, 0, 1, 2, 0, 0, 0, 1, 2, 0, 0, 0, 1, 2});
  CHECK(AnimationCycle{3, 2, 3}.frame(0) == 1);
  CHECK(rest_steps(0.5, 5) == 2);
  CHECK(rest_steps(-1, 5) == 0);
  CHECK(rest_steps(std::nan(""), 5) == 0);
}

namespace {

/// Whether all frames about t₀ follow each other.
template <typename Frame>
bool without_a_jump(const Frame& frame, int n, std::int64_t start) {
  for (std::int64_t t = start - n; t < start + 4 * n; ++t)
    if (!follows(frame(t), frame(t + 1), n)) return false;
  return true;
}

} // namespace

TEST_CASE("no change of an animation makes it jump", "[pattern]") {
  // All lengths to 12, all rests aZ and a'Z' to 2n + 1, all phases and with them all t₀.
  std::int64_t tried = 0, printed_jumps = 0;
  for (int n = 1; n <= 12; ++n)
    for (int rest = 0; rest <= 2 * n + 1; ++rest)
      for (int rest_before = 0; rest_before <= 2 * n + 1; ++rest_before)
        for (int start = 0; start<(n + rest) * (n + rest_before); start += n> 6 ? 5 : 1) {
          const TemporalTransition change{{n, rest_before, 0}, {n, rest, 0}, start};
          if (!without_a_jump([&](std::int64_t t) { return change.frame(t); }, n, start)) {
            INFO(n << " " << rest_before << " to " << rest << " at " << start);
            FAIL("it jumps");
          }
          // What is shown 2n steps on is the new cycle.
          for (int t = 0; t < n; ++t)
            if (change.frame(start + 2 * n + t) != change.after.frame(start + 2 * n + t))
              FAIL("not over after 2n");
          // As printed: t_f = t₀ - 1 where p'(t₀) = 0.
          const auto printed = [&](std::int64_t t) {
            const int old = change.before.frame(start);
            const std::int64_t last = old == 0 ? start - 1 : start + n - old;
            if (t <= last) return change.before.frame(t);
            const int entering = change.after.frame(last);
            return entering > 0 && t <= last + n - entering ? 0 : change.after.frame(t);
          };
          printed_jumps += without_a_jump(printed, n, start) ? 0 : 1;
          ++tried;
        }
  CHECK(tried > 100000);
  CHECK(printed_jumps > 0);
}

TEST_CASE("two changes within 2n steps may make an animation jump, later ones don't", "[pattern]") {
  constexpr int n = 5;
  const auto jumps = [&](int gap) {
    int count = 0;
    for (int rest = 0; rest <= n; ++rest)
      for (int start = 0; start < 60; ++start) {
        const AnimationCycle a{n, 3, 0}, b{n, rest, 0}, c{n, 7, 0};
        const TemporalTransition first{a, b, start}, second{b, c, start + gap};
        // The user hands on b as the old parameters at the second change.
        const auto frame = [&](std::int64_t t) { return t < start + gap ? first.frame(t) : second.frame(t); };
        count += without_a_jump(frame, n, start + gap) ? 0 : 1;
      }
    return count;
  };
  CHECK(jumps(3) > 0);
  CHECK(jumps(2 * n) == 0);
  CHECK(jumps(2 * n + 3) == 0);
}

TEST_CASE("a shrunk pattern stays inside its cell, an overflowing one is where it is put", "[pattern]") {
  for (std::uint64_t k = 0; k < 200; ++k) {
    const auto number = [&](const char* what) { return random_below(3, what, k, 1000) / 999.0; };
    TileTransform t{number("x"), number("y"), 0.05 + 0.95 * number("scale")};
    t.turn(number("turn"));
    t.shrink_to_fit();
    for (int i = 0; i < 64; ++i) { // all round the cell's border nothing shows
      const double along = (i + 0.5) / 64;
      for (const auto& [u, v] :
           {std::pair{along, -1e-9}, {along, 1 + 1e-9}, {-1e-9, along}, {1 + 1e-9, along}})
        CHECK_FALSE(t.shrunk(u, v).shown());
    }
    const TileTransform centred = t.centred_when_shrunk();
    CHECK(centred.overflowed(0.3, 0.7).u == Approx(t.shrunk(0.3, 0.7).u).margin(1e-12));
    CHECK(centred.overflowed(centred.x, centred.y).u == Approx(0.5));
  }
  TileTransform quarter{0.5, 0.5, 1};
  quarter.turn(0.25); // clockwise: the pattern's east shows in the south
  CHECK(quarter.overflowed(0.5, 0.9).u == Approx(0.9));
  CHECK(quarter.overflowed(0.5, 0.9).v == Approx(0.5));
}

TEST_CASE("a sprite is in the four cells it covers, wherever it is moved", "[pattern]") {
  SpriteMap map({8, 8}, 2);
  map.set(0, {3, {{2, 0.9}, {7, 0.8}}, 0.5});
  CHECK(map.occupied_cells() == 4);
  CHECK(map.in_cell({2, 7}).size() == 1);
  CHECK(map.in_cell({3, 0}).size() == 1); // round the border
  // The same place of the sprite from either side of a border.
  const TileTransform::Inside west = map.inside(0, {2, 7}, 1.0, 0.75),
                              east = map.inside(0, {3, 7}, 0.0, 0.75);
  CHECK(west.u == Approx(east.u));
  CHECK(west.v == Approx(east.v));
  CHECK(map.inside(0, {3, 0}, 0.0, 0.0).v == Approx(0.9));
  map.set(0, {3, {{5, 0.5}, {5, 0.5}}, 0.5});
  CHECK(map.occupied_cells() == 1);
  map.set(1, {1, {{5, 0.5}, {5, 0.4}}, 0.3});
  CHECK_THROWS_AS(map.set(2, {1, {{5, 0.4}, {5, 0.4}}, 0.3}), Error); // full
  CHECK_THROWS_AS(map.set(3, {1, {{1, 0.4}, {1, 0.4}}, 1.5}), Error); // larger than a cell
  CHECK(map.occupied_cells() == 1);
  map.remove(0);
  map.remove(1);
  CHECK(map.occupied_cells() == 0);
}

TEST_CASE("transition tiles are numbered as corner tiles are", "[pattern]") {
  CHECK(transition_code({1, 0, 1, 1}, 2) == 11);
  CHECK(transition_code({2, 1, 0, 2}, 3) == 65);
  CHECK(border_code({4, 0, 4, 1}, 4) == 10);
  CHECK(CornerMaterials{2, 2, 2, 2}.plain());
  CHECK_FALSE(CornerMaterials{2, 2, 1, 2}.plain());
}

TEST_CASE("a pixel map holds what it was made of, and grows with its boundary", "[pattern]") {
  Grid<std::uint8_t> pixels(37, 21);
  for (int y = 0; y < 21; ++y)
    for (int x = 0; x < 37; ++x)
      pixels.at(x, y) = static_cast<std::uint8_t>(x + y > 30 ? 2 : (x / 9 + y / 7) % 2);
  const PixelMap map(pixels, 3);
  double all[3] = {};
  for (int y = 0; y < 21; ++y)
    for (int x = 0; x < 37; ++x) {
      const PixelMap::Run run = map.at(x, y);
      REQUIRE(run.material == pixels.at(x, y));
      REQUIRE(run.end > x);
      for (std::int64_t i = x; i < run.end; ++i) REQUIRE(pixels.at(static_cast<int>(i), y) == run.material);
      ++all[pixels.at(x, y)];
    }
  std::vector<double> shares(3);
  map.add_shares(0, 0, 6, 1, shares);
  for (std::size_t m = 0; m < 3; ++m) CHECK(shares[m] == Approx(all[m] / (64 * 64)).margin(1e-6));
  CHECK_THROWS_AS(PixelMap(pixels, 2), Error);

  // An outline by brute force, with points on pixel centres too.
  const auto star = [](double side) {
    std::vector<double> points;
    for (const double p : {0.1, 0.1, 0.9, 0.35, 0.2, 0.9, 0.5, 0.0, 0.75, 0.95})
      points.push_back(std::floor(p * side) + 0.5);
    return MaterialOutline{1, points};
  };
  const MaterialOutline outline = star(100);
  const PixelMap drawn(100, 100, 2, 0, std::vector{outline});
  const auto inside = [&](double x, double y) {
    bool in = false;
    const std::vector<double>& p = outline.points;
    for (std::size_t i = 0, j = p.size() - 2; i < p.size(); j = i, i += 2) {
      const double nudge = 1e-7;
      const double y0 = p[i + 1] + nudge, y1 = p[j + 1] + nudge, x0 = p[i] + nudge, x1 = p[j] + nudge;
      if ((y0 <= y) != (y1 <= y) && x < x0 + (y - y0) / (y1 - y0) * (x1 - x0)) in = !in;
    }
    return in;
  };
  int differ = 0;
  for (int y = 0; y < 100; ++y)
    for (int x = 0; x < 100; ++x) differ += drawn.at(x, y).material != (inside(x + 0.5, y + 0.5) ? 1 : 0);
  CHECK(differ <= 4); // points that lie on an edge
  const auto bytes = [&](double side) {
    return static_cast<double>(PixelMap(static_cast<std::int64_t>(side), static_cast<std::int64_t>(side), 2,
                                        0, std::vector{star(side)})
                                   .bytes());
  };
  const double ratio = bytes(16384) / bytes(8192);
  CHECK(ratio > 1.8);
  CHECK(ratio < 2.2);
}

TEST_CASE("heights decide which material shows, and nothing shows where it has no coverage", "[pattern]") {
  const auto weights = [](double b, double h1, double h2, double relief, double softness) {
    std::vector<double> out(2);
    height_weights(std::vector<double>{1 - b, b}, std::vector<double>{h1, h2}, relief, softness, out);
    return out;
  };
  CHECK(weights(0.5, 0.5, 0.5, 0.5, 0.1)[1] == Approx(0.5));
  CHECK(weights(0.4, 0.1, 0.9, 0.5, 0.1)[1] == Approx(1)); // the higher one comes earlier
  CHECK(weights(0, 0, 1, 0.7, 0.3)[1] == 0);
  CHECK(weights(1, 1, 0, 0.7, 0.3)[0] == 0);
  double largest_step = 0;
  for (int i = 0; i < 10000; ++i)
    largest_step = std::max(largest_step, std::fabs(weights(i / 10000.0, 0.3, 0.8, 0.7, 0.3)[1] -
                                                    weights((i + 1) / 10000.0, 0.3, 0.8, 0.7, 0.3)[1]));
  CHECK(largest_step < 0.002);
}

TEST_CASE("normals blend as slopes", "[pattern]") {
  const auto stored = [](double slope) {
    const double length = std::sqrt(slope * slope + 1);
    return std::vector<double>{0.5 + 0.5 * slope / length, 0.5, 0.5 + 0.5 / length};
  };
  SlopeSum sum;
  sum.add(stored(3), 0.5);
  sum.add(stored(1), 0.5);
  std::vector<double> blended(3);
  sum.resolve(blended);
  for (std::size_t c = 0; c < 3; ++c) CHECK(blended[c] == Approx(stored(2)[c]));
}
