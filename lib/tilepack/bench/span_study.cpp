#include "tilepack/bench/span_study.h"

#include "tilepack/scanline/recurrence.h"
#include "tilepack/scanline/span_constants.h"
#include "tilepack/scanline/span_method.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace tilepack {
namespace {

using Wide = long double;

constexpr int tile_side = 128;

template <class Real>
SpanError error_of(const Span& span, const SpanOptions& options) {
  const auto size = static_cast<std::size_t>(span.count);
  std::vector<Real> u(size), v(size);
  fill_span<Real>(span, options, u, v);
  const bool chord = options.method == SpanMethod::affine;
  const int piece = piece_length(options, span.count);
  SpanError error;
  for (int n = 0; n < span.count; ++n) {
    const Wide below = std::max<Wide>(1 - Wide(span.bend) * n, 0x1p-63L);
    const Wide exact = Wide(span.du) * n / below;
    const Wide got = static_cast<Wide>(u[static_cast<std::size_t>(n)]);
    const Wide g = got / Wide(span.du);
    const double behind = static_cast<double>(n - g / (1 + Wide(span.bend) * g));
    const int end = chord ? std::min(n - n % piece + piece, span.count - 1) : n;
    const double bound =
        method_bound(options.method, std::max(horizon_distance(span, end), 0.0), chord ? piece : n % piece);
    error.bound = std::max(error.bound, bound);
    error.beyond = std::max({error.beyond, behind - (chord ? 0 : bound), -behind - (chord ? bound : 0)});
    error.texels = std::max(error.texels, static_cast<double>(std::abs(got - exact)) * tile_side);
    if (std::abs(behind) > error.pixels) {
      error.pixels = std::abs(behind);
      error.worst = n;
    }
  }
  return error;
}

// The run as [Cou, section 2] wants it: from the near end.
SpanCoefficients near_end_first(SpanCoefficients run) {
  if (run.c <= 0) return run;
  const double end = run.count - 1;
  run.b1 += run.a1 * end;
  run.d += run.c * end;
  run.a1 = -run.a1;
  run.c = -run.c;
  return run;
}

template <class Real>
std::vector<Real> raw_values(StepMethod contestant, const SpanCoefficients& run) {
  const FractionalLinear<Real> f{static_cast<Real>(run.a1), static_cast<Real>(run.b1),
                                 static_cast<Real>(run.c), static_cast<Real>(run.d)};
  std::vector<Real> values(static_cast<std::size_t>(run.count)), other(values);
  if (contestant == StepMethod::listing1) {
    reciprocal_listing<Real>(f, f, values, other);
  } else if (contestant == StepMethod::listing2) {
    general_listing<Real>(f, values);
  } else {
    for (int n = 0; n < run.count; ++n) values[static_cast<std::size_t>(n)] = f.value(static_cast<Real>(n));
  }
  return values;
}

SpanMethod method_of(StepMethod contestant) {
  switch (contestant) {
  case StepMethod::euler2:
    return SpanMethod::euler2;
  case StepMethod::newton:
    return SpanMethod::newton;
  case StepMethod::newton_direct:
    return SpanMethod::newton_direct;
  case StepMethod::newton_general:
    return SpanMethod::newton_general;
  default:
    return SpanMethod::exact;
  }
}

template <class Real>
HardResult compare(StepMethod contestant, const SpanCoefficients& run) {
  const Span span = make_span(run);
  std::vector<Wide> got;
  if (contestant <= StepMethod::listing2) {
    for (Real value : raw_values<Real>(contestant, run)) got.push_back(static_cast<Wide>(value));
  } else {
    const SpanMethod method = method_of(contestant);
    std::vector<Real> u(static_cast<std::size_t>(run.count)), v(u);
    fill_span<Real>(span, {method, 0}, u, v);
    for (Real offset : u) {
      got.push_back(static_cast<Wide>(span.u.tile) + static_cast<Wide>(span.u.fraction) +
                    static_cast<Wide>(offset));
    }
  }

  const FractionalLinear<Wide> f{run.a1, run.b1, run.c, run.d};
  const Wide products = std::abs(f.a * f.d) + std::abs(f.b * f.c);
  const bool moves = std::abs(f.determinant()) > 0x1p-52L * products;
  HardResult result;
  Wide largest = 0, off = 0;
  for (std::size_t n = 0; n < got.size(); ++n) {
    if (!std::isfinite(got[n])) return {HUGE_VAL, HUGE_VAL};
    const Wide exact = f.value(static_cast<Wide>(n));
    largest = std::max(largest, std::abs(exact));
    off = std::max(off, std::abs(got[n] - exact));
    // F(got) - n from the difference, which keeps its digits: (got - exact)(cn+d)/(a - c got).
    const Wide place = (got[n] - exact) * (f.c * static_cast<Wide>(n) + f.d) / (f.a - f.c * got[n]);
    if (moves) result.pixels = std::max(result.pixels, static_cast<double>(std::abs(place)));
  }
  result.relative = static_cast<double>(largest > 0 ? off / largest : off);
  return result;
}

// One recurrence of 1/(d - n): advance(y, n) gives the value at n + 1.
using Advance32 = std::function<float(float, int)>;
using AdvanceWide = std::function<Wide(Wide, int)>;

ErrorCurve curve(const std::string& name, int count, double d, const Advance32& advance,
                 const AdvanceWide& exact_advance, const std::function<double(int)>& bound) {
  constexpr int entries = 256;
  const FractionalLinear<Wide> f{0, 1, -1, d};
  ErrorCurve result;
  result.name = name;
  float y = static_cast<float>(1 / d);
  Wide wide = 1 / Wide(d);
  double total = 0, rounding = 0;
  int entry = 1;
  for (int n = 0; n < count; ++n) {
    const Wide place = f.inverse(static_cast<Wide>(y)), wide_place = f.inverse(wide);
    total = std::max(total, static_cast<double>(std::abs(n - place)));
    rounding = std::max(rounding, static_cast<double>(std::abs(wide_place - place)));
    if (static_cast<std::int64_t>(n) * entries >= static_cast<std::int64_t>(entry) * (count - 1)) {
      result.n.push_back(n);
      result.total.push_back(total);
      result.rounding.push_back(rounding);
      if (bound) result.bound.push_back(bound(n));
      total = rounding = 0;
      ++entry;
    }
    y = advance(y, n);
    wide = exact_advance(wide, n);
  }
  return result;
}

} // namespace

