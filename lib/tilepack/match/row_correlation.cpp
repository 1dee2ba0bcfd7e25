#include "tilepack/match/row_correlation.h"

#include <algorithm>
#include <bit>

// This file is compiled once for each instruction set, by including itself.
// clang-format off
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tilepack/match/row_correlation.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace tilepack {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR

void correlate(const std::int16_t* data, std::span<const PairTerm> terms, std::span<std::int64_t> sums) {
  for (std::size_t i = 0; i < sums.size(); ++i)
    for (const PairTerm& term : terms) {
      const std::int16_t* pair = data + 2 * (term.index + static_cast<std::ptrdiff_t>(i));
      sums[i] += term.first * pair[0] + term.second * pair[1];
    }
}

#else

constexpr hn::CappedTag<std::int32_t, 16> d32;
constexpr hn::Repartition<std::int16_t, decltype(d32)> d16;

// The sums of a vector of places. The widening multiplication wants two accumulators, and says at the end
// how they make one.
struct Accumulator {
  HWY_INLINE Accumulator() : even(hn::Zero(d32)), odd(hn::Zero(d32)) {}

  HWY_INLINE void add(hn::Vec<decltype(d16)> pair, const std::int16_t* at) {
    even = hn::ReorderWidenMulAccumulate(d32, pair, hn::LoadU(d16, at), even, odd);
  }
  HWY_INLINE void add_to(std::int64_t* sums, std::size_t count) const {
    HWY_ALIGN std::int32_t lanes[16] = {};
    hn::Store(hn::RearrangeToOddPlusEven(even, odd), d32, lanes);
    for (std::size_t i = 0; i < count; ++i) sums[i] += lanes[i];
  }

  hn::Vec<decltype(d32)> even, odd;
};

HWY_INLINE hn::Vec<decltype(d16)> everywhere(const PairTerm& term) {
  const auto low = static_cast<std::uint16_t>(term.first);
  const auto high = static_cast<std::uint32_t>(static_cast<std::uint16_t>(term.second));
  return hn::BitCast(d16, hn::Set(d32, static_cast<std::int32_t>(low | high << 16)));
}

// So few that no sum of their products passes 31 bits.
constexpr std::size_t most_terms = 16'000;

void correlate(const std::int16_t* data, std::span<const PairTerm> terms, std::span<std::int64_t> sums) {
  const std::size_t lanes = hn::Lanes(d32);
  for (; !terms.empty(); terms = terms.subspan(std::min(terms.size(), most_terms))) {
    const auto some = terms.first(std::min(terms.size(), most_terms));
    std::size_t i = 0;
    for (; i + 3 * lanes < sums.size(); i += 4 * lanes) {
      Accumulator a, b, c, d;
      for (const PairTerm& term : some) {
        const std::int16_t* at = data + 2 * (term.index + static_cast<std::ptrdiff_t>(i));
        const auto pair = everywhere(term);
        a.add(pair, at);
        b.add(pair, at + 2 * lanes);
        c.add(pair, at + 4 * lanes);
        d.add(pair, at + 6 * lanes);
      }
      a.add_to(sums.data() + i, lanes);
      b.add_to(sums.data() + i + lanes, lanes);
      c.add_to(sums.data() + i + 2 * lanes, lanes);
      d.add_to(sums.data() + i + 3 * lanes, std::min(lanes, sums.size() - i - 3 * lanes));
    }
    for (; i < sums.size(); i += lanes) {
      Accumulator a;
      for (const PairTerm& term : some)
        a.add(everywhere(term), data + 2 * (term.index + static_cast<std::ptrdiff_t>(i)));
      a.add_to(sums.data() + i, std::min(lanes, sums.size() - i));
    }
  }
}

#endif

} // namespace
} // namespace HWY_NAMESPACE
} // namespace tilepack
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tilepack {

static_assert(std::endian::native == std::endian::little, "a pair is read as one 32-bit integer");

namespace {

constexpr std::size_t slack = 2 * 64; // what the widest vectors read past the last place

}

PairPlanes::PairPlanes(const FeatureImage& image, int place_stride)
    : height(image.height), stride(place_stride), columns((image.width + stride - 1) / stride),
      pitch(columns * stride) {
  values.assign(2 * static_cast<std::size_t>(pitch) * static_cast<std::size_t>(height) *
                        static_cast<std::size_t>(image.channels) +
                    slack,
                0);
  for (int c = 0; c < image.channels; ++c)
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < image.width; ++x) {
        std::int16_t* pair = values.data() + 2 * index(c, x, y);
        pair[0] = image.texel(x, y)[c];
        pair[1] = x + 1 < image.width ? image.texel(x + 1, y)[c] : std::int16_t{0};
      }
}

HWY_EXPORT(correlate);

void correlate_pairs(const std::int16_t* data, std::span<const PairTerm> terms,
                     std::span<std::int64_t> sums) {
  std::fill(sums.begin(), sums.end(), 0);
  HWY_DYNAMIC_DISPATCH(correlate)(data, terms, sums);
}

} // namespace tilepack
#endif
