#include "tilepack/scanline/span_method.h"

#include "tilepack/error/error.h"
#include "tilepack/error/nearest_name.h"
#include "tilepack/numeric/exact_math.h"
#include "tilepack/scanline/span_constants.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

namespace tilepack {
namespace {

constexpr double ln2 = 0.69314718055994530942;

// Whether roundings add up from step to step.
bool sums_up(SpanMethod method) {
  return method != SpanMethod::exact && method != SpanMethod::estimate && method != SpanMethod::newton_direct;
}

bool steps_from_seeds(SpanMethod method) {
  return method != SpanMethod::exact && method != SpanMethod::estimate;
}

// One seed's worth of a span: the exact values at its first pixel, and what the steps from there need. The
// local function has the same form with its own bend and slopes, since f(n0 + j) = f(n0) + f'(n0) j/(1-kj).
template <class Real>
struct Piece {
  Real u, v;   // offset at the seed
  Real du, dv; // derivative at the seed
  Real k;      // bend at the seed
};

template <class Real>
Piece<Real> piece_at(Real bend, Real du, Real dv, Real n0) {
  const Real y = 1 / std::max(1 - bend * n0, lowest_denominator<Real>);
  const Real t = n0 * y;
  const Real y2 = y * y;
  return {du * t, dv * t, du * y2, dv * y2, bend * y};
}

// Runs step(j) -> t for j = 0..length-1, where t = j/(1 - k j) up to the method's error.
template <class Real, class Step>
void write_piece(const Piece<Real>& piece, Real* u, Real* v, int length, Step step) {
  Real j = 0;
  for (int i = 0; i < length; ++i) {
    const Real t = step(j);
    u[i] = piece.u + piece.du * t;
    v[i] = piece.v + piece.dv * t;
    j += 1;
  }
}

// [Cou, Listing 2] for f(j) = slope j / (1 - k j): a = slope, b = 0, c = -k, d = 1, so D = slope.
template <class Real>
void write_general(Real start, Real slope, Real k, Real* out, int length) {
  const Real a = std::abs(slope) < flattest_slope<Real> ? Real(0) : slope;
  const Real r = a == 0 ? Real(0) : 1 / a;
  const Real kr = k * r;
  Real q0 = 0, q1 = 0, q2 = -kr, w = 0;
  const Real s1 = k + k, s2 = k * kr;
  for (int i = 0; i < length; ++i) {
    out[i] = start + w;
    q0 += a;
    q1 += s1;
    q2 += s2;
    w = (q2 * w + q1) * w + q0;
  }
}

template <class Real>
void step_piece(SpanMethod method, const Piece<Real>& piece, Real* u, Real* v, int length, int chord) {
  const Real k = piece.k;
  switch (method) {
  case SpanMethod::euler1: {
    Real y = 1;
    write_piece(piece, u, v, length, [&](Real j) {
      const Real t = j * y;
      y = y + (k * y) * y;
      return t;
    });
    return;
  }
  case SpanMethod::euler2: {
    Real y = 1;
    write_piece(piece, u, v, length, [&](Real j) {
      const Real t = j * y;
      const Real ky = k * y;
      y = y + (ky + ky * ky) * y;
      return t;
    });
    return;
  }
  case SpanMethod::newton: {
    Real y = 1, q = -1;
    write_piece(piece, u, v, length, [&](Real j) {
      const Real t = j * y;
      q = q + k;
      y = (q * y + 2) * y;
      return t;
    });
    return;
  }
  case SpanMethod::newton_direct: {
    Real y = 1;
    write_piece(piece, u, v, length, [&](Real j) {
      const Real t = j * y;
      const Real q = k * (j + 1) - 1;
      y = (q * y + 2) * y;
      return t;
    });
    return;
  }
  case SpanMethod::newton_general:
    write_general(piece.u, piece.du, k, u, length);
    write_general(piece.v, piece.dv, k, v, length);
    return;
  case SpanMethod::affine: {
    const Real end = static_cast<Real>(chord);
    const Real slope = 1 / std::max(1 - k * end, lowest_denominator<Real>);
    write_piece(piece, u, v, length, [&](Real j) { return j * slope; });
    return;
  }
  case SpanMethod::exact:
  case SpanMethod::estimate:
    return;
  }
}

template <class Real>
Real reciprocal_by_bits(Real x, Real start, int steps) {
  Real y = start;
  for (int i = 0; i < steps; ++i) y = y * (2 - x * y);
  return y;
}

} // namespace

SpanMethod span_method_of(const std::string& name) {
  return enum_called<SpanMethod>(name, field("span"), "method");
}

double method_bound(SpanMethod method, double distance, int steps) {
  const double m = steps;
  switch (method) {
  case SpanMethod::exact:
  case SpanMethod::estimate:
    return 0;
  case SpanMethod::euler1: // by exact_log2, so that an interval chosen from it is the same everywhere
    return std::isinf(distance) ? 0 : ln2 * exact_log2(1 + m / (distance + 1));
  case SpanMethod::euler2:
    return 4 * m / ((2 * distance + 1) * (2 * (distance + m) + 1));
  case SpanMethod::newton:
  case SpanMethod::newton_direct:
  case SpanMethod::newton_general:
    // The fixed point, with the difference of near-equal numbers turned into a quotient.
    return steps == 0 ? 0 : 2 / (std::sqrt(distance * distance + 4) + distance);
  case SpanMethod::affine: {
    const double root = m / (std::sqrt(distance + m) + std::sqrt(distance));
    return std::isinf(distance) ? 0 : root * root;
  }
  }
  return 0;
}

double rounding_bound(SpanMethod method, int n, int steps, double unit) {
  const double drift = sums_up(method) ? (steps + 4.0) * (steps + 1.0) : 0.0;
  return unit * (8.0 * n + 4 + drift);
}

int reseed_interval(SpanMethod method, const Span& span, double wanted, double unit) {
  if (!steps_from_seeds(method)) return max_span_pixels;
  const int end = std::max(span.count - 1, 0);
  const double distance = std::max(horizon_distance(span, end), 1.0);
  const auto within = [&](int interval) {
    const int steps = method == SpanMethod::affine ? interval : interval - 1;
    return method_bound(method, distance, steps) + rounding_bound(method, end, steps, unit) <= wanted;
  };
  int good = 1;
  for (int bit = max_span_pixels; bit > 0; bit /= 2) {
    if (good + bit <= max_span_pixels && within(good + bit)) good += bit;
  }
  return good;
}

int steppable_pixels(const Span& span, const SpanOptions& options, double unit) {
  if (span.bend == 0) return span.count;
  const bool steps = steps_from_seeds(options.method);
  const int run = !sums_up(options.method) ? 1
                  : options.reseed > 0     ? std::min(options.reseed, span.count)
                                           : span.count;
  const double margin = (steps ? 1.0 : 0.0) + 2 * unit * (run + 4.0) / span.bend;
  const double last = std::floor(horizon_distance(span, 0) - margin);
  if (!(last >= 0)) return 0;
  return last + 1 < span.count ? static_cast<int>(last) + 1 : span.count;
}

double exact_offset(double slope, const Span& span, int n) {
  return slope * n / denominator(span, n);
}

float estimated_reciprocal(float x) {
  const auto bits = reciprocal_bits<float> - std::bit_cast<std::uint32_t>(x);
  return reciprocal_by_bits(x, std::bit_cast<float>(bits), reciprocal_steps<float>);
}

double estimated_reciprocal(double x) {
  const auto bits = reciprocal_bits<double> - std::bit_cast<std::uint64_t>(x);
  return reciprocal_by_bits(x, std::bit_cast<double>(bits), reciprocal_steps<double>);
}

void check_reseed(const SpanOptions& options) {
  if (options.reseed >= 0 && options.reseed <= max_span_pixels) return;
  throw Error(ErrorKind::usage, field("reseed"),
              std::to_string(options.reseed) + " is out of range; give 1 to " +
                  std::to_string(max_span_pixels) + " pixels, or 0 for the first pixel only");
}

int piece_length(const SpanOptions& options, int count) {
  if (options.reseed > 0) return options.reseed;
  return options.method == SpanMethod::affine ? affine_piece : std::max(count, 1);
}

template <class Real>
void fill_span(const Span& span, const SpanOptions& options, std::span<Real> u, std::span<Real> v) {
  check_reseed(options);
  const int steppable = steppable_pixels(span, options, rounding_unit<Real>);
  const Real bend = static_cast<Real>(span.bend);
  const Real du = static_cast<Real>(span.du), dv = static_cast<Real>(span.dv);

  if (options.method == SpanMethod::exact) {
    for (int n = 0; n < steppable; ++n) {
      const Real x = static_cast<Real>(n);
      const Real t = x / std::max(1 - bend * x, lowest_denominator<Real>);
      u[static_cast<std::size_t>(n)] = du * t;
      v[static_cast<std::size_t>(n)] = dv * t;
    }
  } else if (options.method == SpanMethod::estimate) {
    for (int n = 0; n < steppable; ++n) {
      const Real x = static_cast<Real>(n);
      const Real t = x * estimated_reciprocal(std::max(1 - bend * x, lowest_denominator<Real>));
      u[static_cast<std::size_t>(n)] = du * t;
      v[static_cast<std::size_t>(n)] = dv * t;
    }
  } else {
    const int length = piece_length(options, span.count);
    for (int n0 = 0; n0 < steppable; n0 += length) {
      const auto piece = piece_at(bend, du, dv, static_cast<Real>(n0));
      const int chord = std::clamp(steppable - 1 - n0, 1, length);
      step_piece(options.method, piece, u.data() + n0, v.data() + n0, std::min(length, steppable - n0),
                 chord);
    }
  }
  for (int n = steppable; n < span.count; ++n) {
    u[static_cast<std::size_t>(n)] = static_cast<Real>(exact_offset(span.du, span, n));
    v[static_cast<std::size_t>(n)] = static_cast<Real>(exact_offset(span.dv, span, n));
  }
}

template void fill_span(const Span&, const SpanOptions&, std::span<float>, std::span<float>);
template void fill_span(const Span&, const SpanOptions&, std::span<double>, std::span<double>);

} // namespace tilepack
