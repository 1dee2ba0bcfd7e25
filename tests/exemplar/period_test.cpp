#include "tilepack/exemplar/period.h"
#include "tilepack/numeric/random.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace tilepack;

namespace {

SampleMap grey(int width, int height, auto value_at) {
  SampleMap map;
  map.image = Image(width, height, 1);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) map.image.texel(x, y)[0] = static_cast<float>(value_at(x, y));
  return map;
}

double noise(int x, int y) {
  return random_below(1, "period test", static_cast<std::uint64_t>(y) * 4096 + static_cast<std::uint64_t>(x),
                      1000) /
         1000.0;
}

// Bricks in running bond: courses of 21.5 texels, joints of 3; each brick of its own grey.
double wall(int x, int y) {
  const int course = static_cast<int>(y / 21.5);
  const double v = y - course * 21.5;
  const int shifted = x + (course % 2) * 24;
  if (v < 3 || shifted % 48 < 3) return 0.6;
  return 0.2 + 0.3 * noise(shifted / 48, course) + 0.1 * noise(x, y);
}

Periodicity periods_of(const SampleMap& map) {
  return detect_periods({&map, 1});
}

} // namespace

TEST_CASE("a wall's courses are found to a quarter of a texel, not their double or half") {
  const Periodicity found = periods_of(grey(256, 256, wall));
  CHECK(found.y.length == Approx(21.5).margin(0.25));
}

TEST_CASE("courses without order along them are found one by one") {
  const Periodicity found = periods_of(grey(256, 256, [](int x, int y) {
    const int course = static_cast<int>(y / 21.5);
    return wall(x + static_cast<int>(48 * noise(course, 7)), y);
  }));
  CHECK(found.y.length == Approx(21.5).margin(0.25));
}

TEST_CASE("bricks laid by half repeat after a brick and two courses, squares after one") {
  const auto laid = [](int offset) {
    return grey(256, 256, [=](int x, int y) {
      const int course = y / 16;
      const int shifted = x + course % 2 * offset;
      return (y % 16 < 2 || shifted % 48 < 3 ? 0.7 : 0.3) + 0.1 * noise(x, y);
    });
  };
  const Periodicity bond = periods_of(laid(24));
  CHECK(bond.x.length == Approx(48).margin(0.5));
  CHECK(bond.y.length == Approx(32).margin(0.5));
  const Periodicity stacked = periods_of(laid(0));
  CHECK(stacked.x.length == Approx(48).margin(0.5));
  CHECK(stacked.y.length == Approx(16).margin(0.5));
}

TEST_CASE("turning the sample by 90 degrees swaps the axes") {
  const Periodicity found = periods_of(grey(256, 256, [](int x, int y) { return wall(y, x); }));
  CHECK(found.x.length == Approx(21.5).margin(0.25));
}

TEST_CASE("large samples are looked at in small, with their own periods") {
  const Periodicity found = periods_of(grey(1024, 512, [](int x, int) { return x % 60 < 20 ? 1.0 : 0.0; }));
  CHECK(found.x.length == Approx(60).margin(0.5));
  CHECK(found.y.length == 0);
}

TEST_CASE("noise, constants, shading and tiny samples have no period") {
  for (const auto& map : {grey(256, 256, [](int x, int y) { return noise(x, y); }),
                          grey(200, 100, [](int, int) { return 0.5; }),
                          grey(256, 256, [](int x, int y) { return (x + 2 * y) / 768.0; }),
                          grey(31, 256, wall), grey(1, 1, noise)}) {
    const Periodicity found = periods_of(map);
    CHECK(found.x.length == 0);
    CHECK(found.y.length == 0);
  }
  CHECK(detect_periods({}).x.length == 0);
}

TEST_CASE("the fitting tile holds whole periods near the wanted size") {
  const TileSizeAdvice advice = fitting_tile_size({{}, {42.67, 0.3}}, {128, 128}, {512, 512});
  CHECK(advice.size == Size{128, 128});
  CHECK(advice.periods == Size{0, 3});
  const TileSizeAdvice lines = fitting_tile_size({{}, {20.0, 0.9}}, {128, 128}, {400, 500});
  CHECK(lines.size.height % 20 == 0);
  CHECK(lines.periods.height * 20 == lines.size.height);
}

TEST_CASE("a fitting tile never outgrows half the sample, and says when no period fits") {
  const TileSizeAdvice advice = fitting_tile_size({{90, 0.5}, {}}, {128, 128}, {160, 100});
  CHECK(advice.size == Size{80, 50});
  CHECK(advice.periods == Size{0, 0});
  CHECK(advice.reason.find("no allowed side") != std::string::npos);
}

TEST_CASE("a side holds whole periods to within a few hundredths or less than a texel") {
  const auto count = [](double period, int side) { return whole_periods({period, 1.0}, side); };
  CHECK(count(32.0, 128) == 4);
  CHECK(count(42.69, 128) == 3);
  CHECK(count(85.34, 86) == 1);
  CHECK(count(85.34, 84) == 1);
  CHECK(count(85.34, 88) == 0);
  CHECK(count(18.84, 132) == 7);
  CHECK(count(18.84, 131) == 0);
  CHECK(count(20.0, 128) == 0);
  CHECK(count(200.0, 128) == 0);
  CHECK(count(0.0, 128) == 0);
}

TEST_CASE("a checkerboard repeats after two texels, and exactly") {
  const Periodicity found = periods_of(grey(128, 128, [](int x, int y) { return (x + y) % 2; }));
  CHECK(found.x.length == Approx(2).margin(0.01));
  CHECK(found.y.length == Approx(2).margin(0.01));
  CHECK(found.x.waver == 0);
}

TEST_CASE("courses that lie even to the texel are told from those that waver") {
  const auto stripes = [](int waver) {
    return periods_of(grey(256, 256, [=](int x, int y) {
      const int steps[] = {0, 1, 2, 1, 0, -1, -2, -1};
      const int moved = y - waver * steps[(y + 16) / 32 % 8];
      return (moved % 32 < 6 ? 0.8 : 0.2) + 0.1 * noise(x, y);
    }));
  };
  CHECK(stripes(0).y.waver < 0.3);
  CHECK(stripes(1).y.waver > 0.4);
}

TEST_CASE("a sample that is nothing but lines is told from one that repeats, or has more to show") {
  const auto tone = [](int y) { return noise(y, 99); };
  const Periodicity brushed =
      periods_of(grey(200, 300, [&](int x, int y) { return tone(y) + 0.1 * noise(x, y); }));
  CHECK(brushed.y.length == 0);
  CHECK(brushed.y.lines == 300);
  CHECK(brushed.x.lines == 0);
  CHECK(periods_of(grey(200, 300, [&](int x, int y) { return tone(y) + noise(x, y); })).y.lines == 0);
  CHECK(periods_of(grey(256, 256, [](int, int y) { return y % 32 < 16 ? 0.2 : 0.8; })).y.lines == 0);
}
