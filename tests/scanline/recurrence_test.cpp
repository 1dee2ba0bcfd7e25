#include "tilepack/numeric/random.h"
#include "tilepack/scanline/recurrence.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <vector>

using namespace tilepack;
using Real = long double;

namespace {

// A number in [0, 1) that depends on nothing but its arguments.
double uniform(const char* purpose, std::uint64_t index) {
  return static_cast<double>(random_bits(7, purpose, index) >> 11) * 0x1p-53;
}

struct RandomSpan {
  Real c, d;
  int last; // pixel
};

// Lengths from 1 to 2048, c from 2^-20 to 2^20, and the horizon from 2^-20 pixels to 1000 spans away behind
// the last pixel: so a part of them ends with the horizon inside the last pixel.
RandomSpan random_span(std::uint64_t i) {
  const int last = static_cast<int>(std::exp2(11 * uniform("length", i)));
  const Real c = -std::exp2(static_cast<Real>(40 * uniform("c", i) - 20));
  const Real behind =
      std::exp2(static_cast<Real>(30 * uniform("horizon", i) - 20)) * (uniform("far", i) < 0.5 ? 1 : last);
  return {c, -c * (last + behind), last};
}

// What 80-bit rounding can do to an error in pixels: a relative error of r in 1/(cn+d) is (cn+d) r / -c
// pixels, and each step rounds a few times.
Real allowance(Real c, Real d, int steps) {
  return 8 * (steps + 1) * std::numeric_limits<Real>::epsilon() * d / -c;
}

} // namespace

TEST_CASE("the example of the paper comes out to all printed digits") {
  const Real c = -1, d = 120;
  const FractionalLinear<Real> f{0, 1, c, d};
  Real y1 = 1 / d, y2 = 1 / d, y3 = 1 / d;
  for (int n = 0; n < 100; ++n) {
    y1 = euler1_step(y1, c);
    y2 = euler2_step(y2, c);
    y3 = newton_step(y3, c * (n + 1) + d);
  }
  const auto printed = [](Real value) { return Approx(static_cast<double>(value)).epsilon(0); };
  CHECK(0.046099 == printed(y1).margin(0.5e-6));
  CHECK(0.049902 == printed(y2).margin(0.5e-6));
  CHECK(0.049876 == printed(y3).margin(0.5e-6));
  CHECK(1.6923 == printed(100 - f.inverse(y1)).margin(0.5e-4));
  CHECK(0.039267 == printed(100 - f.inverse(y2)).margin(0.5e-6));
  CHECK(0.049644 == printed(100 - f.inverse(y3)).margin(0.5e-6));
  // The bounds the paper reports beside them.
  CHECK(1.751 == printed(euler1_bound<Real>(c, d, 100)).margin(0.5e-3));
  CHECK(0.0405 == printed(euler2_bound<Real>(c, d, 100)).margin(0.5e-4));
  CHECK(0.05 == printed(newton_bound<Real>(c, d, 100)).margin(1e-12));
}

TEST_CASE("the general form gives the polynomials of Eq. 5.7 to 5.9") {
  const FractionalLinear<double> f{50, 0, -1, 120};
  const auto close = [](double value) { return Approx(value).epsilon(1e-14); };
  const auto p1 = euler1_polynomial(f);
  CHECK(p1[0] == close(5.0 / 12));
  CHECK(p1[1] == close(61.0 / 60));
  CHECK(p1[2] == close(1.0 / 6000));
  const auto p2 = euler2_polynomial(f);
  CHECK(p2[0] == close(121.0 / 288));
  CHECK(p2[1] == close(1627.0 / 1600));
  CHECK(p2[2] == close(41.0 / 240000));
  CHECK(p2[3] == close(1.0 / 36000000));
  for (int x : {0, 1, 50, 99}) {
    const auto p = newton_polynomial<double>(f, x);
    CHECK(p[0] == close((5.0 * x + 5) / 12));
    CHECK(p[1] == close((x + 1) / 60.0));
    CHECK(p[2] == close((x - 119) / 6000.0));
  }
}

TEST_CASE("the general form has the errors of the reciprocal form") {
  const FractionalLinear<Real> f{50, 0, -1, 120};
  Real y1 = 0, y2 = 0, y3 = 0;
  for (int n = 0; n < 100; ++n) {
    y1 = value_of(euler1_polynomial(f), y1);
    y2 = value_of(euler2_polynomial(f), y2);
    y3 = value_of(newton_polynomial<Real>(f, n), y3);
  }
  CHECK(static_cast<double>(100 - f.inverse(y1)) == Approx(1.6923).margin(0.5e-4));
  CHECK(static_cast<double>(100 - f.inverse(y2)) == Approx(0.039267).margin(0.5e-6));
  CHECK(static_cast<double>(100 - f.inverse(y3)) == Approx(0.049644).margin(0.5e-6));
}

TEST_CASE("single steps err by exactly the stated number of pixels") {
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const Real c = -1, x = static_cast<Real>(1000 * uniform("x", i));
    const Real d = x + 2 + static_cast<Real>(500 * uniform("d", i)), h = static_cast<Real>(uniform("h", i));
    const FractionalLinear<Real> f{0, 1, c, d};
    const Real y = f.value(x), lagging = f.value(x - h);
    CAPTURE(i);
    REQUIRE(std::abs(x + 1 - f.inverse(euler1_step(y, c)) - euler1_step_error(c, d, x)) < 1e-12L);
    REQUIRE(std::abs(x + 1 - f.inverse(euler2_step(y, c)) - euler2_step_error(c, d, x)) < 1e-12L);
    const Real stepped = newton_step(lagging, c * (x + 1) + d);
    REQUIRE(std::abs(x + 1 - f.inverse(stepped) - newton_step_error(c, d, x, h)) < 1e-12L);
  }
}

