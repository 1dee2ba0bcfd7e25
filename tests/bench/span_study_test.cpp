#include "tilepack/bench/span_study.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

using namespace tilepack;

namespace {

HardCase hard(const std::string& start) {
  for (const HardCase& c : hard_cases())
    if (c.name.rfind(start, 0) == 0) return c;
  FAIL("no case " << start);
  return {};
}

double pixels(StepMethod contestant, const std::string& start, SpanPrecision precision = SpanPrecision::f32) {
  const HardResult result = run_contestant(contestant, hard(start), precision);
  return std::isfinite(result.relative) ? result.pixels : INFINITY;
}

} // namespace

TEST_CASE("in double precision all methods keep their bounds on all cases") {
  for (const SpanCase& c : span_cases())
    for (SpanMethod method :
         {SpanMethod::exact, SpanMethod::estimate, SpanMethod::euler1, SpanMethod::euler2, SpanMethod::newton,
          SpanMethod::newton_direct, SpanMethod::newton_general, SpanMethod::affine})
      for (int reseed : {0, 8, 32}) {
        const SpanError error = span_error(c.span, {method, reseed}, SpanPrecision::f64);
        CAPTURE(c.name, name_of(method), reseed);
        CHECK(error.beyond < 1e-9);
        CHECK(error.pixels <= error.bound + 1e-9);
      }
}

TEST_CASE("the methods never break where the printed listings do") {
  for (const HardCase& c : hard_cases())
    for (StepMethod contestant :
         {StepMethod::euler2, StepMethod::newton, StepMethod::newton_direct, StepMethod::newton_general})
      for (SpanPrecision precision : {SpanPrecision::f32, SpanPrecision::f64}) {
        CAPTURE(c.name, name_of(contestant));
        CHECK(std::isfinite(run_contestant(contestant, c, precision).relative));
      }
  CHECK(std::isinf(pixels(StepMethod::listing2, "D = 0", SpanPrecision::f64)));
  CHECK(pixels(StepMethod::newton_general, "D = 0") == 0);
  CHECK(std::isinf(pixels(StepMethod::listing2, "D near 0")));
  CHECK(pixels(StepMethod::listing1, "D near 0") > 100);
  CHECK(pixels(StepMethod::newton_direct, "D near 0") < 0.01);
  CHECK(std::isinf(pixels(StepMethod::listing1, "denormal")));
  CHECK(pixels(StepMethod::newton_direct, "denormal") < 0.01);
  CHECK(std::isinf(pixels(StepMethod::division, "all near overflow")));
  CHECK(pixels(StepMethod::newton_direct, "all near overflow") < 0.01);
  CHECK(pixels(StepMethod::listing2, "16384") > 1);
  CHECK(pixels(StepMethod::newton_direct, "16384") < 0.01);
  // In double, on an ordinary span, the listings are as good as they should be.
  CHECK(pixels(StepMethod::listing1, "ordinary", SpanPrecision::f64) < 1.0 / 200);
  CHECK(pixels(StepMethod::listing2, "ordinary", SpanPrecision::f64) <= 1.0 / 200 + 1e-6);
  CHECK(pixels(StepMethod::listing1, "from the far end", SpanPrecision::f64) < 1.0 / 200);
}

TEST_CASE("in float Newton corrects itself, Euler and summed coefficients drift, re-seeding cures both") {
  const auto curves = error_curves(16384, 2000, 64);
  const auto worst = [&](const std::string& name) {
    for (const ErrorCurve& c : curves)
      if (c.name == name) return *std::max_element(c.rounding.begin(), c.rounding.end());
    FAIL("no curve " << name);
    return 0.0;
  };
  CHECK(worst("division") < 0.002);
  CHECK(worst("Newton") < 0.005);
  CHECK(worst("Euler 2") > 0.5);
  CHECK(worst("Newton, coefficient added up") > 1);
  CHECK(worst("Euler 2, exact every 64") < 0.03);
  CHECK(worst("Newton, added up, exact every 64") < 0.05);
  for (const ErrorCurve& c : curves) {
    CHECK(c.n.size() == c.total.size());
    CHECK(c.n.back() == 16383);
    CHECK(std::all_of(c.total.begin(), c.total.end(), [](double e) { return std::isfinite(e); }));
  }
}
