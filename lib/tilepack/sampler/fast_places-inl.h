// From coordinates to texel indices and weights, a vector of samples at a time. Included once for each
// instruction set, from fast_kernel.cpp.

#if defined(TILEPACK_FAST_PLACES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TILEPACK_FAST_PLACES_INL_H
#undef TILEPACK_FAST_PLACES_INL_H
#else
#define TILEPACK_FAST_PLACES_INL_H
#endif

#include "tilepack/sampler/fast_tables.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace tilepack {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr int most_lanes = 16;
using F = hn::CappedTag<float, most_lanes>;
using I = hn::RebindToSigned<F>;
using VF = hn::Vec<F>;
using VI = hn::Vec<I>;

/// Two texels in each of two rows of a level, and how they are weighed; a lane a sample.
struct RowTaps {
  VI upper;        ///< index of the west texel of the upper row; the east one is the next
  VI lower;        ///< of the lower row
  VF upper_weight; ///< the level's share and the unit of the stored codes included
  VF lower_weight;
  VF east; ///< 0..1, of the east texels
};

/// How one level is reached from a place: scalars spread over the lanes, or lanes of their own.
struct LevelPlace {
  VF width; // of a tile, in texels
  VF height;
  VI stride;
  VI origin; // index of the north-west texel of the tile
};

/// The cell and level found last. Neighbours in a batch mostly share both, so what follows from them is kept.
struct Current {
  std::int32_t x = -1;
  std::int32_t y = -1;
  std::int32_t level = -1;
  std::int32_t origin[2] = {}; // in `level` and in the next coarser
};

/// A whole number of magnitude up to 2^22, as integer: adding 1.5 * 2^23 leaves it in the low mantissa bits.
HWY_INLINE VI to_integer(VF whole) {
  const F f;
  const I i;
  const VF magic = hn::Set(f, 12582912.0f);
  return hn::Sub(hn::BitCast(i, hn::Add(whole, magic)), hn::BitCast(i, magic));
}

