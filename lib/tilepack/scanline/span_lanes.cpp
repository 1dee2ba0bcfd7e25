// Compiled once for each instruction set, by including itself.
// Vectors of unknown size (SVE, RVV) cannot be members of a struct: those processors use their fixed ones.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tilepack/scanline/span_lanes.cpp" // NOLINT
#include <hwy/foreach_target.h>
//
#include "tilepack/scanline/span_constants.h"
#include "tilepack/scanline/span_lanes.h"

#include <hwy/highway.h>

#include <algorithm>

HWY_BEFORE_NAMESPACE();
namespace tilepack::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <bool fused, class V>
HWY_INLINE V times_plus(V a, V b, V c) {
  if constexpr (fused) {
    return hn::MulAdd(a, b, c);
  } else {
    return hn::Add(hn::Mul(a, b), c);
  }
}

template <class D, class V = hn::Vec<D>>
HWY_INLINE V held_denominator(D d, V bend, V n) {
  const V one = hn::Set(d, hn::TFromD<D>(1));
  return hn::Max(hn::Sub(one, hn::Mul(bend, n)), hn::Set(d, lowest_denominator<hn::TFromD<D>>));
}

// estimated_reciprocal, lane by lane.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V reciprocal_from_bits(D d, V x) {
  using Real = hn::TFromD<D>;
  const hn::RebindToUnsigned<D> du;
  const V two = hn::Set(d, Real(2));
  V y = hn::BitCast(d, hn::Sub(hn::Set(du, reciprocal_bits<Real>), hn::BitCast(du, x)));
  for (int i = 0; i < reciprocal_steps<Real>; ++i) y = hn::Mul(y, hn::Sub(two, hn::Mul(x, y)));
  return y;
}

template <bool fused, class D, class V = hn::Vec<D>>
HWY_INLINE V reciprocal_estimate(D d, V x) {
  if constexpr (fused && sizeof(hn::TFromD<D>) == 4) {
    const V y = hn::ApproximateReciprocal(x);
    return hn::Mul(y, hn::NegMulAdd(x, y, hn::Set(d, 2.0f)));
  } else {
    return reciprocal_from_bits(d, x);
  }
}

// One register's worth of scanlines: what Piece and its step are in span_method.cpp, operation by operation.
// Members of vector type need a size known at compile time, so SVE and RVV are left out above.
template <SpanMethod method, bool fused, class D>
struct Lanes {
  using V = hn::Vec<D>;
  using Real = hn::TFromD<D>;
  V bend, du, dv, last;         // of the whole span
  V pu, pv, pdu, pdv, k;        // of the piece
  V y, q;                       // reciprocal methods; affine: y = slope
  V a_u, q0u, q1, q2u, s2u, wu; // Listing 2, u; q1 is common
  V a_v, q0v, q2v, s2v, wv;

  HWY_INLINE void load(D d, const SpanLanes<Real>& lanes, int at) {
    bend = hn::Load(d, lanes.bend + at);
    du = hn::Load(d, lanes.du + at);
    dv = hn::Load(d, lanes.dv + at);
    last = hn::Load(d, lanes.last + at);
  }

  HWY_INLINE void seed(D d, Real start, Real length) {
    const V one = hn::Set(d, Real(1));
    const V n0 = hn::Set(d, start);
    const V r = hn::Div(one, held_denominator(d, bend, n0));
    const V t = hn::Mul(n0, r);
    const V r2 = hn::Mul(r, r);
    pu = hn::Mul(du, t);
    pv = hn::Mul(dv, t);
    pdu = hn::Mul(du, r2);
    pdv = hn::Mul(dv, r2);
    k = hn::Mul(bend, r);
    if constexpr (method == SpanMethod::euler1 || method == SpanMethod::euler2) {
      y = one;
    } else if constexpr (method == SpanMethod::newton) {
      y = one;
      q = hn::Neg(one);
    } else if constexpr (method == SpanMethod::newton_direct) {
      y = one;
    } else if constexpr (method == SpanMethod::affine) {
      const V chord = hn::Min(hn::Max(hn::Sub(last, n0), one), hn::Set(d, length));
      y = hn::Div(one, held_denominator(d, k, chord));
    } else if constexpr (method == SpanMethod::newton_general) {
      seed_general(d, pdu, a_u, q0u, q2u, s2u, wu);
      seed_general(d, pdv, a_v, q0v, q2v, s2v, wv);
      q1 = hn::Zero(d);
    }
  }

