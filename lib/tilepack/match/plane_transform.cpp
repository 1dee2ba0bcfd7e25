#include "tilepack/match/plane_transform.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <new>
#include <numbers>
#include <utility>

// This file is compiled once for each instruction set, by including itself.
// clang-format off
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tilepack/match/plane_transform.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// clang-format on

#ifndef TILEPACK_MATCH_TRANSFORM_LANES
#define TILEPACK_MATCH_TRANSFORM_LANES
namespace tilepack::transform {
constexpr int lanes = 8; // lines side by side: a cache line of doubles
}
#endif

HWY_BEFORE_NAMESPACE();
namespace tilepack {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

constexpr hn::CappedTag<double, transform::lanes> d64;
using Doubles = hn::Vec<decltype(d64)>;

// Of `radix` complex numbers their transform, in place.
template <int radix>
HWY_INLINE void transform_few(Doubles* re, Doubles* im) {
  if constexpr (radix == 2) {
    const Doubles r = hn::Sub(re[0], re[1]), i = hn::Sub(im[0], im[1]);
    re[0] = hn::Add(re[0], re[1]), im[0] = hn::Add(im[0], im[1]);
    re[1] = r, im[1] = i;
  } else if constexpr (radix == 3) {
    const Doubles half = hn::Set(d64, 0.5), sine = hn::Set(d64, std::numbers::sqrt3 / 2);
    const Doubles sum_re = hn::Add(re[1], re[2]), sum_im = hn::Add(im[1], im[2]);
    const Doubles turned_re = hn::Mul(sine, hn::Sub(re[1], re[2]));
    const Doubles turned_im = hn::Mul(sine, hn::Sub(im[1], im[2]));
    const Doubles middle_re = hn::Sub(re[0], hn::Mul(half, sum_re));
    const Doubles middle_im = hn::Sub(im[0], hn::Mul(half, sum_im));
    re[0] = hn::Add(re[0], sum_re), im[0] = hn::Add(im[0], sum_im);
    re[1] = hn::Add(middle_re, turned_im), im[1] = hn::Sub(middle_im, turned_re);
    re[2] = hn::Sub(middle_re, turned_im), im[2] = hn::Add(middle_im, turned_re);
  } else if constexpr (radix == 4) {
    const Doubles even_re = hn::Add(re[0], re[2]), even_im = hn::Add(im[0], im[2]);
    const Doubles odd_re = hn::Add(re[1], re[3]), odd_im = hn::Add(im[1], im[3]);
    const Doubles d02_re = hn::Sub(re[0], re[2]), d02_im = hn::Sub(im[0], im[2]);
    const Doubles d13_re = hn::Sub(re[1], re[3]), d13_im = hn::Sub(im[1], im[3]);
    re[0] = hn::Add(even_re, odd_re), im[0] = hn::Add(even_im, odd_im);
    re[1] = hn::Add(d02_re, d13_im), im[1] = hn::Sub(d02_im, d13_re);
    re[2] = hn::Sub(even_re, odd_re), im[2] = hn::Sub(even_im, odd_im);
    re[3] = hn::Sub(d02_re, d13_im), im[3] = hn::Add(d02_im, d13_re);
  } else {
    static_assert(radix == 5);
    // Cosines and sines of a fifth of a turn and of two.
    const Doubles cos1 = hn::Set(d64, 0.30901699437494742410), cos2 = hn::Set(d64, -0.80901699437494742410);
    const Doubles sin1 = hn::Set(d64, 0.95105651629515357212), sin2 = hn::Set(d64, 0.58778525229247312917);
    const Doubles s1_re = hn::Add(re[1], re[4]), s1_im = hn::Add(im[1], im[4]);
    const Doubles s2_re = hn::Add(re[2], re[3]), s2_im = hn::Add(im[2], im[3]);
    const Doubles d1_re = hn::Sub(re[1], re[4]), d1_im = hn::Sub(im[1], im[4]);
    const Doubles d2_re = hn::Sub(re[2], re[3]), d2_im = hn::Sub(im[2], im[3]);
    const Doubles p1_re = hn::Add(re[0], hn::Add(hn::Mul(cos1, s1_re), hn::Mul(cos2, s2_re)));
    const Doubles p1_im = hn::Add(im[0], hn::Add(hn::Mul(cos1, s1_im), hn::Mul(cos2, s2_im)));
    const Doubles p2_re = hn::Add(re[0], hn::Add(hn::Mul(cos2, s1_re), hn::Mul(cos1, s2_re)));
    const Doubles p2_im = hn::Add(im[0], hn::Add(hn::Mul(cos2, s1_im), hn::Mul(cos1, s2_im)));
    const Doubles r1_re = hn::Add(hn::Mul(sin1, d1_re), hn::Mul(sin2, d2_re));
    const Doubles r1_im = hn::Add(hn::Mul(sin1, d1_im), hn::Mul(sin2, d2_im));
    const Doubles r2_re = hn::Sub(hn::Mul(sin2, d1_re), hn::Mul(sin1, d2_re));
    const Doubles r2_im = hn::Sub(hn::Mul(sin2, d1_im), hn::Mul(sin1, d2_im));
    re[0] = hn::Add(re[0], hn::Add(s1_re, s2_re)), im[0] = hn::Add(im[0], hn::Add(s1_im, s2_im));
    re[1] = hn::Add(p1_re, r1_im), im[1] = hn::Sub(p1_im, r1_re);
    re[2] = hn::Add(p2_re, r2_im), im[2] = hn::Sub(p2_im, r2_re);
    re[3] = hn::Sub(p2_re, r2_im), im[3] = hn::Add(p2_im, r2_re);
    re[4] = hn::Sub(p1_re, r1_im), im[4] = hn::Add(p1_im, r1_re);
  }
}

template <int radix>
HWY_INLINE void twiddle(Doubles* re, Doubles* im, const double* factors) {
  for (int s = 1; s < radix; ++s, factors += 2) {
    const Doubles cosine = hn::Set(d64, factors[0]), sine = hn::Set(d64, factors[1]);
    const Doubles r = hn::Sub(hn::Mul(re[s], cosine), hn::Mul(im[s], sine));
    im[s] = hn::Add(hn::Mul(re[s], sine), hn::Mul(im[s], cosine));
    re[s] = r;
  }
}

// One step along lines of `count` numbers, which lie lane beside lane.
template <int radix>
void run_step(double* re, double* im, int count, const TransformStep& step, bool back) {
  const int part = step.length / radix;
  const auto apart = static_cast<std::ptrdiff_t>(part) * transform::lanes;
  for (int piece = 0; piece < count; piece += step.length)
    for (int j = 0; j < part; ++j) {
      const double* factors = step.twiddles.data() + static_cast<std::ptrdiff_t>(j) * 2 * (radix - 1);
      const auto at = static_cast<std::ptrdiff_t>(piece + j) * transform::lanes;
      for (std::size_t lane = 0; lane < transform::lanes; lane += hn::Lanes(d64)) {
        double* const r = re + at + lane;
        double* const i = im + at + lane;
        Doubles some_re[radix], some_im[radix];
        for (int k = 0; k < radix; ++k)
          some_re[k] = hn::Load(d64, r + k * apart), some_im[k] = hn::Load(d64, i + k * apart);
        if (back && part > 1) twiddle<radix>(some_re, some_im, factors);
        transform_few<radix>(some_re, some_im);
        if (!back && part > 1) twiddle<radix>(some_re, some_im, factors);
        for (int k = 0; k < radix; ++k)
          hn::Store(some_re[k], d64, r + k * apart), hn::Store(some_im[k], d64, i + k * apart);
      }
    }
}

void run_any_step(double* re, double* im, int count, const TransformStep& step, bool back) {
  if (step.radix == 4) run_step<4>(re, im, count, step, back);
  if (step.radix == 2) run_step<2>(re, im, count, step, back);
  if (step.radix == 3) run_step<3>(re, im, count, step, back);
  if (step.radix == 5) run_step<5>(re, im, count, step, back);
}

void transform_lines(double* re, double* im, int count, const TransformSteps& steps, bool back) {
  if (!back)
    for (const TransformStep& step : steps) run_any_step(re, im, count, step, false);
  else // the same with both parts exchanged: i · the conjugate of a number is that
    for (auto step = steps.rbegin(); step != steps.rend(); ++step) run_any_step(im, re, count, *step, true);
}

void correlate_values(const ComplexPlane& image, const ComplexPlane& patch, ComplexPlane& sum, bool first) {
  const hn::ScalableTag<double> d;
  const std::size_t count = image.count(), step = hn::Lanes(d);
  const double *a = image.real.get(), *b = image.imaginary.get();
  const double *c = patch.real.get(), *s = patch.imaginary.get();
  double *re = sum.real.get(), *im = sum.imaginary.get();
  std::size_t i = 0;
  for (; i + step <= count; i += step) {
    const auto va = hn::LoadU(d, a + i), vb = hn::LoadU(d, b + i);
    const auto vc = hn::LoadU(d, c + i), vs = hn::LoadU(d, s + i);
    const auto real = hn::Add(hn::Mul(va, vc), hn::Mul(vb, vs));
    const auto imaginary = hn::Sub(hn::Mul(vb, vc), hn::Mul(va, vs));
    hn::StoreU(first ? real : hn::Add(real, hn::LoadU(d, re + i)), d, re + i);
    hn::StoreU(first ? imaginary : hn::Add(imaginary, hn::LoadU(d, im + i)), d, im + i);
  }
  for (; i < count; ++i) {
    const double real = a[i] * c[i] + b[i] * s[i], imaginary = b[i] * c[i] - a[i] * s[i];
    re[i] = first ? real : re[i] + real;
    im[i] = first ? imaginary : im[i] + imaginary;
  }
}

} // namespace
} // namespace HWY_NAMESPACE
} // namespace tilepack
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tilepack {

HWY_EXPORT(transform_lines);
HWY_EXPORT(correlate_values);

namespace {

constexpr int lanes = transform::lanes;

TransformSteps steps_for(int size) {
  TransformSteps steps;
  int length = size;
  for (const int radix : {4, 2, 3, 5})
    for (; length % radix == 0; length /= radix) {
      TransformStep& step = steps.emplace_back(TransformStep{radix, length, {}});
      for (int j = 0; j < length / radix; ++j)
        for (int s = 1; s < radix; ++s) {
          const double angle = -2 * std::numbers::pi * (j * s % length) / length;
          step.twiddles.insert(step.twiddles.end(), {std::cos(angle), std::sin(angle)});
        }
    }
  return steps;
}

// Lines that lie lane beside lane.
class Lines {
public:
  explicit Lines(int length) : re(aligned(length)), im(aligned(length)), count(length) {}

  void transform(const TransformSteps& steps, bool back) {
    HWY_DYNAMIC_DISPATCH(transform_lines)(re.get(), im.get(), count, steps, back);
  }

private:
  static constexpr std::align_val_t line{lanes * sizeof(double)};
  struct Free {
    void operator()(double* values) const { ::operator delete[](values, line); }
  };
  using Values = std::unique_ptr<double[], Free>;
  static Values aligned(int length) {
    return Values(new (line) double[static_cast<std::size_t>(length) * lanes]);
  }

public:
  Values re, im;

private:
  int count;
};

// The columns from x on, of which the first rows are filled.
void take_columns(const ComplexPlane& plane, int x, int some, int filled, Lines& lines) {
  for (int y = 0; y < filled; ++y) {
    double* const re = lines.re.get() + static_cast<std::ptrdiff_t>(y) * lanes;
    double* const im = lines.im.get() + static_cast<std::ptrdiff_t>(y) * lanes;
    std::copy_n(plane.real_row(y) + x, some, re);
    std::copy_n(plane.imaginary_row(y) + x, some, im);
    std::fill(re + some, re + lanes, 0.0);
    std::fill(im + some, im + lanes, 0.0);
  }
  const auto first = static_cast<std::ptrdiff_t>(filled) * lanes,
             end = static_cast<std::ptrdiff_t>(plane.rows) * lanes;
  std::fill(lines.re.get() + first, lines.re.get() + end, 0.0);
  std::fill(lines.im.get() + first, lines.im.get() + end, 0.0);
}

void put_columns(const Lines& lines, ComplexPlane& plane, int x, int some, int rows) {
  for (int y = 0; y < rows; ++y) {
    std::copy_n(lines.re.get() + static_cast<std::ptrdiff_t>(y) * lanes, some, plane.real_row(y) + x);
    std::copy_n(lines.im.get() + static_cast<std::ptrdiff_t>(y) * lanes, some, plane.imaginary_row(y) + x);
  }
}

// Row y of a part of a plane, and those below it as long as they are among the first `end`; then the last again.
template <typename Row>
std::array<double*, lanes> rows_from(int y, int end, const Row& row) {
  std::array<double*, lanes> rows{};
  for (int lane = 0; lane < lanes; ++lane)
    rows[static_cast<std::size_t>(lane)] = row(std::min(y + lane, end - 1));
  return rows;
}

// The first `count` of each row, lane beside lane.
void interleave(const std::array<double*, lanes>& rows, int count, double* to) {
  for (std::ptrdiff_t x = 0; x < count; ++x)
    for (const double* row : rows) *to++ = row[x];
}

void deinterleave(const double* from, int count, double scale, const std::array<double*, lanes>& rows) {
  for (std::ptrdiff_t x = 0; x < count; ++x)
    for (double* row : rows) row[x] = scale * *from++;
}

} // namespace

ComplexPlane::ComplexPlane(int row_count, int column_count)
    : rows(row_count), columns(column_count), real(std::make_unique_for_overwrite<double[]>(count())),
      imaginary(std::make_unique_for_overwrite<double[]>(count())) {}

int transform_size(int size) {
  for (;; ++size) {
    int left = size;
    for (const int factor : {2, 3, 5})
      while (left % factor == 0) left /= factor;
    if (left == 1) return size;
  }
}

PlaneTransform::PlaneTransform(int rows, int columns)
    : of_row(steps_for(columns)), of_column(steps_for(rows)) {}

void PlaneTransform::forward(ComplexPlane& plane, Size filled) const {
  Lines rows(plane.columns);
  const auto blank = static_cast<std::ptrdiff_t>(filled.width) * lanes;
  const auto end = static_cast<std::ptrdiff_t>(plane.columns) * lanes;
  for (int y = 0; y < filled.height; y += lanes) {
    const auto re = rows_from(y, filled.height, [&](int row) { return plane.real_row(row); });
    const auto im = rows_from(y, filled.height, [&](int row) { return plane.imaginary_row(row); });
    interleave(re, filled.width, rows.re.get());
    interleave(im, filled.width, rows.im.get());
    std::fill(rows.re.get() + blank, rows.re.get() + end, 0.0);
    std::fill(rows.im.get() + blank, rows.im.get() + end, 0.0);
    rows.transform(of_row, false);
    deinterleave(rows.re.get(), plane.columns, 1.0, re);
    deinterleave(rows.im.get(), plane.columns, 1.0, im);
  }
  Lines columns(plane.rows);
  for (int x = 0; x < plane.columns; x += lanes) {
    const int some = std::min(lanes, plane.columns - x);
    take_columns(plane, x, some, filled.height, columns);
    columns.transform(of_column, false);
    put_columns(columns, plane, x, some, plane.rows);
  }
}

void PlaneTransform::inverse(ComplexPlane& plane, Size wanted) const {
  Lines columns(plane.rows);
  for (int x = 0; x < plane.columns; x += lanes) {
    const int some = std::min(lanes, plane.columns - x);
    take_columns(plane, x, some, plane.rows, columns);
    columns.transform(of_column, true);
    put_columns(columns, plane, x, some, wanted.height);
  }
  const double scale = 1.0 / static_cast<double>(plane.count());
  Lines rows(plane.columns);
  for (int y = 0; y < wanted.height; y += lanes) {
    const auto re = rows_from(y, wanted.height, [&](int row) { return plane.real_row(row); });
    const auto im = rows_from(y, wanted.height, [&](int row) { return plane.imaginary_row(row); });
    interleave(re, plane.columns, rows.re.get());
    interleave(im, plane.columns, rows.im.get());
    rows.transform(of_row, true);
    deinterleave(rows.re.get(), wanted.width, scale, re);
  }
}

void add_correlation(const ComplexPlane& image, const ComplexPlane& patch, ComplexPlane& sum, bool first) {
  HWY_DYNAMIC_DISPATCH(correlate_values)(image, patch, sum, first);
}

} // namespace tilepack
#endif