std::vector<SpanCase> span_cases() {
  const auto with = [](SpanShape shape, const std::string& name, int count, double behind) {
    Span span;
    span.count = count;
    span.du = 1.0 / tile_side;
    span.dv = -0.3 / tile_side;
    span.bend = 1 / (count - 1 + behind);
    return SpanCase{shape, name, span};
  };
  return {with(SpanShape::nearly_straight, "nearly straight: horizon 10^6 pixels behind the last", 1920, 1e6),
          with(SpanShape::mild, "mild: one span behind", 1920, 1920),
          with(SpanShape::steep, "steep: 100 pixels behind", 1920, 100),
          with(SpanShape::grazing, "grazing: 5 pixels behind", 1920, 5),
          with(SpanShape::horizon_inside, "horizon inside the last pixel: 0.01 behind", 1920, 0.01),
          with(SpanShape::from_the_paper, "the example of [Cou]: 101 pixels, 20 behind", 101, 20),
          with(SpanShape::long_run, "long: 16384 pixels, 1000 behind", 16384, 1000)};
}

SpanError span_error(const Span& span, const SpanOptions& options, SpanPrecision precision) {
  return precision == SpanPrecision::f32 ? error_of<float>(span, options) : error_of<double>(span, options);
}

std::vector<HardCase> hard_cases() {
  const auto with = [](const std::string& name, double a, double b, double c, double d, int count) {
    SpanCoefficients run;
    run.a1 = run.a2 = a;
    run.b1 = run.b2 = b;
    run.c = c;
    run.d = d;
    run.count = count;
    return HardCase{name, run};
  };
  return {with("ordinary: 1920 pixels, horizon 200 behind", 3, 100, -1, 2119, 1920),
          with("horizon 2^-10 pixels behind the last", 3, 100, -1, 1919 + 0x1p-10, 1920),
          with("c = 0", 0.01, 3, 0, 1, 1920),
          with("c to 0: horizon 10^9 pixels away", 0.01, 3, -1e-9, 1, 1920),
          with("d huge: 10^30", 3e27, 1e29, -1e27, 2.119e30, 1920),
          with("d tiny: 10^-30", 3e-33, 1e-31, -1e-33, 2.119e-30, 1920),
          with("1 pixel", 3, 100, -1, 200, 1),
          with("2 pixels", 3, 100, -1, 200, 2),
          with("16384 pixels, horizon 200 behind", 3, 100, -1, 16583, 16384),
          with("D = 0: a constant 3", -3, 6357, -1, 2119, 1920),
          with("D near 0: moves by 10^-3 tiles in all", -3.00005, 6357, -1, 2119, 1920),
          with("all near overflow: 10^38", 3e35, 1e37, -1e35, 2.119e38, 1920),
          with("10^35 tiles away (ours are held at 2^61)", 1e35, 3e38, -1, 2119, 1920),
          with("denormal denominators: 10^-40 and less", 3e-43, 1e-41, -1e-43, 2.119e-40, 1920),
          with("from the far end: c > 0", -3, 5857, 1, 200, 1920),
          with("far start: a million tiles away", 3, 2.119e9, -1, 2119, 1920)};
}

