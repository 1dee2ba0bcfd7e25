#include "tilepack/numeric/random.h"
#include "tilepack/scanline/coverage.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

using namespace tilepack;

namespace {

std::vector<int> counts(const std::vector<SnappedTriangle>& triangles, Size size) {
  std::vector<int> hits(static_cast<std::size_t>(size.width * size.height), 0);
  std::vector<PixelRun> runs;
  for (const auto& t : triangles) append_coverage(t, size, 0, size.height, runs);
  for (const PixelRun& run : runs)
    for (int x = run.first; x < run.first + run.count; ++x)
      ++hits[static_cast<std::size_t>(run.row * size.width + x)];
  return hits;
}

SnappedPoint random_point(std::uint64_t i, int low, int high) {
  const auto range = static_cast<std::uint32_t>(high - low);
  return {low + static_cast<std::int64_t>(random_below(11, "x", i, range)),
          low + static_cast<std::int64_t>(random_below(11, "y", i, range))};
}

// Twice the signed area of a, b, p.
std::int64_t side(SnappedPoint a, SnappedPoint b, SnappedPoint p) {
  return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

// The fill rule by edge functions: inside, or on an edge that is left, or top and level.
bool covers(SnappedTriangle t, SnappedPoint p) {
  if (side(t[0], t[1], t[2]) < 0) std::swap(t[1], t[2]);
  if (side(t[0], t[1], t[2]) == 0) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    const SnappedPoint a = t[i], b = t[(i + 1) % 3];
    const std::int64_t s = side(a, b, p);
    // Positive area with y down: going round clockwise on the screen; top edges run right, left edges up.
    const bool owns = (a.y == b.y && b.x > a.x) || b.y < a.y;
    if (s < 0 || (s == 0 && !owns)) return false;
  }
  return true;
}

} // namespace

TEST_CASE("coverage is that of the top-left rule by edge functions") {
  const Size size{24, 20};
  for (std::uint64_t i = 0; i < 1500; ++i) {
    SnappedTriangle t{random_point(3 * i, -1000, 7000), random_point(3 * i + 1, -1000, 7000),
                      random_point(3 * i + 2, -1000, 7000)};
    // Corners on pixel centres and level edges in a part of them.
    if (i % 3 == 0)
      for (auto& p : t) p = {p.x / 256 * 256 + 128, p.y / 256 * 256 + 128};
    if (i % 5 == 0) t[1].y = t[0].y;
    const auto hits = counts({t}, size);
    bool same = true;
    for (int y = 0; y < size.height; ++y)
      for (int x = 0; x < size.width; ++x)
        same &= (hits[static_cast<std::size_t>(y * size.width + x)] == 1) ==
                covers(t, {x * 256 + 128, y * 256 + 128});
    CAPTURE(i);
    REQUIRE(same);
  }
}

TEST_CASE("triangles round a point cover each pixel once") {
  const Size size{32, 32};
  for (std::uint64_t i = 0; i < 200; ++i) {
    const SnappedPoint hub =
        i % 2 ? SnappedPoint{16 * 256 + 128, 16 * 256 + 128} : random_point(i, 1000, 7000);
    const SnappedPoint a{-100, -100}, b{9000, -50}, c{9100, 9000}, d{-60, 8500};
    const auto hits = counts({{a, b, hub}, {b, c, hub}, {c, d, hub}, {d, a, hub}}, size);
    REQUIRE(std::all_of(hits.begin(), hits.end(), [](int n) { return n == 1; }));
  }
}

TEST_CASE("cut triangles that share an edge still meet without gap or overlap") {
  const Size size{40, 30};
  const double near = 0.1;
  // A floor that reaches behind the eye and far aside.
  const Projection eye({{0, 1, 0}, {0.3, 0, -5}, {0.2, 1, 0}, 60}, size);
  const ScreenPoint a = eye.at({-30, 0, 30}), b = eye.at({30, 0, 30}), c = eye.at({30, 0, -30}),
                    d = eye.at({-30, 0, -30});
  std::vector<SnappedTriangle> pieces = clipped({a, b, c}, size, near);
  const auto more = clipped({a, c, d}, size, near);
  CHECK(pieces.size() > 1);
  pieces.insert(pieces.end(), more.begin(), more.end());
  const auto hits = counts(pieces, size);
  int covered = 0;
  for (int n : hits) {
    REQUIRE(n <= 1);
    covered += n;
  }
  CHECK(covered > 100);
}

TEST_CASE("nothing comes of triangles behind the near plane, outside, flat or not finite") {
  const Size size{16, 16};
  CHECK(clipped({{{1, 1, -1}, {5, 2, -2}, {3, 9, -1}}}, size, 0.1).empty());
  CHECK(clipped({{{1, 1, 0}, {5, 2, 0}, {3, 9, 0}}}, size, 0.1).empty());
  CHECK(clipped({{{-100, 1, 1}, {-90, 2, 1}, {-95, 9, 1}}}, size, 0.1).empty());
  constexpr double inf = std::numeric_limits<double>::infinity();
  CHECK(clipped({{{1, 1, 1}, {inf, 2, 1}, {3, 9, 1}}}, size, 0.1).empty());
  CHECK(
      clipped({{{1, 1, 1}, {4, std::numeric_limits<double>::quiet_NaN(), 1}, {3, 9, 1}}}, size, 0.1).empty());
  const auto flat = clipped({{{1, 1, 1}, {5, 5, 1}, {9, 9, 1}}}, size, 0.1);
  const auto hits = counts(flat, size);
  CHECK(std::count(hits.begin(), hits.end(), 0) == 256);
  // Huge, all over the picture.
  const auto huge = clipped({{{-1e300, -1e300, 1}, {1e300, -1e300, 1}, {0, 1e300, 1}}}, size, 0.1);
  const auto all = counts(huge, size);
  CHECK(std::count(all.begin(), all.end(), 1) == 256);
}