TEST_CASE("the printed constant of Eq. 3.13 is not the error of a second-order step") {
  const double c = -1, d = 3, x = 0, y = 1 / d;
  const double error = x + 1 - (1 / euler2_step(y, c) - d) / c;
  const double u = 2 * (c * x + d) - c;
  CHECK(error == Approx(euler2_step_error(c, d, x)).epsilon(1e-12));
  CHECK(std::abs(error - 4 * c * c / (u * u + 0.75 * c * c)) > 1e-3);
}

TEST_CASE("theorems 3.1, 3.2 and 4.1 hold for the reciprocal form", "[theorem]") {
  int near_horizon = 0;
  for (std::uint64_t i = 0; i < 100000; ++i) {
    const RandomSpan s = random_span(i);
    const FractionalLinear<Real> f{0, 1, s.c, s.d};
    const Real slack = allowance(s.c, s.d, s.last);
    near_horizon += s.c * s.last + s.d < -s.c;
    Real y1 = 1 / s.d, y2 = y1, y3 = y1;
    Real worst = 0; // violation of a bound, in pixels
    for (int n = 1; n <= s.last; ++n) {
      const Real x = n;
      y1 = euler1_step(y1, s.c);
      y2 = euler2_step(y2, s.c);
      y3 = newton_step(y3, s.c * x + s.d);
      // The bounds grow with n: it suffices to look at a few pixels and at the last ones.
      if (n % 64 != 1 && n < s.last - 2) continue;
      const Real e1 = x - f.inverse(y1), e2 = x - f.inverse(y2), e3 = x - f.inverse(y3);
      worst = std::max({worst, -e1, e1 - euler1_bound(s.c, s.d, x), -e2, e2 - euler2_bound(s.c, s.d, x),
                        e2 - 2, -e3, e3 - newton_bound(s.c, s.d, x)});
    }
    CAPTURE(i, static_cast<double>(s.c), static_cast<double>(s.d), s.last);
    REQUIRE(worst <= slack);
  }
  CHECK(near_horizon > 10000);
}

TEST_CASE("theorems 3.1, 3.2 and 4.1 hold for the general form", "[theorem]") {
  for (std::uint64_t i = 0; i < 100000; ++i) {
    RandomSpan s = random_span(i);
    // The size of c does not matter; with d near 1 the slope's size is that of a.
    s.d /= -s.c;
    s.c = -1;
    const Real b = static_cast<Real>(20 * uniform("b", i) - 10);
    const Real sign = uniform("sign", i) < 0.5 ? -1 : 1;
    const Real slope = sign * std::exp2(static_cast<Real>(8 * uniform("slope", i) - 4)); // D/d²
    const FractionalLinear<Real> f{slope * s.d + b * s.c / s.d, b, s.c, s.d};
    // y = A + B/(cn+d): rounding at the size of A is B times smaller in 1/(cn+d).
    const Real size = std::abs(f.a) + std::abs(b / s.d) + std::abs(slope) * s.d;
    const Real slack = allowance(s.c, s.d, s.last) * (2 + size / (std::abs(slope) * s.d));
    const auto p1 = euler1_polynomial(f);
    const auto p2 = euler2_polynomial(f);
    Real y1 = b / s.d, y2 = y1, y3 = y1;
    Real worst = 0;
    for (int n = 1; n <= s.last; ++n) {
      const Real x = n;
      y1 = value_of(p1, y1);
      y2 = value_of(p2, y2);
      y3 = value_of(newton_polynomial(f, x - 1), y3);
      if (n % 64 != 1 && n < s.last - 2) continue;
      const Real e1 = x - f.inverse(y1), e2 = x - f.inverse(y2), e3 = x - f.inverse(y3);
      worst = std::max({worst, -e1, e1 - euler1_bound(s.c, s.d, x), -e2, e2 - euler2_bound(s.c, s.d, x), -e3,
                        e3 - newton_bound(s.c, s.d, x)});
    }
    CAPTURE(i, static_cast<double>(slope), static_cast<double>(b), static_cast<double>(s.d), s.last);
    REQUIRE(worst <= slack);
    REQUIRE(slack < 1e-6L);
  }
}

TEST_CASE("both listings follow their polynomials") {
  const FractionalLinear<double> f1{3, 2, -0.5, 200}, f2{-1, 40, -0.5, 200};
  std::vector<double> u(300), v(300), general(300);
  reciprocal_listing<double>(f1, f2, u, v);
  general_listing<double>(f1, general);
  for (int n = 0; n < 300; ++n) {
    const auto at = static_cast<std::size_t>(n);
    CAPTURE(n);
    const double bound = newton_bound(f1.c, f1.d, static_cast<double>(n)) + 1e-9;
    CHECK(std::abs(n - f1.inverse(u[at])) <= bound);
    CHECK(std::abs(n - f2.inverse(v[at])) <= bound);
    CHECK(std::abs(n - f1.inverse(general[at])) <= bound);
  }
}
