#include "tilepack/error/error.h"
#include "tilepack/numeric/random.h"
#include "tilepack/scanline/span_batch.h"
#include "tilepack/scanline/span_constants.h"
#include "tilepack/scanline/span_method.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

using namespace tilepack;

namespace {

constexpr SpanMethod all_methods[] = {
    SpanMethod::exact,         SpanMethod::euler1,         SpanMethod::euler2, SpanMethod::newton,
    SpanMethod::newton_direct, SpanMethod::newton_general, SpanMethod::affine, SpanMethod::estimate};

// A span of `count` pixels whose horizon lies `behind` pixels after its last one.
Span span_before_horizon(int count, double behind, double du = 0.01, double dv = -0.003) {
  Span span;
  span.count = count;
  span.du = du;
  span.dv = dv;
  span.bend = std::min(1 / (count - 1 + behind), 1.0);
  return span;
}

// The signed error in pixels of an offset w at pixel n: how far back the place lies where w is right.
double pixels_behind(const Span& span, int n, double w) {
  const double g = w / span.du; // n/(1 - bend n), inverted
  return n - g / (1 + span.bend * g);
}

template <class Real>
struct Filled {
  std::vector<Real> u, v;
};

template <class Real>
Filled<Real> filled(const Span& span, const SpanOptions& options) {
  const auto size = static_cast<std::size_t>(span.count);
  Filled<Real> out{std::vector<Real>(size), std::vector<Real>(size)};
  fill_span<Real>(span, options, out.u, out.v);
  return out;
}

} // namespace

TEMPLATE_TEST_CASE("each method stays within its bound", "", float, double) {
  const double unit = static_cast<double>(rounding_unit<TestType>);
  for (SpanMethod method : all_methods)
    for (int reseed : {0, 1, 8, 16, 32, 500})
      for (int count : {1, 2, 3, 17, 700})
        for (double behind : {1e-9, 0.25, 1.0, 3.0, 50.0, 1e4, 1e9}) {
          const Span span = span_before_horizon(count, behind);
          const auto out = filled<TestType>(span, {method, reseed});
          const int piece = reseed > 0 ? reseed : method == SpanMethod::affine ? affine_piece : count;
          double excess = -1; // pixels outside the bounds
          int where = 0;
          for (int n = 0; n < count; ++n) {
            const double w = static_cast<double>(out.u[static_cast<std::size_t>(n)]);
            const double error = pixels_behind(span, n, w);
            const int steps = method == SpanMethod::affine ? piece : n % piece;
            const double rounding = rounding_bound(method, n, steps, unit);
            // A chord's error is largest inside its piece, so it is bounded at the piece's last pixel.
            const int at = method == SpanMethod::affine ? std::min(n - n % piece + piece, count - 1) : n;
            const double bound = method_bound(method, std::max(horizon_distance(span, at), 0.0), steps);
            const double above = method == SpanMethod::affine ? 0 : bound;
            const double below = method == SpanMethod::affine ? bound : 0;
            const double outside = std::max(error - above, -error - below) - rounding;
            if (!(outside <= excess)) excess = outside, where = n;
          }
          CAPTURE(name_of(method), reseed, count, behind, where);
          REQUIRE(excess <= 0);
        }
}

TEST_CASE("the bounds in pixels from the horizon are those of the theorems") {
  const Span span = span_before_horizon(101, 20); // c = -1, d = 120
  CHECK(method_bound(SpanMethod::euler1, 20, 100) == Approx(std::log(121.0 / 21)).epsilon(1e-12));
  CHECK(method_bound(SpanMethod::euler2, 20, 100) == Approx(400.0 / (41 * 241)).epsilon(1e-12));
  CHECK(method_bound(SpanMethod::newton, 20, 100) <= 1.0 / 20);
  CHECK(method_bound(SpanMethod::newton, 1e-3, 100) <= 1);
  CHECK(method_bound(SpanMethod::affine, 20, 100) == Approx(std::pow(std::sqrt(120.0) - std::sqrt(20.0), 2)));
  for (SpanMethod method : all_methods)
    CHECK(method_bound(method, std::numeric_limits<double>::infinity(), 1000) == 0);
  // And seen: the example of [Cou].
  const auto newton = filled<double>(span, {SpanMethod::newton, 0});
  CHECK(pixels_behind(span, 100, newton.u[100]) == Approx(0.049644 * 100 / 120).margin(2e-4));
}

