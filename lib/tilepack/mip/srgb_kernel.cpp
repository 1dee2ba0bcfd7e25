#include "tilepack/mip/srgb_kernel.h"

#include <cstdint>
#include <cstring>

// This file is compiled once for each instruction set, by including itself.
// clang-format off
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tilepack/mip/srgb_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/cache_control.h>
#include <hwy/highway.h>
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace tilepack {
namespace HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

using F = hn::ScalableTag<float>;
using I = hn::RebindToSigned<F>;
using VF = hn::Vec<F>;
using VI = hn::Vec<I>;

constexpr int bits_of_one = 0x3f800000;
constexpr int bits_of_least_off = 0x38d1b717; // 1e-4, in codes; a code's own rounding is below 2e-5

// Table look-ups are left to plain loads: gathers fetch lane by lane too, and slower on processors that guard
// against their leaks. All arithmetic is done in single steps, never fused, so every target rounds alike.

// What is wrong with values taken for codes: bits cut off, and the bits of the largest distance from a code.
struct Strays {
  VI cut;
  VI off;
};

// Comparisons are of bit patterns, as integers: so NaN and -0 need no case of their own. To a number below
// 2^23, 2^23 adds itself and rounds: the last bits of the sum are the nearest integer.
HWY_INLINE VI codes_of(VF values, Strays& strays) {
  const F f;
  const I i;
  const VF to_integer = hn::Set(f, 8388608.0f);
  const VI bits = hn::BitCast(i, values);
  const VI kept = hn::Min(hn::Max(bits, hn::Zero(i)), hn::Set(i, bits_of_one)); // below 0 the sign bit is set
  const VF scaled = hn::Mul(hn::BitCast(f, kept), hn::Set(f, 255.0f));
  const VF sum = hn::Add(scaled, to_integer);
  const VF off = hn::Abs(hn::Sub(scaled, hn::Sub(sum, to_integer)));
  strays.cut = hn::Or(strays.cut, hn::Xor(kept, bits));
  strays.off = hn::Max(strays.off, hn::BitCast(i, off));
  return hn::And(hn::BitCast(i, sum), hn::Set(i, 255));
}

void find_codes(const float* HWY_RESTRICT values, std::uint8_t* HWY_RESTRICT codes, std::size_t count,
                Strays& strays) {
  const F f;
  const hn::Rebind<std::uint8_t, I> bytes;
  const std::size_t lanes = hn::Lanes(f);
  Strays found = strays; // in registers
  std::size_t at = 0;
  for (; at + lanes <= count; at += lanes) {
    // The next run's, which memory delivers while this one's codes are looked up.
    hwy::Prefetch(values + at + count);
    hn::StoreU(hn::DemoteTo(bytes, codes_of(hn::LoadU(f, values + at), found)), bytes, codes + at);
  }
  if (at < count) {
    HWY_ALIGN float rest[hn::MaxLanes(f)] = {}; // 0 is a code
    HWY_ALIGN std::uint8_t rest_codes[hn::MaxLanes(f)];
    for (std::size_t k = 0; at + k < count; ++k) rest[k] = values[at + k];
    hn::StoreU(hn::DemoteTo(bytes, codes_of(hn::Load(f, rest), found)), bytes, rest_codes);
    for (std::size_t k = 0; at + k < count; ++k) codes[at + k] = rest_codes[k];
  }
  strays = found;
}

template <std::size_t channels>
HWY_INLINE void halve_codes(const std::uint8_t* HWY_RESTRICT n, const std::uint8_t* HWY_RESTRICT s,
                            const float* HWY_RESTRICT linear, float* HWY_RESTRICT to, std::size_t width) {
  for (std::size_t x = 0; x < width; ++x, n += 2 * channels, s += 2 * channels, to += channels)
    for (std::size_t c = 0; c < channels; ++c)
      to[c] = ((linear[n[c]] + linear[n[c + channels]]) + (linear[s[c]] + linear[s[c + channels]])) * 0.25f;
}

template <std::size_t channels>
HWY_INLINE void halve_codes_by_alpha(const std::uint8_t* HWY_RESTRICT n, const std::uint8_t* HWY_RESTRICT s,
                                     const float* HWY_RESTRICT north, const float* HWY_RESTRICT south,
                                     const float* HWY_RESTRICT linear, float* HWY_RESTRICT to,
                                     std::size_t width) {
  constexpr std::size_t alpha = channels - 1;
  constexpr std::size_t two = 2 * channels;
  for (std::size_t x = 0; x < width; ++x, n += two, s += two, north += two, south += two, to += channels) {
    const float nw = north[alpha];
    const float ne = north[alpha + channels];
    const float sw = south[alpha];
    const float se = south[alpha + channels];
    const float sum = (nw + ne) + (sw + se);
    for (std::size_t c = 0; c < alpha; ++c) {
      const float a = linear[n[c]];
      const float b = linear[n[c + channels]];
      const float d = linear[s[c]];
      const float e = linear[s[c + channels]];
      to[c] = sum > 0.0f ? ((nw * a + ne * b) + (sw * d + se * e)) / sum : ((a + b) + (d + e)) * 0.25f;
    }
    to[alpha] = sum * 0.25f;
  }
}

// So many texels at a time that their codes stay in the nearest cache.
constexpr std::size_t run = 256;

int halve(const float* north, const float* south, const float* linear, float* to, std::size_t width,
          std::size_t channels) {
  const I i;
  Strays strays{hn::Zero(i), hn::Zero(i)};
  std::uint8_t codes[2][2 * 4 * run];
  for (std::size_t x = 0; x < width; x += run) {
    const std::size_t texels = width - x < run ? width - x : run;
    const float* n = north + 2 * channels * x;
    const float* s = south + 2 * channels * x;
    find_codes(n, codes[0], 2 * channels * texels, strays);
    find_codes(s, codes[1], 2 * channels * texels, strays);
    if (channels == 1)
      halve_codes<1>(codes[0], codes[1], linear, to + x, texels);
    else if (channels == 2)
      halve_codes_by_alpha<2>(codes[0], codes[1], n, s, linear, to + 2 * x, texels);
    else if (channels == 3)
      halve_codes<3>(codes[0], codes[1], linear, to + 3 * x, texels);
    else
      halve_codes_by_alpha<4>(codes[0], codes[1], n, s, linear, to + 4 * x, texels);
  }
  const bool are_codes = hn::AllTrue(i, hn::Eq(strays.cut, hn::Zero(i))) &&
                         hn::AllFalse(i, hn::Gt(strays.off, hn::Set(i, bits_of_least_off)));
  return are_codes ? 0 : 1;
}

int encode(const float* HWY_RESTRICT values, float* HWY_RESTRICT codes, std::size_t count,
           const EncodeCurve& curve) {
  const F f;
  const I i;
  const std::size_t lanes = hn::Lanes(f);
  const VI first = hn::Set(i, curve.first_bits);
  const VI last = hn::Set(i, bits_of_one - 1);
  const VI inside_piece = hn::Set(i, (1 << EncodeCurve::piece_bits) - 1);
  constexpr int to_bytes = EncodeCurve::piece_bits - 4;
  static_assert(sizeof(Parabola) == 1 << 4);
  const VI whole_pieces = hn::Set(i, -(1 << 4));
  const VF unit = hn::Set(f, 1.0f / (1 << EncodeCurve::piece_bits));
  VI strays = hn::Zero(i);
  HWY_ALIGN int start[SrgbKernel::block]; // of a value's piece, in bytes
  HWY_ALIGN float place[SrgbKernel::block];
  static_assert(SrgbKernel::block % hn::MaxLanes(f) == 0);
  for (std::size_t at = 0; at < count; at += lanes) {
    VI bits = first;
    if (HWY_LIKELY(at + lanes <= count)) {
      bits = hn::BitCast(i, hn::LoadU(f, values + at));
    } else {
      HWY_ALIGN float rest[hn::MaxLanes(f)];
      for (std::size_t k = 0; k < lanes; ++k) rest[k] = at + k < count ? values[at + k] : 0.5f;
      bits = hn::BitCast(i, hn::Load(f, rest));
    }
    const VI kept = hn::Min(hn::Max(bits, first), last);
    const VI offset = hn::Sub(kept, first);
    hn::Store(hn::And(hn::ShiftRight<to_bytes>(offset), whole_pieces), i, start + at);
    hn::Store(hn::Mul(hn::ConvertTo(f, hn::And(offset, inside_piece)), unit), f, place + at);
    strays = hn::Or(strays, hn::Xor(kept, bits));
  }
  HWY_ALIGN Parabola fetched[SrgbKernel::block];
  const std::size_t whole = (count + lanes - 1) / lanes * lanes;
  HWY_UNROLL(8)
  for (std::size_t k = 0; k < whole; ++k)
    std::memcpy(&fetched[k], reinterpret_cast<const char*>(curve.pieces) + start[k], sizeof(Parabola));
  for (std::size_t at = 0; at < whole; at += lanes) {
    VF a, b, c, unused;
    hn::LoadInterleaved4(f, &fetched[at].a, a, b, c, unused);
    const VF t = hn::Load(f, place + at);
    hn::StoreU(hn::Add(a, hn::Mul(t, hn::Add(b, hn::Mul(t, c)))), f, codes + at);
  }
  return hn::AllTrue(i, hn::Eq(strays, hn::Zero(i))) ? 0 : 1;
}

} // namespace
} // namespace HWY_NAMESPACE
} // namespace tilepack
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tilepack {

HWY_EXPORT(halve);
HWY_EXPORT(encode);

// The tables that HWY_EXPORT makes, entry by entry: which one is taken is no state of the program.
std::vector<SrgbKernel> srgb_kernels() {
  std::vector<SrgbKernel> kernels;
#if (HWY_TARGETS & (HWY_TARGETS - 1)) == 0
  kernels.push_back(
      {hwy::TargetName(HWY_TARGETS), &HWY_STATIC_DISPATCH(halve), &HWY_STATIC_DISPATCH(encode)});
#else
  // Highway numbers its targets best first.
  for (std::int64_t left = hwy::SupportedTargets() & HWY_TARGETS; left != 0; left &= left - 1) {
    const std::int64_t target = left & -left;
    hwy::ChosenTarget chosen;
    chosen.Update(target);
    const std::size_t index = chosen.GetIndex();
    kernels.push_back(
        {hwy::TargetName(target), HWY_DISPATCH_TABLE(halve)[index], HWY_DISPATCH_TABLE(encode)[index]});
  }
#endif
  return kernels;
}

} // namespace tilepack
#endif
