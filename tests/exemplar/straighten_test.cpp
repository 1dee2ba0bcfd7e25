#include "tilepack/exemplar/courses.h"
#include "tilepack/exemplar/straighten.h"
#include "tilepack/image/encoding.h"
#include "tilepack/numeric/random.h"
#include "tilepack/tileset/value_space.h"

#include <tbb/global_control.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <utility>
#include <vector>

using namespace tilepack;

namespace {

constexpr int width = 256;
constexpr int height = 300;
constexpr double pitch = 48;

double noise(int x, int y) {
  return random_below(1, "planks", static_cast<std::uint64_t>(y) * 4096 + static_cast<std::uint64_t>(x),
                      1000) /
         1000.0;
}

// Where groove k lies in column x: planks of uneven width, which slope a little.
double groove(int k, int x) {
  const double uneven[] = {1.2, -0.5, -2, -0.4, 1.3, 2.4, 0.8};
  return 20 + k * pitch + uneven[k] + 1.5 * x / width;
}

// Planks between dark grooves of 4 texels, each of its own grey, along y or along x.
SampleMap planks(CourseAxis axis = CourseAxis::y, bool even = false) {
  SampleMap map;
  map.depth = Depth::u16;
  map.image = Image(axis == CourseAxis::y ? width : height, axis == CourseAxis::y ? height : width, 3);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      int plank = 0;
      double nearest = 1e9;
      for (int k = 0; k < 7; ++k) {
        const double at = even ? 20 + k * pitch : groove(k, x);
        if (y > at) plank = k + 1;
        nearest = std::min(nearest, std::abs(y + 0.5 - at));
      }
      const double shade = 0.45 + 0.1 * noise(plank, 3) + 0.05 * noise(x, y);
      const double dark = std::min(1.0, nearest / 2.5);
      const auto texel = axis == CourseAxis::y ? map.image.texel(x, y) : map.image.texel(y, x);
      for (float& v : texel) v = quantised(static_cast<float>(shade * (0.2 + 0.8 * dark)), Depth::u16);
    }
  return map;
}

// The darkest row near each place where a groove should be, in the mean of a few columns.
std::vector<int> grooves_of(const Image& image, int x) {
  const auto darkness = [&](int y) {
    float sum = 0;
    for (int i = 0; i < 5; ++i) sum -= image.texel(x + i, y)[0];
    return sum;
  };
  const auto darkest = [&](int from, int to) {
    int best = from;
    for (int y = from; y < to; ++y)
      if (darkness(y) > darkness(best)) best = y;
    return best;
  };
  std::vector<int> rows{darkest(0, 48)};
  for (int at = rows[0] + 48; at + 8 < image.height(); at += 48) rows.push_back(darkest(at - 8, at + 8));
  return rows;
}

const TileSides around_48{{40, 40}, {48, 48}, {60, 60}};

} // namespace

TEST_CASE("courses are followed to where they lie, and their mean distance is found") {
  const Courses found = followed_courses(planks().image, CourseAxis::y, 47.3);
  CHECK(found.period == Approx(pitch + 0.28).margin(0.15)); // the unevenness has a trend
  CHECK(found.waver() > 0.9);
  CHECK(found.waver() < 2.5);
  double least = 1e9, most = -1e9; // from a course's middle, wherever in it that is, to its groove
  for (int k = 0; k < 6; ++k)
    for (const int x : {20, 128, 230}) {
      const double even =
          found.first + std::round((groove(k, x) - found.first) / found.period) * found.period;
      const double off = groove(k, x) - even - found.at(even, x);
      least = std::min(least, off);
      most = std::max(most, off);
    }
  CHECK(most - least < 1.0);
  CHECK(followed_courses(planks(CourseAxis::y, true).image, CourseAxis::y, pitch).waver() < 0.3);
  CHECK(followed_courses(planks().image, CourseAxis::y, 150).period == 0); // too few
}