TEST_CASE("a chosen re-seeding interval keeps the wanted error, and the next one does not promise to") {
  for (SpanMethod method : all_methods)
    for (double behind : {0.5, 5.0, 300.0})
      for (double wanted : {0.5, 0.05, 0.005}) {
        const Span span = span_before_horizon(1920, behind);
        const int interval = reseed_interval(method, span, wanted, 0x1p-24);
        const auto out = filled<float>(span, {method, interval});
        double worst = 0;
        for (int n = 0; n < span.count; ++n) {
          const double w = static_cast<double>(out.u[static_cast<std::size_t>(n)]);
          worst = std::max(worst, std::abs(pixels_behind(span, n, w)));
        }
        CAPTURE(name_of(method), behind, wanted, interval);
        REQUIRE(interval >= 1);
        CHECK(worst <= wanted);
      }
  const Span span = span_before_horizon(1920, 300.0);
  CHECK(reseed_interval(SpanMethod::euler2, span, 0.05, 0x1p-53) > 100);
  CHECK(reseed_interval(SpanMethod::newton, span_before_horizon(1920, 5.0), 0.05, 0x1p-53) == 1);
  CHECK(reseed_interval(SpanMethod::affine, span, 0.05, 0x1p-53) <
        reseed_interval(SpanMethod::euler1, span, 0.05, 0x1p-53));
  CHECK(reseed_interval(SpanMethod::exact, span, 0.05, 0x1p-53) == max_span_pixels);
}

TEST_CASE("re-seeding cures what float accumulates over a long span") {
  // 16384 pixels, horizon one span behind the end.
  const Span span = span_before_horizon(16384, 16384);
  const auto worst = [&](SpanOptions options) {
    const auto out = filled<float>(span, options);
    double largest = 0;
    for (int n = 0; n < span.count; ++n) {
      const double w = static_cast<double>(out.u[static_cast<std::size_t>(n)]);
      largest = std::max(largest, std::abs(pixels_behind(span, n, w)));
    }
    return largest;
  };
  CHECK(worst({SpanMethod::euler2, 0}) > 3 * worst({SpanMethod::euler2, 64}));
  CHECK(worst({SpanMethod::newton, 0}) > 3 * worst({SpanMethod::newton, 64}));
  CHECK(worst({SpanMethod::euler2, 64}) < 0.02);
  CHECK(worst({SpanMethod::newton, 64}) < 0.02);
  // With its coefficient computed afresh Newton needs no cure.
  CHECK(worst({SpanMethod::newton_direct, 0}) < 0.004);
}

TEMPLATE_TEST_CASE("hard spans give finite values, and those of the exact method where nothing steps", "",
                   float, double) {
  for (SpanMethod method : all_methods)
    for (int reseed : {0, 16})
      for (int count : {1, 2, 16384})
        for (double behind : {1e-300, 0x1p-60, 1e-12, 1e-6, 0.5, 1e300})
          for (double du : {0.0, 1e-300, 0x1p-61, 0x1p-59, 1.0, 0x1p40}) {
            const Span span = span_before_horizon(count, behind, du, -du);
            CAPTURE(name_of(method), reseed, count, behind, du);
            const auto out = filled<TestType>(span, {method, reseed});
            REQUIRE(out.u[0] == 0);
            REQUIRE(std::all_of(out.u.begin(), out.u.end(), [](auto w) { return std::isfinite(w); }));
            REQUIRE(std::all_of(out.v.begin(), out.v.end(), [](auto w) { return std::isfinite(w); }));
            // Offsets grow along a span: no recurrence may blow up or turn back.
            if (method != SpanMethod::affine && method != SpanMethod::newton_general) {
              const double slack = 1e-3 * du * count;
              const auto turn = std::adjacent_find(out.u.begin(), out.u.end(), [&](auto left, auto right) {
                return static_cast<double>(right) < static_cast<double>(left) - slack;
              });
              REQUIRE(turn == out.u.end());
            }
          }
}