std::string_view name_of(StepMethod contestant) {
  switch (contestant) {
  case StepMethod::division:
    return "division of an+b by cn+d";
  case StepMethod::listing1:
    return "Listing 1 as printed";
  case StepMethod::listing2:
    return "Listing 2 as printed";
  default:
    return name_of(method_of(contestant));
  }
}

HardResult run_contestant(StepMethod contestant, const HardCase& hard, SpanPrecision precision) {
  const SpanCoefficients run = near_end_first(hard.run);
  return precision == SpanPrecision::f32 ? compare<float>(contestant, run) : compare<double>(contestant, run);
}

std::vector<ErrorCurve> error_curves(int count, double behind, int reseed) {
  const double d = count - 1 + behind;
  const float df = static_cast<float>(d);
  const auto euler1 = [](auto y, int) { return euler1_step<decltype(y)>(y, -1); };
  const auto euler2 = [](auto y, int) { return euler2_step<decltype(y)>(y, -1); };
  const auto fresh = [=](float y, int n) { return newton_step(y, df - static_cast<float>(n + 1)); };
  const auto newton = [=](Wide y, int n) { return newton_step<Wide>(y, Wide(d) - (n + 1)); };
  const auto reseeded = [=](auto step, auto divide) {
    return [=](auto y, int n) { return (n + 1) % reseed == 0 ? divide(n + 1) : step(y, n); };
  };
  const auto divide = [=](int n) { return 1 / (df - static_cast<float>(n)); };
  const auto wide_divide = [=](int n) { return 1 / (Wide(d) - n); };
  // Listing 1 adds c to its coefficient; scaled to d = 1, as c = -1 would make every sum exact.
  const auto listing = [=, k = static_cast<float>(1 / d)](int interval) {
    return [=, q = -1.0f](float y, int n) mutable {
      q = (n + 1) % interval == 0 ? k * static_cast<float>(n + 1) - 1 : q + k;
      return (n + 1) % interval == 0 ? divide(n + 1) : (q * (y * df) + 2) * y;
    };
  };
  const auto bound1 = [=](int n) { return euler1_bound(-1.0, d, static_cast<double>(n)); };
  const auto bound2 = [=](int n) { return euler2_bound(-1.0, d, static_cast<double>(n)); };
  const auto bound3 = [=](int n) { return newton_bound(-1.0, d, static_cast<double>(n)); };
  const std::string every = ", exact every " + std::to_string(reseed);
  return {curve(
              "division", count, d, [=](float, int n) { return divide(n + 1); },
              [=](Wide, int n) { return wide_divide(n + 1); }, {}),
          curve("Euler 1", count, d, euler1, euler1, bound1),
          curve("Euler 2", count, d, euler2, euler2, bound2),
          curve("Newton", count, d, fresh, newton, bound3),
          curve("Newton, coefficient added up", count, d, listing(count), newton, bound3),
          curve("Euler 2" + every, count, d, reseeded(euler2, divide), reseeded(euler2, wide_divide), {}),
          curve("Newton, added up" + every, count, d, listing(reseed), reseeded(newton, wide_divide), {})};
}

} // namespace tilepack
