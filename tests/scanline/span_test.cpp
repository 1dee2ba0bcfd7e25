#include "tilepack/numeric/random.h"
#include "tilepack/scanline/span.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

using namespace tilepack;

namespace {

double in_tiles(TileCoordinate c) {
  return static_cast<double>(c.tile) + c.fraction;
}

// u at pixel i of the run, from the span.
double u_at_pixel(const Span& span, int i) {
  const int n = (i - span.first) * span.direction;
  return in_tiles(span.u) + span.du * n / denominator(span, n);
}

SpanCoefficients run(double a, double b, double c, double d, int count) {
  SpanCoefficients r;
  r.a1 = a;
  r.b1 = b;
  r.a2 = 2 * a;
  r.b2 = b - 1;
  r.c = c;
  r.d = d;
  r.count = count;
  return r;
}

} // namespace

TEST_CASE("a span is the same function as the run it is made from") {
  const auto number = [](const char* what, std::uint64_t i) {
    return static_cast<double>(random_bits(3, what, i) >> 11) * 0x1p-53;
  };
  for (std::uint64_t k = 0; k < 2000; ++k) {
    const int count = 2 + static_cast<int>(500 * number("count", k));
    // Depths at both ends, so any sign of c.
    const double near = 0.01 + number("near", k), far = 0.01 + number("far", k);
    const double d = near, c = (far - near) / (count - 1);
    const SpanCoefficients r = run(number("a", k) - 0.5, 4 * number("b", k), c, d, count);
    const Span span = make_span(r);
    CAPTURE(k, count, c, d);
    REQUIRE(span.count == count);
    REQUIRE(span.direction == (c > 0 ? -1 : 1));
    for (int i = 0; i < count; i += 7) {
      const double exact = (r.a1 * i + r.b1) / (c * i + d);
      REQUIRE(u_at_pixel(span, i) == Approx(exact).epsilon(1e-11).margin(1e-11));
    }
  }
}

TEST_CASE("spans begin at their near end and leave out what lies behind the horizon") {
  SECTION("depth shrinks to the right: horizon after pixel 9.5") {
    const Span span = make_span(run(1, 0, -2, 19, 100));
    CHECK(span.first == 0);
    CHECK(span.direction == 1);
    CHECK(span.count == 10);
  }
  SECTION("depth grows to the right: pixels 0..10 are behind") {
    const Span span = make_span(run(1, 0, 2, -21, 100));
    CHECK(span.first == 99);
    CHECK(span.direction == -1);
    CHECK(span.count == 89);
  }
  SECTION("a pixel on the horizon is not in front of it") {
    CHECK(make_span(run(1, 0, -1, 10, 100)).count == 10);
    CHECK(make_span(run(1, 0, 1, -10, 100)).count == 89);
  }
  SECTION("the horizon just inside and just outside of a pixel") {
    CHECK(make_span(run(1, 0, -0.1, std::nextafter(1.0, 0.0), 11)).count == 10);
    CHECK(make_span(run(1, 0, -0.125, std::nextafter(1.0, 2.0), 11)).count == 9);
  }
  SECTION("all of it is behind") {
    CHECK(make_span(run(1, 0, 0, -1, 10)).count == 0);
    CHECK(make_span(run(1, 0, 0, 0, 10)).count == 0);
    CHECK(make_span(run(1, 0, -1, -1, 10)).count == 0);
    CHECK(make_span(run(1, 0, 1, 0, 1)).count == 0);
  }
  CHECK(make_span(run(1, 0, -1, 10, 0)).count == 0);
  CHECK(make_span(run(1, 0, -1, 10, 1)).count == 1);
}

TEST_CASE("the size of the coefficients does not matter") {
  const Span plain = make_span(run(3, 5, -1, 1000, 900));
  for (double factor : {0x1p-900, 0x1p-300, 0x1p300, 0x1p900}) {
    CAPTURE(factor);
    const Span scaled = make_span(run(3 * factor, 5 * factor, -factor, 1000 * factor, 900));
    CHECK(scaled.count == plain.count);
    CHECK(scaled.du == plain.du);
    CHECK(scaled.bend == plain.bend);
    CHECK(scaled.u == plain.u);
  }
}

TEST_CASE("D = 0 is a constant, c = 0 is straight") {
  const Span constant = make_span(run(-2, 40, -1, 20, 15)); // u = 2(20-n)/(20-n)
  CHECK(constant.du == 0);
  CHECK(constant.u == TileCoordinate{2, 0.0});
  const Span straight = make_span(run(0.5, 1, 0, 2, 15));
  CHECK(straight.bend == 0);
  CHECK(straight.du == 0.25);
  CHECK(std::isinf(horizon_distance(straight, 3)));
}

TEST_CASE("hostile coefficients give defined spans") {
  constexpr double inf = std::numeric_limits<double>::infinity(),
                   nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double huge = std::numeric_limits<double>::max(),
                   tiny = std::numeric_limits<double>::denorm_min();
  for (double bad : {inf, -inf, nan}) {
    CHECK(make_span(run(bad, 0, -1, 10, 5)).count == 0);
    CHECK(make_span(run(1, bad, -1, 10, 5)).count == 0);
    CHECK(make_span(run(1, 0, bad, 10, 5)).count == 0);
    CHECK(make_span(run(1, 0, -1, bad, 5)).count == 0);
  }
  for (double a : {0.0, 1.0, huge / 4, tiny})
    for (double b : {0.0, -1.0, huge / 4, -tiny})
      for (double c : {0.0, -1.0, 1.0, huge, -huge, tiny, -tiny})
        for (double d : {1.0, huge, tiny, -tiny})
          for (int count : {1, 2, 16384}) {
            const Span span = make_span(run(a, b, c, d, count));
            CAPTURE(a, b, c, d, count);
            REQUIRE(span.count >= 0);
            REQUIRE(span.count <= count);
            REQUIRE(std::abs(span.du) <= 0x1p40);
            REQUIRE(std::abs(span.dv) <= 0x1p40);
            REQUIRE(span.bend >= 0);
            REQUIRE(std::isfinite(span.bend));
            REQUIRE(span.u.fraction >= 0);
            REQUIRE(span.u.fraction < 1);
            if (span.count > 0) {
              REQUIRE(denominator(span, 0) == 1);
              REQUIRE(std::isfinite(span.du * (span.count - 1) / denominator(span, span.count - 1)));
            }
          }
  CHECK_THROWS_AS(make_span(run(1, 0, -1, 10, -1)), std::invalid_argument);
  CHECK_THROWS_AS(make_span(run(1, 0, -1, 10, max_span_pixels + 1)), std::invalid_argument);
}

TEST_CASE("places far out keep their fraction") {
  SpanCoefficients r = run(0.001, 0.25, 0, 1, 100);
  r.u_origin = {std::int64_t{1} << 40, 0.5};
  const Span span = make_span(r);
  CHECK(span.u == TileCoordinate{std::int64_t{1} << 40, 0.75});
}
