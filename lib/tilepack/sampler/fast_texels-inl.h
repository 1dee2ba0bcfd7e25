// From texel indices and weights to values, a vector of samples at a time. Included once for each instruction
// set, from fast_kernel.cpp.

#if defined(TILEPACK_FAST_TEXELS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TILEPACK_FAST_TEXELS_INL_H
#undef TILEPACK_FAST_TEXELS_INL_H
#else
#define TILEPACK_FAST_TEXELS_INL_H
#endif

#include "tilepack/sampler/fast_places-inl.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace tilepack {
namespace HWY_NAMESPACE {

/// Samples go through in chunks of so many: taps of a chunk are written out, then weighed one sample after
/// the other, all its channels at once. Plain loads are faster than gathers, which fetch lane by lane too and
/// are slowed down further on processors that guard against their leaks.
constexpr std::size_t chunk = 64;

struct ChunkTaps {
  HWY_ALIGN std::int32_t upper[chunk];
  HWY_ALIGN std::int32_t lower[chunk];
  HWY_ALIGN float upper_weight[chunk];
  HWY_ALIGN float lower_weight[chunk];
  HWY_ALIGN float east[chunk];

  HWY_INLINE void store(const RowTaps& taps, std::size_t at) {
    hn::Store(taps.upper, I(), upper + at);
    hn::Store(taps.lower, I(), lower + at);
    hn::Store(taps.upper_weight, F(), upper_weight + at);
    hn::Store(taps.lower_weight, F(), lower_weight + at);
    hn::Store(taps.east, F(), east + at);
  }
};

// Four floats at a time where vectors hold them, one where they don't.
using F4 = hn::CappedTag<float, 4>;
using V4 = hn::Vec<F4>;

HWY_INLINE V4 lerp(V4 west, V4 east, float share) {
  return hn::MulAdd(hn::Set(F4(), share), hn::Sub(east, west), west);
}

// The texels at `at` as floats; `D` says how many channels.
template <class D>
HWY_INLINE hn::Vec<D> load_texels(D d, const std::uint8_t* at) {
  return hn::ConvertTo(d,
                       hn::PromoteTo(hn::RebindToSigned<D>(), hn::LoadU(hn::Rebind<std::uint8_t, D>(), at)));
}
template <class D>
HWY_INLINE hn::Vec<D> load_texels(D d, const std::uint16_t* at) {
  return hn::ConvertTo(d,
                       hn::PromoteTo(hn::RebindToSigned<D>(), hn::LoadU(hn::Rebind<std::uint16_t, D>(), at)));
}
template <class D>
HWY_INLINE hn::Vec<D> load_texels(D d, const hwy::float16_t* at) {
  return hn::PromoteTo(d, hn::LoadU(hn::Rebind<hwy::float16_t, D>(), at));
}
template <class D>
HWY_INLINE hn::Vec<D> load_texels(D d, const float* at) {
  return hn::LoadU(d, at);
}

template <class D, typename T>
HWY_INLINE hn::Vec<D> rows_weighed(D d, const T* texels, const ChunkTaps& taps, std::size_t k, int skip) {
  const auto upper = load_texels(d, texels + 4 * static_cast<std::ptrdiff_t>(taps.upper[k]) + skip);
  const auto lower = load_texels(d, texels + 4 * static_cast<std::ptrdiff_t>(taps.lower[k]) + skip);
  return hn::MulAdd(lower, hn::Set(d, taps.lower_weight[k]),
                    hn::Mul(upper, hn::Set(d, taps.upper_weight[k])));
}

template <typename T>
HWY_INLINE V4 weighed_sample(const T* texels, const ChunkTaps& taps, std::size_t k) {
#if HWY_MAX_BYTES >= 32
  // West and east texel in one vector.
  const auto rows = rows_weighed(hn::FixedTag<float, 8>(), texels, taps, k, 0);
  return lerp(hn::LowerHalf(F4(), rows), hn::UpperHalf(F4(), rows), taps.east[k]);
#else
  return lerp(rows_weighed(F4(), texels, taps, k, 0), rows_weighed(F4(), texels, taps, k, 4), taps.east[k]);
#endif
}

/// Four channels of each sample of a chunk, side by side.
template <typename T>
HWY_INLINE void weigh_chunk(const T* texels, const ChunkTaps& fine, const ChunkTaps* coarse,
                            std::size_t count, float* values) {
  const F4 f4;
  constexpr std::size_t step = hn::MaxLanes(F4());
  if (coarse == nullptr) {
    for (std::size_t k = 0; k < count; ++k)
      for (std::size_t c = 0; c < 4; c += step)
        hn::Store(weighed_sample(texels + c, fine, k), f4, values + 4 * k + c);
    return;
  }
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t c = 0; c < 4; c += step)
      hn::Store(hn::Add(weighed_sample(texels + c, fine, k), weighed_sample(texels + c, *coarse, k)), f4,
                values + 4 * k + c);
}

} // namespace HWY_NAMESPACE
} // namespace tilepack
HWY_AFTER_NAMESPACE();

#endif