/// Tile + fraction → cell within the virtual texture, 0 <= fraction < 1. See normalised().
HWY_INLINE void settle(VI& tile, VF& fraction, std::int64_t side) {
  const F f;
  const I i;
  const VF whole = hn::Floor(fraction);
  const VF rest = hn::Sub(fraction, whole);
  // Out of reach: NaN and what to_integer can't hold. -1e-9 - floor(-1e-9) rounds to 1, which is no fraction.
  const auto in_reach =
      hn::And(hn::Lt(hn::Abs(whole), hn::Set(f, 4194304.0f)), hn::Lt(rest, hn::Set(f, 1.0f)));
  VI cell = hn::Add(tile, to_integer(whole));
  auto good = hn::RebindMask(i, in_reach);
  if ((side & (side - 1)) == 0) {
    cell = hn::And(cell, hn::Set(i, static_cast<std::int32_t>(side - 1)));
  } else {
    // The sum may have gone round the 32 bits where the tile is far out.
    good = hn::And(good, hn::Lt(tile, hn::Set(i, 1 << 30)));
    good = hn::And(good, hn::Gt(tile, hn::Set(i, -(1 << 30))));
    good = hn::And(good, hn::Gt(cell, hn::Set(i, -1)));
    good = hn::And(good, hn::Lt(cell, hn::Set(i, static_cast<std::int32_t>(side))));
  }
  if (HWY_UNLIKELY(!hn::AllTrue(i, good))) {
    HWY_ALIGN std::int32_t tiles[most_lanes];
    HWY_ALIGN float fractions[most_lanes];
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

/// Where the tiles of the cells lie in the pack. One cell after the other: few are different, and gathers are
/// slow on many processors.
HWY_INLINE VI places_of(const FastTables& t, VI x, VI y) {
  const I i;
  if (t.lookup == nullptr) return hn::Zero(i);
  HWY_ALIGN std::int32_t cell_x[most_lanes];
  HWY_ALIGN std::int32_t cell_y[most_lanes];
  HWY_ALIGN std::int32_t place[most_lanes];
  hn::Store(x, i, cell_x);
  hn::Store(y, i, cell_y);
  const auto place_at = [&](std::size_t k) HWY_ATTR {
    return static_cast<std::int32_t>(packed_place_of_cell(*t.lookup, static_cast<std::uint32_t>(cell_x[k]),
                                                          static_cast<std::uint32_t>(cell_y[k])));
  };
  place[0] = place_at(0);
  for (std::size_t k = 1; k < hn::Lanes(i); ++k)
    place[k] = cell_x[k] == cell_x[k - 1] && cell_y[k] == cell_y[k - 1] ? place[k - 1] : place_at(k);
  return hn::Load(i, place);
}

/// A level all lanes share.
HWY_INLINE LevelPlace shared_level(const FastTables& t, std::int32_t level, VI origin) {
  return {hn::Set(F(), t.tile_width[level]), hn::Set(F(), t.tile_height[level]),
          hn::Set(I(), t.stride[level]), origin};
}

HWY_INLINE LevelPlace level_of_each(const FastTables& t, VI place, VI level) {
  const F f;
  const I i;
  LevelPlace result;
  VI base = hn::Zero(i);
  VI pitch_x = hn::Zero(i);
  VI pitch_y = hn::Zero(i);
  const std::int32_t first = hn::GetLane(level);
  if (hn::AllTrue(i, hn::Eq(level, hn::Set(i, first)))) {
    result = shared_level(t, first, base);
    base = hn::Set(i, t.base[first]);
    pitch_x = hn::Set(i, t.pitch_x[first]);
    pitch_y = hn::Set(i, t.pitch_y[first]);
  } else {
    result = {hn::GatherIndex(f, t.tile_width, level), hn::GatherIndex(f, t.tile_height, level),
              hn::GatherIndex(i, t.stride, level), base};
    base = hn::GatherIndex(i, t.base, level);
    pitch_x = hn::GatherIndex(i, t.pitch_x, level);
    pitch_y = hn::GatherIndex(i, t.pitch_y, level);
  }
  const VI texel_x = hn::Mul(hn::And(place, hn::Set(i, 0xffff)), pitch_x);
  const VI texel_y = hn::Mul(hn::ShiftRight<16>(place), pitch_y);
  result.origin = hn::Add(base, hn::Add(hn::Mul(texel_y, result.stride), texel_x));
  return result;
}

HWY_INLINE std::int32_t last_lane(VI v) {
  HWY_ALIGN std::int32_t lanes[most_lanes];
  hn::Store(v, I(), lanes);
  return lanes[hn::Lanes(I()) - 1];
}

HWY_INLINE VF in_256ths(VF weight) {
  const F f;
  return hn::Mul(hn::Round(hn::Mul(weight, hn::Set(f, 256.0f))), hn::Set(f, 1.0f / 256.0f));
}

/// Texel and weight along one axis: see bilinear_taps() and nearest_texel().
HWY_INLINE VI taps_along(VF fraction, VF side, bool nearest, bool fixed, VF& weight) {
  const F f;
  if (HWY_UNLIKELY(nearest)) {
    weight = hn::Zero(f);
    return to_integer(hn::Min(hn::Floor(hn::Mul(fraction, side)), hn::Sub(side, hn::Set(f, 1.0f))));
  }
  VF position = hn::MulSub(fraction, side, hn::Set(f, 0.5f));
  if (fixed) position = in_256ths(position);
  const VF first = hn::Floor(position);
  weight = hn::Sub(position, first);
  return to_integer(first);
}

HWY_INLINE RowTaps taps_in(const LevelPlace& level, VF x, VF y, VF share, bool nearest, bool fixed) {
  RowTaps taps;
  VF south;
  const VI i0 = taps_along(x, level.width, nearest, fixed, taps.east);
  const VI j0 = taps_along(y, level.height, nearest, fixed, south);
  taps.upper = hn::Add(hn::Add(level.origin, i0), hn::Mul(j0, level.stride));
  taps.lower = hn::Add(taps.upper, level.stride);
  taps.lower_weight = hn::Mul(south, share);
  taps.upper_weight = hn::Sub(share, taps.lower_weight);
  return taps;
}

/// A vector of samples: tile and fraction along both axes, and the level.
struct Samples {
  VI tile_x, tile_y;
  VF x, y;
  VF level;
};

/// How a batch is looked up.
struct LookupMode {
  Filter filter;
  bool fixed; ///< weights in steps of 1/256
};

/// The texels of a vector of samples.
struct SampleTaps {
  RowTaps fine;
  RowTaps coarse;  ///< of the next level; set for trilinear filtering only
  bool two_levels; ///< whether any weight of the coarser level is above 0
};

HWY_INLINE SampleTaps find_taps(const FastTables& t, Samples at, const LookupMode& mode, Current& current) {
  const F f;
  const I i;
  settle(at.tile_x, at.x, t.width);
  settle(at.tile_y, at.y, t.height);
  const std::int32_t top = t.levels - 1;
  VF level = hn::IfThenElseZero(hn::Eq(at.level, at.level), at.level); // NaN is level 0
  level = hn::Min(hn::Max(level, hn::Zero(f)), hn::Set(f, static_cast<float>(top)));
  const bool blend = mode.filter == Filter::trilinear;
  const VF whole = hn::Floor(blend ? level : hn::Add(level, hn::Set(f, 0.5f)));
  VF weight = blend ? hn::Sub(level, whole) : hn::Zero(f);
  if (mode.fixed) weight = in_256ths(weight);
  const VI fine = to_integer(whole);

  LevelPlace fine_place, coarse_place;
  const auto same =
      hn::And(hn::And(hn::Eq(at.tile_x, hn::Set(i, current.x)), hn::Eq(at.tile_y, hn::Set(i, current.y))),
              hn::Eq(fine, hn::Set(i, current.level)));
  if (HWY_LIKELY(hn::AllTrue(i, same))) {
    const std::int32_t next = current.level < top ? current.level + 1 : top;
    fine_place = shared_level(t, current.level, hn::Set(i, current.origin[0]));
    coarse_place = shared_level(t, next, hn::Set(i, current.origin[1]));
  } else {
    const VI place = places_of(t, at.tile_x, at.tile_y);
    fine_place = level_of_each(t, place, fine);
    coarse_place = level_of_each(t, place, hn::Min(hn::Add(fine, hn::Set(i, 1)), hn::Set(i, top)));
    current = {last_lane(at.tile_x),
               last_lane(at.tile_y),
               last_lane(fine),
               {last_lane(fine_place.origin), last_lane(coarse_place.origin)}};
  }
  const bool nearest = mode.filter == Filter::nearest;
  const VF unit = hn::Set(f, t.unit);
  const VF coarse_share = hn::Mul(weight, unit);
  SampleTaps taps;
  taps.fine = taps_in(fine_place, at.x, at.y, hn::Sub(unit, coarse_share), nearest, mode.fixed);
  taps.two_levels = false;
  if (!blend) return taps;
  taps.coarse = taps_in(coarse_place, at.x, at.y, coarse_share, nearest, mode.fixed);
  taps.two_levels = !hn::AllTrue(f, hn::Eq(weight, hn::Zero(f)));
  return taps;
}

} // namespace HWY_NAMESPACE
} // namespace tilepack
HWY_AFTER_NAMESPACE();

#endif
