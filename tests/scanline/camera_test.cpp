#include "tilepack/error/error.h"
#include "tilepack/scanline/camera.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

using namespace tilepack;

TEST_CASE("a place on a pixel's view ray lands on that pixel") {
  const Projection p({{1, 2, 3}, {4, -1, -5}, {0.3, 1, 0}, 47}, {640, 360});
  for (double x : {0.5, 100.0, 320.0, 639.5})
    for (double y : {0.5, 180.0, 359.0})
      for (double t : {0.01, 1.0, 1000.0}) {
        const ScreenPoint s = p.at(p.eye + t * (p.corner + x * p.across + y * p.down));
        CHECK(s.w == Approx(t));
        CHECK(s.x / s.w == Approx(x).margin(1e-9));
        CHECK(s.y / s.w == Approx(y).margin(1e-9));
      }
  const ScreenPoint middle = p.at({4, -1, -5});
  CHECK(middle.x / middle.w == Approx(320));
  CHECK(middle.y / middle.w == Approx(180));
  CHECK(p.at({-2, 5, 11}).w < 0);
}

TEST_CASE("the field of view is vertical, up is up, right is right") {
  for (double fov : {0.001, 1.0, 45.0, 90.0, 91.0, 120.0, 179.0, 179.999}) {
    const Projection p({{0, 0, 0}, {0, 0, -1}, {0, 1, 0}, fov}, {100, 50});
    const double edge = std::tan(fov / 2 / 180 * 3.14159265358979323846);
    const ScreenPoint top = p.at({0, edge, -1});
    CAPTURE(fov);
    CHECK(top.y / top.w == Approx(0).margin(1e-8));
    const ScreenPoint right = p.at({edge, 0, -1});
    CHECK(right.x / right.w == Approx(50 + 25)); // square pixels
  }
}

TEST_CASE("cameras that see nothing sensible are refused with the way out") {
  constexpr double inf = std::numeric_limits<double>::infinity(),
                   nan = std::numeric_limits<double>::quiet_NaN();
  const Camera good{{0, 1, 0}, {0, 0, -5}};
  const Size size{16, 16};
  CHECK_NOTHROW(Projection(good, size));
  const auto with = [&](auto change) {
    Camera camera = good;
    change(camera);
    return camera;
  };
  for (double bad : {inf, -inf, nan, 1e10}) {
    CHECK_THROWS_WITH(Projection(with([&](Camera& c) { c.eye.x = bad; }), size), Catch::Contains("the eye"));
    CHECK_THROWS_WITH(Projection(with([&](Camera& c) { c.target.z = bad; }), size),
                      Catch::Contains("the target"));
    CHECK_THROWS_WITH(Projection(with([&](Camera& c) { c.up.y = bad; }), size), Catch::Contains("1e9"));
    CHECK_THROWS_AS(Projection(with([&](Camera& c) { c.near = bad; }), size), Error);
  }
  for (double bad : {0.0, 180.0, -10.0, 1e-4, nan, inf})
    CHECK_THROWS_WITH(Projection(with([&](Camera& c) { c.fov = bad; }), size), Catch::Contains("179.999"));
  CHECK_THROWS_WITH(Projection(with([](Camera& c) { c.target = c.eye; }), size),
                    Catch::Contains("same place"));
  CHECK_THROWS_WITH(Projection(with([](Camera& c) { c.up = {0, -1, -5}; }), size), Catch::Contains("along"));
  CHECK_THROWS_WITH(Projection(with([](Camera& c) { c.up = {0, 0, 0}; }), size), Catch::Contains("zero"));
  CHECK_THROWS_AS(Projection(with([](Camera& c) { c.near = 0; }), size), Error);
  for (Size bad : {Size{0, 16}, Size{16, 0}, Size{-3, 5}, Size{65537, 1}})
    CHECK_THROWS_WITH(Projection(good, bad), Catch::Contains("1..65536"));
  // Tiny and huge but legal.
  CHECK_NOTHROW(Projection(with([](Camera& c) { c.up = {0, 1e-300, 0}; }), size));
  CHECK_NOTHROW(Projection(with([](Camera& c) { c.eye = {1e9, 1e9, -1e9}; }), size));
}

TEST_CASE("a camera is read from ten numbers") {
  const Camera c = camera_of("0,2,0.5,1e1,-1,-10,0,1,0,60");
  CHECK(c.eye == Vec3{0, 2, 0.5});
  CHECK(c.target == Vec3{10, -1, -10});
  CHECK(c.up == Vec3{0, 1, 0});
  CHECK(c.fov == 60);
  for (const char* bad : {"", "1", "0,2,0,0,1,-10,0,1,0", "0,2,0,0,1,-10,0,1,0,60,1",
                          "0,2,0,0,1,-10,0,1,0,6x", "0,2,0,0,1,,0,1,0,60", "0;2;0;0;1;-10;0;1;0;60"})
    CHECK_THROWS_WITH(camera_of(bad), Catch::Contains("ten numbers"));
}
