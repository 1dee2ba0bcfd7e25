#include "tilepack/sampler/fast_kernel.h"

// This file is compiled once for each instruction set, by including itself.
// clang-format off
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tilepack/sampler/fast_kernel.cpp"
#include <hwy/foreach_target.h>
#include "tilepack/sampler/fast_places-inl.h"
#include "tilepack/sampler/fast_texels-inl.h"
#include <hwy/highway.h>
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace tilepack {
namespace HWY_NAMESPACE {
namespace {

/// The last samples of a batch, filled up to a chunk by repeating the last one.
struct Padded {
  std::int32_t tile_x[chunk];
  std::int32_t tile_y[chunk];
  float x[chunk];
  float y[chunk];
  float level[chunk];

  Padded(const SampleBatch& batch, std::size_t start) {
    for (std::size_t k = 0; k < chunk; ++k) {
      const std::size_t s = start + k < batch.count ? start + k : batch.count - 1;
      tile_x[k] = batch.tile_x == nullptr ? 0 : batch.tile_x[s];
      tile_y[k] = batch.tile_y == nullptr ? 0 : batch.tile_y[s];
      x[k] = batch.x[s];
      y[k] = batch.y[s];
      level[k] = batch.level == nullptr ? 0.0f : batch.level[s];
    }
  }
};

// Values are premultiplied; where alpha is 0, so are they.
HWY_INLINE void divide_by_alpha(int channels, VF (&values)[4]) {
  const F f;
  const VF alpha = values[channels - 1];
  const auto seen = hn::Gt(alpha, hn::Zero(f));
  const VF share = hn::Div(hn::Set(f, 1.0f), hn::IfThenElse(seen, alpha, hn::Set(f, 1.0f)));
  for (int c = 0; c < channels - 1; ++c) values[c] = hn::Mul(values[c], share);
}

// batch.count: at most a chunk, whole vectors.
template <typename T>
HWY_INLINE void look_up_chunk(const FastTables& t, const SampleBatch& batch, const LookupMode& mode,
                              Current& current, float* const* out) {
  const F f;
  const I i;
  ChunkTaps fine, coarse;
  HWY_ALIGN float rgba[4 * chunk];
  bool two_levels = false;
  for (std::size_t at = 0; at < batch.count; at += hn::Lanes(f)) {
    const Samples samples{batch.tile_x == nullptr ? hn::Zero(i) : hn::LoadU(i, batch.tile_x + at),
                          batch.tile_y == nullptr ? hn::Zero(i) : hn::LoadU(i, batch.tile_y + at),
                          hn::LoadU(f, batch.x + at), hn::LoadU(f, batch.y + at),
                          batch.level == nullptr ? hn::Zero(f) : hn::LoadU(f, batch.level + at)};
    const SampleTaps taps = find_taps(t, samples, mode, current);
    two_levels |= taps.two_levels;
    fine.store(taps.fine, at);
    if (mode.filter == Filter::trilinear) coarse.store(taps.coarse, at);
  }
  weigh_chunk(static_cast<const T*>(t.texels), fine, two_levels ? &coarse : nullptr, batch.count, rgba);
  for (std::size_t at = 0; at < batch.count; at += hn::Lanes(f)) {
    VF values[4];
    hn::LoadInterleaved4(f, rgba + 4 * at, values[0], values[1], values[2], values[3]);
    if (t.alpha) divide_by_alpha(t.channels, values);
    for (int c = 0; c < t.channels; ++c) hn::StoreU(values[c], f, out[c] + at);
  }
}

template <typename T>
void look_up_as(const FastTables& t, const SampleBatch& batch, Filter filter, Weights weights,
                float* const* out) {
  const LookupMode mode{filter, weights == Weights::fixed_8_8 && filter != Filter::nearest};
  Current current;
  std::size_t start = 0;
  for (; batch.count - start >= chunk; start += chunk) {
    const auto from = [start](const auto* array)
                          HWY_ATTR { return array == nullptr ? array : array + start; };
    const SampleBatch part{chunk,         from(batch.tile_x), from(batch.tile_y),
                           from(batch.x), from(batch.y),      from(batch.level)};
    float* targets[4] = {};
    for (int c = 0; c < t.channels; ++c) targets[c] = out[c] + start;
    look_up_chunk<T>(t, part, mode, current, targets);
  }
  if (start == batch.count) return;
  const Padded rest(batch, start);
  HWY_ALIGN float values[4][chunk];
  float* targets[4] = {values[0], values[1], values[2], values[3]};
  look_up_chunk<T>(t, {chunk, rest.tile_x, rest.tile_y, rest.x, rest.y, rest.level}, mode, current, targets);
  for (int c = 0; c < t.channels; ++c)
    for (std::size_t k = 0; start + k < batch.count; ++k) out[c][start + k] = values[c][k];
}

void look_up(const FastTables& t, const SampleBatch& batch, Filter filter, Weights weights,
             float* const* out) {
  switch (t.storage) {
  case TexelStorage::u8:
    return look_up_as<std::uint8_t>(t, batch, filter, weights, out);
  case TexelStorage::u16:
    return look_up_as<std::uint16_t>(t, batch, filter, weights, out);
  case TexelStorage::f16:
    return look_up_as<hwy::float16_t>(t, batch, filter, weights, out);
  case TexelStorage::f32:
    return look_up_as<float>(t, batch, filter, weights, out);
  }
}

} // namespace
} // namespace HWY_NAMESPACE
} // namespace tilepack
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tilepack {

HWY_EXPORT(look_up);

// The table that HWY_EXPORT makes, entry by entry: the choice is the sampler's own and no state of the
// program.
std::vector<FastKernel> fast_kernels() {
  std::vector<FastKernel> kernels;
#if (HWY_TARGETS & (HWY_TARGETS - 1)) == 0
  kernels.push_back({hwy::TargetName(HWY_TARGETS), &HWY_STATIC_DISPATCH(look_up)});
#else
  // Highway numbers its targets best first.
  for (std::int64_t left = hwy::SupportedTargets() & HWY_TARGETS; left != 0; left &= left - 1) {
    const std::int64_t target = left & -left;
    hwy::ChosenTarget chosen;
    chosen.Update(target);
    kernels.push_back({hwy::TargetName(target), HWY_DISPATCH_TABLE(look_up)[chosen.GetIndex()]});
  }
#endif
  return kernels;
}

} // namespace tilepack
#endif