  HWY_INLINE void seed_general(D d, V slope, V& a, V& q0, V& q2, V& s2, V& w) {
    const auto flat = hn::Lt(hn::Abs(slope), hn::Set(d, flattest_slope<Real>));
    a = hn::IfThenZeroElse(flat, slope);
    const V r = hn::IfThenZeroElse(flat, hn::Div(hn::Set(d, Real(1)), slope));
    const V kr = hn::Mul(k, r);
    q0 = hn::Zero(d);
    q2 = hn::Neg(kr);
    s2 = hn::Mul(k, kr);
    w = hn::Zero(d);
  }

  // The offsets of the pixel `j` steps after the seed.
  HWY_INLINE void put(D d, V j, Real* u, Real* v) const {
    if constexpr (method == SpanMethod::newton_general) {
      hn::Store(hn::Add(pu, wu), d, u);
      hn::Store(hn::Add(pv, wv), d, v);
    } else {
      const V t = hn::Mul(j, y);
      hn::Store(times_plus<fused>(pdu, t, pu), d, u);
      hn::Store(times_plus<fused>(pdv, t, pv), d, v);
    }
  }

  // To the pixel `next` steps after the seed.
  HWY_INLINE void advance(D d, V next) {
    if constexpr (method == SpanMethod::euler1) {
      y = times_plus<fused>(hn::Mul(k, y), y, y);
    } else if constexpr (method == SpanMethod::euler2) {
      const V ky = hn::Mul(k, y);
      y = times_plus<fused>(times_plus<fused>(ky, ky, ky), y, y);
    } else if constexpr (method == SpanMethod::newton) {
      q = hn::Add(q, k);
      y = hn::Mul(times_plus<fused>(q, y, hn::Set(d, Real(2))), y);
    } else if constexpr (method == SpanMethod::newton_direct) {
      const V direct = times_plus<fused>(k, next, hn::Set(d, Real(-1)));
      y = hn::Mul(times_plus<fused>(direct, y, hn::Set(d, Real(2))), y);
    } else if constexpr (method == SpanMethod::newton_general) {
      q0u = hn::Add(q0u, a_u);
      q0v = hn::Add(q0v, a_v);
      q1 = hn::Add(q1, hn::Add(k, k));
      q2u = hn::Add(q2u, s2u);
      q2v = hn::Add(q2v, s2v);
      wu = times_plus<fused>(times_plus<fused>(q2u, wu, q1), wu, q0u);
      wv = times_plus<fused>(times_plus<fused>(q2v, wv, q1), wv, q0v);
    }
  }
};

// Two registers at a time: the steps of one fill the waits of the other.
template <SpanMethod method, bool fused, class D>
void step_pieces(D d, const SpanLanes<hn::TFromD<D>>& lanes, const LaneRun& run, hn::TFromD<D>* u,
                 hn::TFromD<D>* v) {
  using Real = hn::TFromD<D>;
  const int width = static_cast<int>(hn::Lanes(d));
  for (int at = 0; at < scanlines_side_by_side; at += 2 * width) {
    Lanes<method, fused, D> left, right;
    left.load(d, lanes, at);
    right.load(d, lanes, at + width);
    for (int n0 = 0; n0 < run.pixels; n0 += run.piece) {
      left.seed(d, static_cast<Real>(n0), static_cast<Real>(run.piece));
      right.seed(d, static_cast<Real>(n0), static_cast<Real>(run.piece));
      const int end = std::min(run.pixels, n0 + run.piece);
      auto j = hn::Zero(d);
      for (int n = n0; n < end; ++n) {
        Real* const pixel_u = u + lane_index(at, n);
        Real* const pixel_v = v + lane_index(at, n);
        left.put(d, j, pixel_u, pixel_v);
        right.put(d, j, pixel_u + width, pixel_v + width);
        j = hn::Add(j, hn::Set(d, Real(1)));
        left.advance(d, j);
        right.advance(d, j);
      }
    }
  }
}

