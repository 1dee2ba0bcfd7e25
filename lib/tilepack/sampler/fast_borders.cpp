#include "tilepack/sampler/fast_borders.h"

#include "tilepack/lookup/pack_lookup.h"

#include <Imath/half.h>
#include <algorithm>
#include <array>
#include <cmath>

namespace tilepack {
namespace {

using Sum = std::array<float, 4>;

float as_float(std::uint8_t code) {
  return code;
}
float as_float(std::uint16_t code) {
  return code;
}
float as_float(float value) {
  return value;
}
float as_float(half value) {
  return value;
}

float in_256ths(float weight) {
  return std::nearbyint(weight * 256.0f) * (1.0f / 256.0f);
}

// A coordinate of a batch as cell and fraction, as the kernels settle it.
void settle(std::int32_t& tile, float& fraction, std::int64_t side) {
  const float whole = std::floor(fraction);
  const float rest = fraction - whole;
  if ((side & (side - 1)) == 0 && std::fabs(whole) < 4194304.0f && rest < 1.0f) {
    const auto cell =
        static_cast<std::uint32_t>(tile) + static_cast<std::uint32_t>(static_cast<std::int32_t>(whole));
    tile = static_cast<std::int32_t>(cell & static_cast<std::uint32_t>(side - 1));
    fraction = rest;
    return;
  }
  settle_coordinates(&tile, &fraction, 1, side);
}

// Whether a place lies half a texel or more from both borders of its tile; not for sure otherwise. By a conversion,
// which processors of any age do faster than floor.
bool well_inside(float fraction, float side) {
  if (!(std::fabs(fraction) < 4194304.0f)) return false;
  float rest = fraction - static_cast<float>(static_cast<std::int32_t>(fraction));
  if (rest < 0.0f) rest += 1.0f;
  const float position = rest * side;
  return position >= 0.5f && position <= side - 0.5f;
}

// The two texels along one axis, each with its cell; -1 is the last texel of the cell before.
struct AxisTaps {
  std::uint32_t cell[2];
  std::int32_t texel[2];
  float weight;  // of the second
  bool crossing; // they lie in two cells, and both count
};

AxisTaps taps_along(std::int32_t cell, float fraction, float side, std::int64_t cells, bool fixed) {
  float position = fraction * side - 0.5f;
  if (fixed) position = in_256ths(position);
  const float first = std::floor(position);
  const auto texels = static_cast<std::int32_t>(side);
  const auto here = static_cast<std::uint32_t>(cell);
  const auto at = static_cast<std::int32_t>(first);
  AxisTaps taps{{here, here}, {at, at + 1}, position - first, false};
  if (at < 0) {
    taps.cell[0] = cell == 0 ? static_cast<std::uint32_t>(cells - 1) : here - 1;
    taps.texel[0] = texels - 1;
    taps.crossing = taps.weight < 1.0f;
  }
  if (at + 1 >= texels) {
    taps.cell[1] = here + 1 == static_cast<std::uint64_t>(cells) ? 0 : here + 1;
    taps.texel[1] = 0;
    taps.crossing = taps.weight > 0.0f;
  }
  return taps;
}

template <typename T>
class BorderMender {
public:
  BorderMender(const FastTables& of_tables, Filter filter, Weights weights)
      : t(of_tables), texels(static_cast<const T*>(of_tables.texels)), trilinear(filter == Filter::trilinear),
        fixed(weights == Weights::fixed_8_8) {}

  void mend(const SampleBatch& batch, std::span<float* const> out) const {
    const float top = static_cast<float>(t.levels - 1);
    for (std::size_t k = 0; k < batch.count; ++k) {
      float level = batch.level ? batch.level[k] : 0.0f;
      if (!(level > 0.0f)) level = 0.0f;
      level = std::min(level, top);
      const int fine = static_cast<int>(trilinear ? level : level + 0.5f);
      const int coarse = std::min(fine + 1, t.levels - 1);
      // What lies well inside at the coarser level does so at the finer one.
      const int widest = trilinear ? coarse : fine;
      if (well_inside(batch.x[k], t.tile_width[widest]) && well_inside(batch.y[k], t.tile_height[widest]))
        continue;
      std::int32_t x = batch.tile_x ? batch.tile_x[k] : 0, y = batch.tile_y ? batch.tile_y[k] : 0;
      float fx = batch.x[k], fy = batch.y[k];
      settle(x, fx, t.width);
      settle(y, fy, t.height);
      float share = trilinear ? level - static_cast<float>(fine) : 0.0f;
      if (fixed) share = in_256ths(share);
      const AxisTaps across = taps_in(x, fx, t.tile_width[fine], t.width);
      const AxisTaps down = taps_in(y, fy, t.tile_height[fine], t.height);
      const bool two = share > 0.0f;
      AxisTaps across_2{}, down_2{};
      if (two) {
        across_2 = taps_in(x, fx, t.tile_width[coarse], t.width);
        down_2 = taps_in(y, fy, t.tile_height[coarse], t.height);
      }
      if (!across.crossing && !down.crossing && !across_2.crossing && !down_2.crossing) continue;
      Sum sum{};
      add(sum, fine, across, down, (1.0f - share) * t.unit);
      if (two) add(sum, coarse, across_2, down_2, share * t.unit);
      write(sum, k, out);
    }
  }

private:
  AxisTaps taps_in(std::int32_t cell, float fraction, float side, std::int64_t cells) const {
    return taps_along(cell, fraction, side, cells, fixed);
  }

  void add(Sum& sum, int level, const AxisTaps& across, const AxisTaps& down, float share) const {
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 2; ++i) {
        const float weight = share * (i == 0 ? 1.0f - across.weight : across.weight) *
                             (j == 0 ? 1.0f - down.weight : down.weight);
        if (weight == 0.0f) continue; // what lies there, infinity included, must not show
        const std::uint32_t place = packed_place_of_cell(*t.lookup, across.cell[i], down.cell[j]);
        const std::int32_t column =
            static_cast<std::int32_t>(place & 0xffffu) * t.pitch_x[level] + across.texel[i];
        const std::int32_t row = static_cast<std::int32_t>(place >> 16) * t.pitch_y[level] + down.texel[j];
        const T* from =
            texels + 4 * (std::ptrdiff_t{t.base[level]} + std::ptrdiff_t{row} * t.stride[level] + column);
        for (std::size_t c = 0; c < 4; ++c) sum[c] += weight * as_float(from[c]);
      }
  }

  void write(const Sum& sum, std::size_t k, std::span<float* const> out) const {
    const std::size_t last = out.size() - 1;
    const float scale = t.alpha && sum[last] > 0.0f ? 1.0f / sum[last] : 1.0f;
    for (std::size_t c = 0; c < out.size(); ++c) out[c][k] = t.alpha && c < last ? sum[c] * scale : sum[c];
  }

  const FastTables& t;
  const T* texels;
  bool trilinear;
  bool fixed;
};

} // namespace

void mend_borders(const FastTables& tables, const SampleBatch& batch, Filter filter, Weights weights,
                  std::span<float* const> out) {
  if (filter == Filter::nearest) return;
  switch (tables.storage) {
  case TexelStorage::u8:
    return BorderMender<std::uint8_t>(tables, filter, weights).mend(batch, out);
  case TexelStorage::u16:
    return BorderMender<std::uint16_t>(tables, filter, weights).mend(batch, out);
  case TexelStorage::f16:
    return BorderMender<half>(tables, filter, weights).mend(batch, out);
  case TexelStorage::f32:
    return BorderMender<float>(tables, filter, weights).mend(batch, out);
  }
}

} // namespace tilepack
