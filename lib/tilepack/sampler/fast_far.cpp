#include "tilepack/sampler/fast_far.h"

#include "tilepack/lookup/pack_lookup.h"
#include "tilepack/tileset/value_space.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tilepack {

FastFar::FastFar(const Pack& pack, int map_index)
    : tile_levels(pack.tile_levels), layered(pack.layout.kind == LayoutKind::array) {
  const PackedMap& map = pack.maps[static_cast<std::size_t>(map_index)];
  alpha = value_space(map).has_alpha();
  columns = static_cast<float>(pack.layout.columns);
  rows = static_cast<float>(pack.layout.rows);
  const auto within_layer = [&](int tile, float& begin, float& part) {
    const auto side = static_cast<float>(tile + 2 * pack.layout.border);
    begin = static_cast<float>(pack.layout.border) / side;
    part = static_cast<float>(tile) / side;
  };
  within_layer(pack.tile_size.width, begin_x, part_x);
  within_layer(pack.tile_size.height, begin_y, part_y);
  for (const Image& stored : map.far_levels) {
    const Image image = to_linear(stored, map.encoding);
    Level& level = levels.emplace_back();
    level.width = image.width();
    level.height = image.height() / (layered ? pack.layout.rows : 1);
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x) {
        const auto texel = image.texel(x, y);
        for (std::size_t c = 0; c < 4; ++c) {
          const float value = c < texel.size() ? texel[c] : 0.0f;
          level.texels.push_back(alpha && c + 1 < texel.size() ? value * texel.back() : value);
        }
      }
  }
}

void FastFar::add(Value& sum, const Level& level, float u, float v, int layer, float share) const {
  const float x = u * static_cast<float>(level.width) - 0.5f, y = v * static_cast<float>(level.height) - 0.5f;
  const float west = std::floor(x), north = std::floor(y);
  // One texel beyond the texture at most: there it repeats, and a layer's last texel does.
  const auto at = [&](float first, int step, int side) {
    const int i = static_cast<int>(first) + step;
    if (layered) return std::clamp(i, 0, side - 1);
    return i < 0 ? i + side : i >= side ? i - side : i;
  };
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 2; ++i) {
      const float weight =
          share * (i == 0 ? 1.0f - (x - west) : x - west) * (j == 0 ? 1.0f - (y - north) : y - north);
      if (weight == 0.0f) continue; // what lies there, infinity included, must not show
      const int row = layer * level.height + at(north, j, level.height);
      const float* from =
          level.texels.data() + 4 * (std::ptrdiff_t{row} * level.width + at(west, i, level.width));
      for (std::size_t c = 0; c < 4; ++c) sum[c] += weight * from[c];
    }
}

FastFar::Value FastFar::value_at(const FastTables& tables, const SampleBatch& batch, std::size_t k, int level,
                                 float share) const {
  std::int32_t x = batch.tile_x ? batch.tile_x[k] : 0, y = batch.tile_y ? batch.tile_y[k] : 0;
  float fx = batch.x[k], fy = batch.y[k];
  settle_coordinates(&x, &fx, 1, tables.width);
  settle_coordinates(&y, &fy, 1, tables.height);
  const std::uint32_t place =
      packed_place_of_cell(*tables.lookup, static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y));
  const auto column = static_cast<float>(place & 0xffffu), row = static_cast<float>(place >> 16);
  const float u = layered ? begin_x + part_x * fx : (column + fx) / columns;
  const float v = layered ? begin_y + part_y * fy : (row + fy) / rows;
  const int layer = layered ? static_cast<int>(place >> 16) : 0;
  Value sum{};
  const auto l = static_cast<std::size_t>(level);
  if (level >= 0 && share < 1.0f) add(sum, levels[l], u, v, layer, 1.0f - share);
  if (share > 0.0f) add(sum, levels[l + 1], u, v, layer, share);
  return sum;
}

void FastFar::blend_in(const FastTables& tables, const SampleBatch& batch, Filter filter,
                       std::span<float* const> out) const {
  if (filter == Filter::nearest || batch.level == nullptr) return;
  const auto top = static_cast<float>(tile_levels - 1);
  const float last = top + static_cast<float>(levels.size());
  const std::size_t end = out.size() - 1;
  for (std::size_t k = 0; k < batch.count; ++k) {
    if (!(batch.level[k] > top)) continue;
    const float level = std::min(batch.level[k], last);
    const float fine = std::floor(filter == Filter::trilinear ? level : level + 0.5f);
    const float share = filter == Filter::trilinear ? level - fine : 0.0f;
    const int far = static_cast<int>(fine) - tile_levels; // -1: the last level of tiles
    if (far < 0 && share == 0.0f) continue;
    Value sum = value_at(tables, batch, k, far, share);
    if (far < 0)
      for (std::size_t c = 0; c < out.size(); ++c)
        sum[c] += (1.0f - share) * out[c][k] * (alpha && c < end ? out[end][k] : 1.0f);
    const float scale = alpha && sum[end] > 0.0f ? 1.0f / sum[end] : 1.0f;
    for (std::size_t c = 0; c < out.size(); ++c) out[c][k] = alpha && c < end ? sum[c] * scale : sum[c];
  }
}

} // namespace tilepack
