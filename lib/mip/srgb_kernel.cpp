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

void find_codes(const float* HWY_RESTRICT values, std::uint8_t* HWY_RESTRICT codes, std::size_t count,
                VI& strays) {
  const F f;
  const hn::Rebind<std::uint8_t, I> bytes;
  const std::size_t lanes = hn::Lanes(f);
  std::size_t at = 0;
  for (; at + lanes <= count; at += lanes)
    hn::StoreU(hn::DemoteTo(bytes, codes_of(hn::LoadU(f, values + at), strays)), bytes, codes + at);
  if (at == count) return;
  HWY_ALIGN float rest[hn::MaxLanes(f)] = {}; // 0 is a code
  HWY_ALIGN std::uint8_t rest_codes[hn::MaxLanes(f)];
  for (std::size_t k = 0; at + k < count; ++k) rest[k] = values[at + k];
  hn::StoreU(hn::DemoteTo(bytes, codes_of(hn::Load(f, rest), strays)), bytes, rest_codes);
  for (std::size_t k = 0; at + k < count; ++k) codes[at + k] = rest_codes[k];
}

template <std::size_t channels>
HWY_INLINE void halve_codes(const std::uint8_t* HWY_RESTRICT n, const std::uint8_t* HWY_RESTRICT s,
                            const float* HWY_RESTRICT linear, float* HWY_RESTRICT to, std::size_t width) {
  for (std::size_t x = 0; x < width; ++x, n += 2 * channels, s += 2 * channels, to += channels)
    for (std::size_t c = 0; c < channels; ++c)
      to[c] = ((linear[n[c]] + linear[n[c + channels]]) + (linear[s[c]] + linear[s[c + channels]])) * 0.25f;
}

// So many texels at a time that their codes stay in the nearest cache.
constexpr std::size_t run = 256;

int halve(const float* north, const float* south, const float* linear, float* to, std::size_t width,
          std::size_t channels) {
  const I i;
  VI strays = hn::Zero(i);
  std::uint8_t codes[2][2 * 3 * run];
  for (std::size_t x = 0; x < width; x += run) {
    const std::size_t texels = width - x < run ? width - x : run;
    find_codes(north + 2 * channels * x, codes[0], 2 * channels * texels, strays);
    find_codes(south + 2 * channels * x, codes[1], 2 * channels * texels, strays);
    if (channels == 1)
      halve_codes<1>(codes[0], codes[1], linear, to + x, texels);
    else
      halve_codes<3>(codes[0], codes[1], linear, to + 3 * x, texels);
  }
  return hn::AllTrue(i, hn::Eq(strays, hn::Zero(i))) ? 0 : 1;
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