TEST_CASE("estimated reciprocals are reciprocals to the last few bits") {
  for (std::uint64_t i = 0; i < 20000; ++i) {
    const double mantissa = 1 + static_cast<double>(random_bits(1, "m", i) >> 12) * 0x1p-52;
    const double x = std::ldexp(mantissa, static_cast<int>(random_below(1, "e", i, 120)) - 60);
    const float f = static_cast<float>(x);
    REQUIRE(estimated_reciprocal(x) * x == Approx(1).epsilon(0).margin(4 * 0x1p-53));
    REQUIRE(static_cast<double>(estimated_reciprocal(f)) * static_cast<double>(f) ==
            Approx(1).epsilon(0).margin(4 * 0x1p-24));
  }
}

TEMPLATE_TEST_CASE("scanlines side by side are bit by bit scanlines one by one", "", float, double) {
  for (SpanMethod method : all_methods)
    for (int reseed : {0, 1, 16, 100}) {
      std::vector<Span> spans;
      for (std::uint64_t i = 0; i < 29; ++i) {
        const int count = 1 + static_cast<int>(random_below(5, "count", i, 400));
        const double behind = std::exp2(static_cast<double>(random_below(5, "behind", i, 40)) - 20);
        spans.push_back(span_before_horizon(count, behind, i % 5 == 0 ? 0 : 0.1, i % 7 == 0 ? 1e-30 : -3));
        if (i % 6 == 0) spans.back().bend = 0;
      }
      spans.push_back(Span{}); // an empty one
      SpanBatch<TestType> batch;
      fill_spans<TestType>(spans, {method, reseed}, batch);
      for (std::size_t lane = 0; lane < spans.size(); ++lane) {
        const auto out = filled<TestType>(spans[lane], {method, reseed});
        CAPTURE(name_of(method), reseed, lane, spans[lane].count);
        bool same = true;
        for (int n = 0; n < spans[lane].count; ++n) {
          const auto at = static_cast<std::size_t>(n);
          same &= out.u[at] == batch.u_at(static_cast<int>(lane), n);
          same &= out.v[at] == batch.v_at(static_cast<int>(lane), n);
        }
        REQUIRE(same);
      }
    }
  SpanBatch<TestType> batch;
  const std::vector<Span> many(33);
  CHECK_THROWS_AS(fill_spans<TestType>(many, SpanOptions{}, batch), std::invalid_argument);
  CHECK_FALSE(batch_target().empty());
}

TEST_CASE("fused arithmetic stays as close") {
  const std::vector<Span> spans(32, span_before_horizon(1000, 40));
  for (SpanMethod method : all_methods) {
    SpanBatch<float> batch;
    fill_spans<float>(spans, {method, 64}, batch, BatchArithmetic::fused);
    for (int n = 0; n < 1000; ++n) {
      const double bound = method == SpanMethod::affine ? 12 : method_bound(method, 40, 64);
      REQUIRE(std::abs(pixels_behind(spans[0], n, static_cast<double>(batch.u_at(31, n)))) <= bound + 0.01);
    }
  }
}

TEST_CASE("span methods have names") {
  for (SpanMethod method : all_methods) CHECK(span_method_of(std::string(name_of(method))) == method);
  CHECK_THROWS_WITH(span_method_of("newtn"), Catch::Contains("did you mean 'newton'"));
  CHECK_THROWS_WITH(span_method_of("newtn"), Catch::Contains("affine"));
  const Span span = span_before_horizon(4, 1);
  std::vector<float> u(4), v(4);
  for (int reseed : {-1, max_span_pixels + 1})
    CHECK_THROWS_AS(fill_span<float>(span, {SpanMethod::newton, reseed}, u, v), Error);
}
