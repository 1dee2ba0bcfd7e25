#include "tilepack/sampler/fast_kernel.h"

// This file is compiled once for each instruction set, by including itself.
// clang-format off
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tilepack/sampler/fast_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace tilepack {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// Lookups go in chunks, in three passes: find tile and texels for all (whole vectors of samples), read and
// weigh the texels (one sample after the other, all its channels at once: plain loads are faster than
// gathers), turn the results round into one array a channel.
constexpr int chunk = 64;

using F = hn::CappedTag<float, 16>;
using I = hn::RebindToSigned<F>;
using U = hn::RebindToUnsigned<F>;
using VF = hn::Vec<F>;
using VI = hn::Vec<I>;
using VU = hn::Vec<U>;

// What pass two needs of a sample: two texels in two rows of one level, and how they are weighed.
struct LevelTaps {
  HWY_ALIGN std::int32_t upper[chunk]; // index of the west texel of the upper row
  HWY_ALIGN std::int32_t lower[chunk];
  HWY_ALIGN float upper_weight[chunk];
  HWY_ALIGN float lower_weight[chunk];
  HWY_ALIGN float east_weight[chunk];
};

struct Inputs {
  HWY_ALIGN std::int32_t tile_x[chunk];
  HWY_ALIGN std::int32_t tile_y[chunk];
  HWY_ALIGN float x[chunk];
  HWY_ALIGN float y[chunk];
  HWY_ALIGN float level[chunk];
};

// The cell found last: neighbours in a batch mostly lie in the same one.
struct LastCell {
  std::int32_t x = -1;
  std::int32_t y = -1;
  std::int32_t place = 0;
};

// --- Pass one: tile, place, texels -------------------------------------------------------------------------

// Tile + fraction → cell within the virtual texture, 0 <= fraction < 1.
HWY_INLINE void settle(VI& tile, VF& fraction, std::int64_t side) {
  const F f;
  const I i;
  const VF whole = hn::Floor(fraction);
  const auto in_reach = hn::Lt(hn::Abs(fraction), hn::Set(f, 4194304.0f)); // false for NaN
  VF rest = hn::Sub(fraction, whole);
  VI cell = hn::Add(tile, hn::ConvertTo(i, whole));
  // -1e-9 - floor(-1e-9) rounds to 1: the place is the border.
  const auto on_border = hn::Ge(rest, hn::Set(f, 1.0f));
  rest = hn::IfThenZeroElse(on_border, rest);
  cell = hn::Add(cell, hn::IfThenElseZero(hn::RebindMask(i, on_border), hn::Set(i, 1)));
  auto good = hn::RebindMask(i, in_reach);
  if ((side & (side - 1)) == 0) {
    cell = hn::And(cell, hn::Set(i, static_cast<std::int32_t>(side - 1)));
  } else {
    // The sum may have gone round the 32 bits where the tile is far out.
    good = hn::And(good, hn::Lt(hn::Abs(tile), hn::Set(i, 1 << 30)));
    good = hn::And(good, hn::Gt(cell, hn::Set(i, -1)));
    good = hn::And(good, hn::Lt(cell, hn::Set(i, static_cast<std::int32_t>(side))));
  }
  if (HWY_UNLIKELY(!hn::AllTrue(i, good))) {
    HWY_ALIGN std::int32_t tiles[16];
    HWY_ALIGN float fractions[16];
    hn::Store(tile, i, tiles);
    hn::Store(fraction, f, fractions);
    settle_coordinates(tiles, fractions, static_cast<int>(hn::Lanes(f)), side);
    tile = hn::Load(i, tiles);
    fraction = hn::Load(f, fractions);
    return;
  }
  tile = cell;
  fraction = rest;
}

HWY_INLINE VU mix_round(VU v, std::uint32_t odd) {
  const U u;
  v = hn::Mul(v, hn::Set(u, odd));
  return hn::Xor(v, hn::ShiftRight<15>(v));
}

// mix_color() of mapping/mix_hash.h, lane by lane.
HWY_INLINE VI mix_colors(const MixKeys& keys, VI cell_x, VI cell_y, int colors) {
  const U u;
  const I i;
  VU x = hn::BitCast(u, cell_x);
  VU y = hn::BitCast(u, cell_y);
  y = hn::Xor(y, mix_round(hn::Add(x, hn::Set(u, keys.k[0])), 0x85ebca6bu));
  x = hn::Xor(x, mix_round(hn::Add(y, hn::Set(u, keys.k[1])), 0xc2b2ae35u));
  y = hn::Xor(y, mix_round(hn::Add(x, hn::Set(u, keys.k[2])), 0x9e3779b1u));
  x = hn::Xor(x, mix_round(hn::Add(y, hn::Set(u, keys.k[3])), 0x27d4eb2fu));
  const VU scaled = hn::Mul(hn::ShiftRight<16>(x), hn::Set(u, static_cast<std::uint32_t>(colors)));
  return hn::BitCast(i, hn::ShiftRight<16>(scaled));
}

HWY_INLINE VI next_cell(VI cell, std::int64_t side) {
  const I i;
  const VI last = hn::Set(i, static_cast<std::int32_t>(side - 1));
  return hn::IfThenZeroElse(hn::Eq(cell, last), hn::Add(cell, hn::Set(i, 1)));
}

// The number whose digits in base `colors` (alternating with `others`) are the four colors: the id of the
// tile in its complete set.
HWY_INLINE VI tile_id(VI a, VI b, VI c, VI d, int colors, int others) {
  const I i;
  VI id = hn::Add(hn::Mul(a, hn::Set(i, others)), b);
  id = hn::Add(hn::Mul(id, hn::Set(i, colors)), c);
  return hn::Add(hn::Mul(id, hn::Set(i, others)), d);
}

HWY_INLINE VI places_of(const FastTables& t, VI x, VI y) {
  using Lookup = FastTables::Lookup;
  const I i;
  if (t.lookup == Lookup::index) {
    const VI cell = hn::Add(hn::Mul(y, hn::Set(i, static_cast<std::int32_t>(t.width))), x);
    return hn::GatherIndex(i, t.places, cell);
  }
  const VI x1 = next_cell(x, t.width);
  const VI y1 = next_cell(y, t.height);
  const int kh = t.horizontal_colors;
  const int kv = t.vertical_colors;
  VI id = hn::Zero(i);
  switch (t.lookup) {
  case Lookup::permutation_edges: {
    const VI p = hn::GatherIndex(i, t.first, x);
    const VI q = hn::GatherIndex(i, t.second, y);
    id = tile_id(hn::GatherIndex(i, t.horizontal, hn::Add(p, y)),
                 hn::GatherIndex(i, t.vertical, hn::Add(x1, q)),
                 hn::GatherIndex(i, t.horizontal, hn::Add(p, y1)),
                 hn::GatherIndex(i, t.vertical, hn::Add(x, q)), kh, kv);
    break;
  }
  case Lookup::permutation_corners: {
    const VI p = hn::GatherIndex(i, t.first, x);
    const VI p1 = hn::GatherIndex(i, t.first, x1);
    id = tile_id(hn::GatherIndex(i, t.horizontal, hn::Add(p, y)),
                 hn::GatherIndex(i, t.horizontal, hn::Add(p1, y)),
                 hn::GatherIndex(i, t.horizontal, hn::Add(p, y1)),
                 hn::GatherIndex(i, t.horizontal, hn::Add(p1, y1)), kh, kh);
    break;
  }
  case Lookup::mix_edges:
    id = tile_id(mix_colors(t.horizontal_keys, x, y, kh), mix_colors(t.vertical_keys, x1, y, kv),
                 mix_colors(t.horizontal_keys, x, y1, kh), mix_colors(t.vertical_keys, x, y, kv), kh, kv);
    break;
  default: // mix_corners
    id = tile_id(mix_colors(t.horizontal_keys, x, y, kh), mix_colors(t.horizontal_keys, x1, y, kh),
                 mix_colors(t.horizontal_keys, x, y1, kh), mix_colors(t.horizontal_keys, x1, y1, kh), kh, kh);
    break;
  }
  return hn::GatherIndex(i, t.places, id);
}

// Places of a vector of cells; the whole vector in the cell found last costs next to nothing.
HWY_INLINE VI found_places(const FastTables& t, VI x, VI y, LastCell& last) {
  const I i;
  if (t.lookup == FastTables::Lookup::none) return hn::Zero(i);
  const auto same = hn::And(hn::Eq(x, hn::Set(i, last.x)), hn::Eq(y, hn::Set(i, last.y)));
  if (HWY_LIKELY(hn::AllTrue(i, same))) return hn::Set(i, last.place);
  const VI found = places_of(t, x, y);
  HWY_ALIGN std::int32_t lanes[3][16];
  hn::Store(x, i, lanes[0]);
  hn::Store(y, i, lanes[1]);
  hn::Store(found, i, lanes[2]);
  const auto end = hn::Lanes(i) - 1;
  last = {lanes[0][end], lanes[1][end], lanes[2][end]};
  return found;
}

template <typename V>
struct Axis {
  V first;
  VF weight;
};

// Texel and weight along one axis: bilinear_taps() and nearest_texel() of filter.h.
template <Filter filter, Weights weights>
HWY_INLINE Axis<VI> taps(VF fraction, VF side) {
  const F f;
  const I i;
  if (filter == Filter::nearest) {
    const VF texel = hn::Min(hn::Floor(hn::Mul(fraction, side)), hn::Sub(side, hn::Set(f, 1.0f)));
    return {hn::ConvertTo(i, texel), hn::Zero(f)};
  }
  VF position = hn::MulSub(fraction, side, hn::Set(f, 0.5f));
  if (weights == Weights::fixed_8_8)
    position = hn::Mul(hn::Round(hn::Mul(position, hn::Set(f, 256.0f))), hn::Set(f, 1.0f / 256.0f));
  const VF first = hn::Floor(position);
  return {hn::ConvertTo(i, first), hn::Sub(position, first)};
}

template <Filter filter, Weights weights>
HWY_INLINE void fill_taps(const FastTables& t, VI place, VF x, VF y, VI level, VF level_weight, int at,
                          LevelTaps& out) {
  const F f;
  const I i;
  VF width, height;
  VI base, stride;
  const std::int32_t first = hn::GetLane(level);
  if (HWY_LIKELY(hn::AllTrue(i, hn::Eq(level, hn::Set(i, first))))) {
    width = hn::Set(f, t.tile_width[first]);
    height = hn::Set(f, t.tile_height[first]);
    base = hn::Set(i, t.base[first]);
    stride = hn::Set(i, t.stride[first]);
  } else {
    width = hn::GatherIndex(f, t.tile_width, level);
    height = hn::GatherIndex(f, t.tile_height, level);
    base = hn::GatherIndex(i, t.base, level);
    stride = hn::GatherIndex(i, t.stride, level);
  }
  const auto [i0, east] = taps<filter, weights>(x, width);
  const auto [j0, south] = taps<filter, weights>(y, height);
  const VI column = hn::And(place, hn::Set(i, 0xffff));
  const VI row = hn::ShiftRight<16>(place);
  const VI one = hn::Set(i, 1); // the wrapped texel on each side
  const VI texel_x = hn::Add(hn::Mul(column, hn::ConvertTo(i, width)), hn::Add(i0, one));
  const VI texel_y = hn::Add(hn::Mul(row, hn::ConvertTo(i, height)), hn::Add(j0, one));
  const VI upper = hn::Add(base, hn::Add(hn::Mul(texel_y, stride), texel_x));
  const VF scaled = hn::Mul(level_weight, hn::Set(f, t.unit));
  const VF lower_weight = hn::Mul(south, scaled);
  hn::Store(upper, i, out.upper + at);
  hn::Store(hn::Add(upper, stride), i, out.lower + at);
  hn::Store(hn::Sub(scaled, lower_weight), f, out.upper_weight + at);
  hn::Store(lower_weight, f, out.lower_weight + at);
  hn::Store(east, f, out.east_weight + at);
}

// Returns whether any sample needs the coarser level.
template <Filter filter, Weights weights>
HWY_INLINE bool find_texels(const FastTables& t, const Inputs& in, int count, LastCell& last,
                            LevelTaps& fine_taps, LevelTaps& coarse_taps) {
  const F f;
  const I i;
  const int lanes = static_cast<int>(hn::Lanes(f));
  const VF top = hn::Set(f, static_cast<float>(t.levels - 1));
  bool two_levels = false;
  for (int at = 0; at < count; at += lanes) {
    VI cell_x = hn::Load(i, in.tile_x + at);
    VI cell_y = hn::Load(i, in.tile_y + at);
    VF x = hn::Load(f, in.x + at);
    VF y = hn::Load(f, in.y + at);
    settle(cell_x, x, t.width);
    settle(cell_y, y, t.height);
    const VI place = found_places(t, cell_x, cell_y, last);

    VF level = hn::Load(f, in.level + at);
    level = hn::IfThenElseZero(hn::Eq(level, level), level); // NaN is level 0
    level = hn::Min(hn::Max(level, hn::Zero(f)), top);
    if (filter != Filter::trilinear) {
      const VI rounded = hn::ConvertTo(i, hn::Floor(hn::Add(level, hn::Set(f, 0.5f))));
      fill_taps<filter, weights>(t, place, x, y, rounded, hn::Set(f, 1.0f), at, fine_taps);
      continue;
    }
    const VF fine = hn::Floor(level);
    VF weight = hn::Sub(level, fine);
    if (weights == Weights::fixed_8_8)
      weight = hn::Mul(hn::Round(hn::Mul(weight, hn::Set(f, 256.0f))), hn::Set(f, 1.0f / 256.0f));
    fill_taps<filter, weights>(t, place, x, y, hn::ConvertTo(i, fine), hn::Sub(hn::Set(f, 1.0f), weight), at,
                               fine_taps);
    if (hn::AllTrue(f, hn::Eq(weight, hn::Zero(f))) && !two_levels) continue;
    if (!two_levels && at > 0) {
      // The vectors before had no use for the coarser level: let them read any texel, with weight 0.
      for (int k = 0; k < at; k += lanes) {
        hn::Store(hn::Zero(i), i, coarse_taps.upper + k);
        hn::Store(hn::Zero(i), i, coarse_taps.lower + k);
        hn::Store(hn::Zero(f), f, coarse_taps.upper_weight + k);
        hn::Store(hn::Zero(f), f, coarse_taps.lower_weight + k);
        hn::Store(hn::Zero(f), f, coarse_taps.east_weight + k);
      }
    }
    two_levels = true;
    const VF coarse = hn::Min(hn::Add(fine, hn::Set(f, 1.0f)), top);
    fill_taps<filter, weights>(t, place, x, y, hn::ConvertTo(i, coarse), weight, at, coarse_taps);
  }
  return two_levels;
}

// --- Pass two: texels ------------------------------------------------------------------------------------

#if HWY_TARGET == HWY_SCALAR

HWY_INLINE float as_float(hwy::float16_t value) {
  const hn::CappedTag<hwy::float16_t, 1> half;
  return hn::GetLane(hn::PromoteTo(hn::CappedTag<float, 1>(), hn::LoadU(half, &value)));
}
template <typename T>
HWY_INLINE float as_float(T value) {
  return static_cast<float>(value);
}

template <typename T>
HWY_INLINE void add_level(const T* texels, const LevelTaps& taps, int k, float* rgba) {
  const T* upper = texels + 4 * static_cast<std::ptrdiff_t>(taps.upper[k]);
  const T* lower = texels + 4 * static_cast<std::ptrdiff_t>(taps.lower[k]);
  for (int c = 0; c < 4; ++c) {
    const float west = as_float(upper[c]) * taps.upper_weight[k] + as_float(lower[c]) * taps.lower_weight[k];
    const float east =
        as_float(upper[c + 4]) * taps.upper_weight[k] + as_float(lower[c + 4]) * taps.lower_weight[k];
    rgba[c] += west + taps.east_weight[k] * (east - west);
  }
}

template <typename T>
HWY_INLINE void weigh_texels(const void* block, const LevelTaps& fine, const LevelTaps* coarse, int count,
                             float* rgba) {
  const T* texels = static_cast<const T*>(block);
  for (int k = 0; k < count; ++k) {
    for (int c = 0; c < 4; ++c) rgba[4 * k + c] = 0.0f;
    add_level(texels, fine, k, rgba + 4 * k);
    if (coarse != nullptr) add_level(texels, *coarse, k, rgba + 4 * k);
  }
}

#else

using F4 = hn::FixedTag<float, 4>;
using V4 = hn::Vec<F4>;

#if HWY_MAX_BYTES >= 32

// Two neighbouring texels, four channels each, as floats.

using F8 = hn::FixedTag<float, 8>;
using Pair = hn::Vec<F8>;

HWY_INLINE Pair load_pair(const std::uint8_t* at) {
  return hn::ConvertTo(
      F8(), hn::PromoteTo(hn::RebindToSigned<F8>(), hn::LoadU(hn::Rebind<std::uint8_t, F8>(), at)));
}
HWY_INLINE Pair load_pair(const std::uint16_t* at) {
  return hn::ConvertTo(
      F8(), hn::PromoteTo(hn::RebindToSigned<F8>(), hn::LoadU(hn::Rebind<std::uint16_t, F8>(), at)));
}
HWY_INLINE Pair load_pair(const hwy::float16_t* at) {
  return hn::PromoteTo(F8(), hn::LoadU(hn::Rebind<hwy::float16_t, F8>(), at));
}
HWY_INLINE Pair load_pair(const float* at) {
  return hn::LoadU(F8(), at);
}

template <typename T>
HWY_INLINE V4 weighed(const T* texels, const LevelTaps& taps, int k) {
  const F8 f8;
  const F4 f4;
  const Pair upper = load_pair(texels + 4 * static_cast<std::ptrdiff_t>(taps.upper[k]));
  const Pair lower = load_pair(texels + 4 * static_cast<std::ptrdiff_t>(taps.lower[k]));
  const Pair rows =
      hn::MulAdd(lower, hn::Set(f8, taps.lower_weight[k]), hn::Mul(upper, hn::Set(f8, taps.upper_weight[k])));
  const V4 west = hn::LowerHalf(f4, rows);
  const V4 east = hn::UpperHalf(f4, rows);
  return hn::MulAdd(hn::Set(f4, taps.east_weight[k]), hn::Sub(east, west), west);
}

#else

HWY_INLINE V4 load_texel(const std::uint8_t* at) {
  return hn::ConvertTo(
      F4(), hn::PromoteTo(hn::RebindToSigned<F4>(), hn::LoadU(hn::Rebind<std::uint8_t, F4>(), at)));
}
HWY_INLINE V4 load_texel(const std::uint16_t* at) {
  return hn::ConvertTo(
      F4(), hn::PromoteTo(hn::RebindToSigned<F4>(), hn::LoadU(hn::Rebind<std::uint16_t, F4>(), at)));
}
HWY_INLINE V4 load_texel(const hwy::float16_t* at) {
  return hn::PromoteTo(F4(), hn::LoadU(hn::Rebind<hwy::float16_t, F4>(), at));
}
HWY_INLINE V4 load_texel(const float* at) {
  return hn::LoadU(F4(), at);
}

template <typename T>
HWY_INLINE V4 weighed(const T* texels, const LevelTaps& taps, int k) {
  const F4 f4;
  const T* upper = texels + 4 * static_cast<std::ptrdiff_t>(taps.upper[k]);
  const T* lower = texels + 4 * static_cast<std::ptrdiff_t>(taps.lower[k]);
  const V4 upper_weight = hn::Set(f4, taps.upper_weight[k]);
  const V4 lower_weight = hn::Set(f4, taps.lower_weight[k]);
  const V4 west = hn::MulAdd(load_texel(lower), lower_weight, hn::Mul(load_texel(upper), upper_weight));
  const V4 east =
      hn::MulAdd(load_texel(lower + 4), lower_weight, hn::Mul(load_texel(upper + 4), upper_weight));
  return hn::MulAdd(hn::Set(f4, taps.east_weight[k]), hn::Sub(east, west), west);
}

#endif

template <typename T>
HWY_INLINE void weigh_texels(const void* block, const LevelTaps& fine, const LevelTaps* coarse, int count,
                             float* rgba) {
  const F4 f4;
  const T* texels = static_cast<const T*>(block);
  if (coarse == nullptr) {
    for (int k = 0; k < count; ++k) hn::Store(weighed(texels, fine, k), f4, rgba + 4 * k);
    return;
  }
  for (int k = 0; k < count; ++k)
    hn::Store(hn::Add(weighed(texels, fine, k), weighed(texels, *coarse, k)), f4, rgba + 4 * k);
}

#endif

// --- Pass three: one array a channel -----------------------------------------------------------------------

HWY_INLINE void store_channels(const FastTables& t, const float* rgba, int count, float* const* out) {
  const F f;
  for (int at = 0; at < count; at += static_cast<int>(hn::Lanes(f))) {
    VF c[4];
    hn::LoadInterleaved4(f, rgba + 4 * at, c[0], c[1], c[2], c[3]);
    if (t.alpha) {
      const VF coverage = c[t.channels - 1];
      const auto seen = hn::Gt(coverage, hn::Zero(f));
      const VF share = hn::Div(hn::Set(f, 1.0f), hn::IfThenElse(seen, coverage, hn::Set(f, 1.0f)));
      for (int k = 0; k < t.channels - 1; ++k) c[k] = hn::Mul(c[k], share);
    }
    for (int k = 0; k < t.channels; ++k) hn::StoreU(c[k], f, out[k] + at);
  }
}

// --- The three together ------------------------------------------------------------------------------------

template <Filter filter, Weights weights>
void look_up_chunks(const FastTables& t, const SampleBatch& batch, float* const* out) {
  Inputs in;
  LevelTaps fine;
  LevelTaps coarse;
  LastCell last;
  HWY_ALIGN float rgba[4 * chunk];
  HWY_ALIGN float rest[4][chunk]; // results of a last chunk that is not full
  for (std::size_t start = 0; start < batch.count; start += chunk) {
    const int count = batch.count - start < chunk ? static_cast<int>(batch.count - start) : chunk;
    // Copied, so that missing arrays and ends of arrays need no second code; it costs less than a cycle a
    // sample.
    for (int k = 0; k < count; ++k) {
      const std::size_t s = start + static_cast<std::size_t>(k);
      in.x[k] = batch.x[s];
      in.y[k] = batch.y[s];
      in.tile_x[k] = batch.tile_x == nullptr ? 0 : batch.tile_x[s];
      in.tile_y[k] = batch.tile_y == nullptr ? 0 : batch.tile_y[s];
      in.level[k] = batch.level == nullptr ? 0.0f : batch.level[s];
    }
    for (int k = count; k < chunk; ++k) {
      in.x[k] = in.x[count - 1];
      in.y[k] = in.y[count - 1];
      in.tile_x[k] = in.tile_x[count - 1];
      in.tile_y[k] = in.tile_y[count - 1];
      in.level[k] = in.level[count - 1];
    }
    const bool two_levels = find_texels<filter, weights>(t, in, chunk, last, fine, coarse);
    const LevelTaps* const second = two_levels ? &coarse : nullptr;
    switch (t.storage) {
    case TexelStorage::u8:
      weigh_texels<std::uint8_t>(t.texels, fine, second, chunk, rgba);
      break;
    case TexelStorage::u16:
      weigh_texels<std::uint16_t>(t.texels, fine, second, chunk, rgba);
      break;
    case TexelStorage::f16:
      weigh_texels<hwy::float16_t>(t.texels, fine, second, chunk, rgba);
      break;
    case TexelStorage::f32:
      weigh_texels<float>(t.texels, fine, second, chunk, rgba);
      break;
    }
    float* targets[4];
    for (int c = 0; c < t.channels; ++c) targets[c] = count == chunk ? out[c] + start : rest[c];
    store_channels(t, rgba, chunk, targets);
    if (count < chunk)
      for (int c = 0; c < t.channels; ++c)
        for (int k = 0; k < count; ++k) out[c][start + static_cast<std::size_t>(k)] = rest[c][k];
  }
}

void look_up(const FastTables& t, const SampleBatch& batch, Filter filter, Weights weights,
             float* const* out) {
  const bool exact = weights == Weights::exact;
  switch (filter) {
  case Filter::nearest:
    return look_up_chunks<Filter::nearest, Weights::exact>(t, batch, out);
  case Filter::bilinear:
    return exact ? look_up_chunks<Filter::bilinear, Weights::exact>(t, batch, out)
                 : look_up_chunks<Filter::bilinear, Weights::fixed_8_8>(t, batch, out);
  case Filter::trilinear:
    return exact ? look_up_chunks<Filter::trilinear, Weights::exact>(t, batch, out)
                 : look_up_chunks<Filter::trilinear, Weights::fixed_8_8>(t, batch, out);
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
