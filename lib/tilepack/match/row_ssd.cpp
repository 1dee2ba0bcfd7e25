#include "tilepack/match/row_ssd.h"

#include <algorithm>
#include <limits>

// This file is compiled once for each instruction set, by including itself.
// clang-format off
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tilepack/match/row_ssd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace tilepack {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR

class SquareSum {
public:
  void add_row(const std::uint8_t* a, const std::uint8_t* b, std::size_t bytes) {
    for (std::size_t i = 0; i < bytes; ++i) {
      const int d = static_cast<int>(a[i]) - static_cast<int>(b[i]);
      sum += d * d;
    }
  }
  int total() const { return sum; }

private:
  int sum = 0;
};

#else

// |a - b| fits a byte; widened, it is squared and added in pairs. Sums of
// integers are the same in any order.
class SquareSum {
public:
  SquareSum() : even(hn::Zero(d32)), odd(hn::Zero(d32)) {}

  HWY_INLINE void add_row(const std::uint8_t* a, const std::uint8_t* b, std::size_t bytes) {
    const std::size_t lanes = hn::Lanes(d8);
    std::size_t i = 0;
    for (; i + lanes <= bytes; i += lanes) add(hn::LoadU(d8, a + i), hn::LoadU(d8, b + i));
    if (i < bytes) {
      const auto mask = hn::FirstN(d8, bytes - i);
      add(hn::IfThenElseZero(mask, hn::LoadU(d8, a + i)), hn::IfThenElseZero(mask, hn::LoadU(d8, b + i)));
    }
  }
  HWY_INLINE int total() const { return hn::GetLane(hn::SumOfLanes(d32, hn::Add(even, odd))); }

private:
  using D8 = hn::CappedTag<std::uint8_t, 32>;
  using D16 = hn::Repartition<std::int16_t, D8>;
  using D32 = hn::Repartition<std::int32_t, D8>;
  static constexpr D8 d8{};
  static constexpr D16 d16{};
  static constexpr D32 d32{};

  HWY_INLINE void add(hn::Vec<D8> a, hn::Vec<D8> b) {
    const auto difference = hn::Or(hn::SaturatedSub(a, b), hn::SaturatedSub(b, a));
    const auto zero = hn::Zero(d8);
    const auto lower = hn::BitCast(d16, hn::InterleaveLower(d8, difference, zero));
    const auto upper = hn::BitCast(d16, hn::InterleaveUpper(d8, difference, zero));
    even = hn::ReorderWidenMulAccumulate(d32, lower, lower, even, odd);
    even = hn::ReorderWidenMulAccumulate(d32, upper, upper, even, odd);
  }

  hn::Vec<D32> even, odd; // the widening multiplication wants two
};

#endif

int difference_of_rows(const std::uint8_t* a, std::ptrdiff_t a_stride, const std::uint8_t* b,
                       std::ptrdiff_t b_stride, std::size_t bytes, int rows, int limit) {
  SquareSum sum;
  const int first = rows / 2;
  for (int y = 0; y < first; ++y, a += a_stride, b += b_stride) sum.add_row(a, b, bytes);
  if (first > 0) {
    const int half = sum.total();
    if (half >= limit) return half;
  }
  for (int y = first; y < rows; ++y, a += a_stride, b += b_stride) sum.add_row(a, b, bytes);
  return sum.total();
}

} // namespace
} // namespace HWY_NAMESPACE
} // namespace tilepack
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tilepack {

HWY_EXPORT(difference_of_rows);

int squared_difference_of_rows(const std::uint8_t* a, std::ptrdiff_t a_stride, const std::uint8_t* b,
                               std::ptrdiff_t b_stride, std::size_t bytes, int rows, int limit) {
  return HWY_DYNAMIC_DISPATCH(difference_of_rows)(a, a_stride, b, b_stride, bytes, rows, limit);
}

std::int64_t squared_difference_of_bytes(const std::uint8_t* a, const std::uint8_t* b, std::size_t bytes) {
  constexpr std::size_t whole = 64;       // a multiple of all vectors, so that none reaches past the end
  constexpr std::size_t longest = 32'768; // · 255² fits 31 bits
  std::int64_t sum = 0;
  while (bytes >= whole) {
    const std::size_t run = std::min(longest, bytes / whole * whole);
    sum += squared_difference_of_rows(a, 0, b, 0, run, 1, std::numeric_limits<int>::max());
    a += run;
    b += run;
    bytes -= run;
  }
  for (std::size_t i = 0; i < bytes; ++i) {
    const int d = static_cast<int>(a[i]) - static_cast<int>(b[i]);
    sum += d * d;
  }
  return sum;
}

} // namespace tilepack
#endif