TEST_CASE("uneven planks are found, and are even after straightening, along either axis") {
  for (const CourseAxis axis : {CourseAxis::y, CourseAxis::x}) {
    const SampleMap sample = planks(axis);
    const Periodicity periods = detect_periods({&sample, 1});
    const Period& found = axis == CourseAxis::y ? periods.y : periods.x;
    CHECK(found.length == Approx(pitch).margin(0.5));
    CHECK(found.waver > 0.75);
    const Straightened straight = straightened({&sample, 1}, periods, around_48);
    REQUIRE(straight.done());
    CHECK(straight.moved > 1.5);
    CHECK(straight.moved < 5);
    const Period& exact = axis == CourseAxis::y ? straight.periods.y : straight.periods.x;
    CHECK(exact.length == 48);
    CHECK(exact.waver == 0);
    Image image = straight.maps[0].image;
    if (axis == CourseAxis::x) {
      Image turned(image.height(), image.width(), 3);
      for (int y = 0; y < turned.height(); ++y)
        for (int x = 0; x < turned.width(); ++x)
          for (std::size_t c = 0; c < 3; ++c) turned.texel(x, y)[c] = image.texel(y, x)[c];
      image = turned;
    }
    const std::vector<int> first = grooves_of(image, 10);
    REQUIRE(first.size() >= 5);
    for (const int x : {10, 120, 230}) {
      const std::vector<int> rows = grooves_of(image, x);
      CAPTURE(first, rows);
      REQUIRE(rows.size() == first.size());
      for (std::size_t k = 0; k < rows.size(); ++k)
        CHECK(std::abs(rows[k] - (first[0] + 48 * static_cast<int>(k))) <= 1);
    }
  }
}

TEST_CASE("what is even or does not repeat is left as it is") {
  const SampleMap even = planks(CourseAxis::y, true);
  CHECK_FALSE(straightened({&even, 1}, detect_periods({&even, 1}), around_48).done());
  SampleMap other = even;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (float& v : other.image.texel(x, y)) v = static_cast<float>(noise(x, y));
  CHECK_FALSE(straightened({&other, 1}, detect_periods({&other, 1}), around_48).done());
  CHECK_FALSE(straightened({&other, 1}, {{}, {48, 0.3}}, around_48).done()); // not even where it is claimed
}

TEST_CASE("maps are warped alike, and normals are turned with the surface") {
  // A height field that is a plane in the sample is one with other slopes where the warp stretches it; its
  // normals must be those of the warped heights.
  std::vector<SampleMap> maps{planks(), planks(), planks()};
  maps[1].name = "height";
  maps[1].role = Role::height;
  maps[2].name = "normal";
  maps[2].role = Role::normal;
  for (SampleMap& map : maps) map.depth = Depth::f32;
  constexpr double east = 0.02, south = 0.5;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      for (float& v : maps[1].image.texel(x, y)) v = static_cast<float>(east * x + south * y);
      const double length = std::sqrt(1 + east * east + south * south);
      const auto n = maps[2].image.texel(x, y);
      n[0] = static_cast<float>(0.5 - 0.5 * east / length);
      n[1] = static_cast<float>(0.5 + 0.5 * south / length); // green north
      n[2] = static_cast<float>(0.5 + 0.5 / length);
    }
  const Straightened straight = straightened(maps, detect_periods(maps), around_48);
  REQUIRE(straight.maps.size() == 3);
  const Image& heights = straight.maps[1].image;
  const Image& normals = straight.maps[2].image;
  CHECK(heights.size() == straight.maps[0].image.size());
  double worst = 0, steepest = 0;
  for (int y = 4; y + 4 < heights.height(); ++y) // filters reach beyond the borders
    for (int x = 4; x + 4 < heights.width(); ++x) {
      const auto h = [&](int i, int j) { return static_cast<double>(heights.texel(x + i, y + j)[0]); };
      const auto n = normals.texel(x, y);
      const double nx = 2.0 * n[0] - 1, ny = 2.0 * n[1] - 1, nz = 2.0 * n[2] - 1;
      const double slope_x = (h(1, 0) - h(-1, 0)) / 2, slope_y = (h(0, 1) - h(0, -1)) / 2;
      worst = std::max({worst, std::abs(-nx / nz - slope_x), std::abs(ny / nz - slope_y)});
      steepest = std::max(steepest, std::abs(slope_y - south));
    }
  CHECK(steepest > 0.01); // the warp did change slopes
  CHECK(worst < 0.003);
}

TEST_CASE("straightening is the same for any number of threads") {
  const SampleMap sample = planks();
  const Periodicity periods = detect_periods({&sample, 1});
  const Straightened many = straightened({&sample, 1}, periods, around_48);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  CHECK(straightened({&sample, 1}, periods, around_48).maps[0].image == many.maps[0].image);
}
