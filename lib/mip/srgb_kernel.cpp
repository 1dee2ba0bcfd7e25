#include "tilepack/mip/srgb_kernel.h"

#include <cstdint>

// This file is compiled once for each instruction set, by including itself.
// clang-format off
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tilepack/mip/srgb_kernel.cpp"
#include <hwy/foreach_target.h>
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

// Comparisons are of bit patterns, as integers: so NaN and -0 need no case of their own.
HWY_INLINE VI codes_of(VF values, VI& strays) {
  const F f;
  const I i;
  const VI one = hn::Set(i, bits_of_one);
  const VI bits = hn::BitCast(i, values);
  const VI kept = hn::Min(hn::Max(bits, hn::Zero(i)), one); // below 0 the sign bit is set
  const VF scaled = hn::Mul(hn::BitCast(f, kept), hn::Set(f, 255.0f));
  const VI code = hn::ConvertTo(i, hn::Add(scaled, hn::Set(f, 0.5f)));
  const VI off = hn::BitCast(i, hn::Abs(hn::Sub(scaled, hn::ConvertTo(f, code))));
  strays = hn::Or(strays, hn::Xor(kept, bits));
  strays = hn::Or(strays, hn::VecFromMask(i, hn::Gt(off, hn::Set(i, bits_of_least_off))));
  return code;
}

int find_codes(const float* HWY_RESTRICT values, int* HWY_RESTRICT codes, std::size_t count) {
  const F f;
  const I i;
  const std::size_t lanes = hn::Lanes(f);
  VI strays = hn::Zero(i);
  std::size_t at = 0;
  for (; at + lanes <= count; at += lanes)
    hn::StoreU(codes_of(hn::LoadU(f, values + at), strays), i, codes + at);
  if (at < count) {
    HWY_ALIGN float rest[hn::MaxLanes(f)] = {}; // 0 is a code
    HWY_ALIGN int rest_codes[hn::MaxLanes(f)];
    for (std::size_t k = 0; at + k < count; ++k) rest[k] = values[at + k];
    hn::Store(codes_of(hn::Load(f, rest), strays), i, rest_codes);
    for (std::size_t k = 0; at + k < count; ++k) codes[at + k] = rest_codes[k];
  }
  return hn::AllTrue(i, hn::Eq(strays, hn::Zero(i))) ? 0 : 1;
}

template <std::size_t channels>
HWY_INLINE void halve_rows(const int* HWY_RESTRICT n, const int* HWY_RESTRICT s,
                           const float* HWY_RESTRICT linear, float* HWY_RESTRICT to, std::size_t width) {
  for (std::size_t x = 0; x < width; ++x, n += 2 * channels, s += 2 * channels, to += channels)
    for (std::size_t c = 0; c < channels; ++c)
      to[c] = ((linear[n[c]] + linear[n[c + channels]]) + (linear[s[c]] + linear[s[c + channels]])) * 0.25f;
}

void halve_codes(const int* north, const int* south, const float* linear, float* to, std::size_t width,
                 std::size_t channels) {
  if (channels == 1)
    halve_rows<1>(north, south, linear, to, width);
  else
    halve_rows<3>(north, south, linear, to, width);
}

int encode(const float* HWY_RESTRICT values, float* HWY_RESTRICT codes, std::size_t count,
           const EncodeCurve& curve) {
  const F f;
  const I i;
  const std::size_t lanes = hn::Lanes(f);
  const VI first = hn::Set(i, curve.first_bits);
  const VI last = hn::Set(i, bits_of_one - 1);
  const VI inside_piece = hn::Set(i, (1 << EncodeCurve::piece_bits) - 1);
  const VF unit = hn::Set(f, 1.0f / (1 << EncodeCurve::piece_bits));
  VI strays = hn::Zero(i);
  HWY_ALIGN int piece[SrgbKernel::block];
  HWY_ALIGN float place[SrgbKernel::block];
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
    hn::Store(hn::ShiftRight<EncodeCurve::piece_bits>(offset), i, piece + at);
    hn::Store(hn::Mul(hn::ConvertTo(f, hn::And(offset, inside_piece)), unit), f, place + at);
    strays = hn::Or(strays, hn::Xor(kept, bits));
  }
  for (std::size_t k = 0; k < count; ++k) {
    const Parabola& p = curve.pieces[piece[k]];
    codes[k] = p.a + place[k] * (p.b + place[k] * p.c);
  }
  return hn::AllTrue(i, hn::Eq(strays, hn::Zero(i))) ? 0 : 1;
}

} // namespace
} // namespace HWY_NAMESPACE
} // namespace tilepack
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tilepack {

HWY_EXPORT(find_codes);
HWY_EXPORT(halve_codes);
HWY_EXPORT(encode);

// The tables that HWY_EXPORT makes, entry by entry: which one is taken is no state of the program.
std::vector<SrgbKernel> srgb_kernels() {
  std::vector<SrgbKernel> kernels;
#if (HWY_TARGETS & (HWY_TARGETS - 1)) == 0
  kernels.push_back({hwy::TargetName(HWY_TARGETS), &HWY_STATIC_DISPATCH(find_codes),
                     &HWY_STATIC_DISPATCH(halve_codes), &HWY_STATIC_DISPATCH(encode)});
#else
  // Highway numbers its targets best first.
  for (std::int64_t left = hwy::SupportedTargets() & HWY_TARGETS; left != 0; left &= left - 1) {
    const std::int64_t target = left & -left;
    hwy::ChosenTarget chosen;
    chosen.Update(target);
    const std::size_t index = chosen.GetIndex();
    kernels.push_back({hwy::TargetName(target), HWY_DISPATCH_TABLE(find_codes)[index],
                       HWY_DISPATCH_TABLE(halve_codes)[index], HWY_DISPATCH_TABLE(encode)[index]});
  }
#endif
  return kernels;
}

} // namespace tilepack
#endif