template <bool estimate, bool fused, class D>
void divide_pixels(D d, const SpanLanes<hn::TFromD<D>>& lanes, const LaneRun& run, hn::TFromD<D>* u,
                   hn::TFromD<D>* v) {
  using Real = hn::TFromD<D>;
  const int width = static_cast<int>(hn::Lanes(d));
  for (int at = 0; at < scanlines_side_by_side; at += width) {
    const auto bend = hn::Load(d, lanes.bend + at);
    const auto du = hn::Load(d, lanes.du + at);
    const auto dv = hn::Load(d, lanes.dv + at);
    auto x = hn::Zero(d);
    for (int n = 0; n < run.pixels; ++n) {
      const auto below = held_denominator(d, bend, x);
      auto t = x;
      if constexpr (estimate) {
        t = hn::Mul(x, reciprocal_estimate<fused>(d, below));
      } else {
        t = hn::Div(x, below);
      }
      hn::Store(hn::Mul(du, t), d, u + lane_index(at, n));
      hn::Store(hn::Mul(dv, t), d, v + lane_index(at, n));
      x = hn::Add(x, hn::Set(d, Real(1)));
    }
  }
}

template <bool fused, class D>
void step_method(D d, const SpanLanes<hn::TFromD<D>>& lanes, const LaneRun& run, hn::TFromD<D>* u,
                 hn::TFromD<D>* v) {
  switch (run.method) {
  case SpanMethod::exact:
    return divide_pixels<false, fused>(d, lanes, run, u, v);
  case SpanMethod::euler1:
    return step_pieces<SpanMethod::euler1, fused>(d, lanes, run, u, v);
  case SpanMethod::euler2:
    return step_pieces<SpanMethod::euler2, fused>(d, lanes, run, u, v);
  case SpanMethod::newton:
    return step_pieces<SpanMethod::newton, fused>(d, lanes, run, u, v);
  case SpanMethod::newton_direct:
    return step_pieces<SpanMethod::newton_direct, fused>(d, lanes, run, u, v);
  case SpanMethod::newton_general:
    return step_pieces<SpanMethod::newton_general, fused>(d, lanes, run, u, v);
  case SpanMethod::affine:
    return step_pieces<SpanMethod::affine, fused>(d, lanes, run, u, v);
  case SpanMethod::estimate:
    return divide_pixels<true, fused>(d, lanes, run, u, v);
  }
}

// At most 16 lanes of float, 8 of double, so that two registers never exceed the 32 scanlines.
void step_floats(const SpanLanes<float>& lanes, const LaneRun& run, float* u, float* v) {
  const hn::CappedTag<float, 16> d;
  run.fused ? step_method<true>(d, lanes, run, u, v) : step_method<false>(d, lanes, run, u, v);
}

void step_doubles(const SpanLanes<double>& lanes, const LaneRun& run, double* u, double* v) {
  const hn::CappedTag<double, 16> d;
  run.fused ? step_method<true>(d, lanes, run, u, v) : step_method<false>(d, lanes, run, u, v);
}

std::string_view target_here() {
  return hwy::TargetName(HWY_TARGET);
}

} // namespace tilepack::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tilepack {

HWY_EXPORT(step_floats);
HWY_EXPORT(step_doubles);
HWY_EXPORT(target_here);

void step_lanes(const SpanLanes<float>& lanes, const LaneRun& run, float* u, float* v) {
  HWY_DYNAMIC_DISPATCH(step_floats)(lanes, run, u, v);
}

void step_lanes(const SpanLanes<double>& lanes, const LaneRun& run, double* u, double* v) {
  HWY_DYNAMIC_DISPATCH(step_doubles)(lanes, run, u, v);
}

std::string_view batch_target() {
  return HWY_DYNAMIC_DISPATCH(target_here)();
}

} // namespace tilepack
#endif
