#include "tilepack/sampler/fast_corners.h"

#include <array>

namespace tilepack {
namespace {

std::unique_ptr<const Pack> with_one_map(const Pack& pack, int map) {
  auto result = std::make_unique<Pack>();
  result->tile_size = pack.tile_size;
  result->colors = pack.colors;
  result->tiles = pack.tiles;
  result->layout = pack.layout;
  result->mapping = pack.mapping;
  result->tile_levels = pack.tile_levels;
  result->full_chain = pack.full_chain;
  result->maps = {pack.maps[static_cast<std::size_t>(map)]};
  result->corner_pack = {pack.corner_pack->columns,
                         pack.corner_pack->rows,
                         pack.corner_pack->width,
                         {pack.corner_pack->maps[static_cast<std::size_t>(map)]}};
  return result;
}

} // namespace

FastCorners::FastCorners(const Pack& of_pack, int map)
    : pack(with_one_map(of_pack, map)), sampler(*pack, 0), corners(*pack, 0, default_corner_width) {}

void FastCorners::blend_in(const SampleBatch& batch, Filter filter, std::span<float* const> out) const {
  const std::size_t far = filter == Filter::nearest ? 0 : pack->maps[0].far_levels.size();
  const int levels = static_cast<int>(pack->maps[0].levels.size() + far);
  std::array<double, 4> value{};
  const std::span<double> channels(value.data(), static_cast<std::size_t>(sampler.channels()));
  for (std::size_t i = 0; i < batch.count; ++i) {
    const TileCoordinate x =
        normalised({batch.tile_x ? batch.tile_x[i] : 0, static_cast<double>(batch.x[i])});
    const TileCoordinate y =
        normalised({batch.tile_y ? batch.tile_y[i] : 0, static_cast<double>(batch.y[i])});
    const double level = batch.level ? static_cast<double>(batch.level[i]) : 0.0;
    const LevelBlend blend = level_blend(level, levels, filter);
    const auto near_corner = [&](int of_level) {
      return corners.weight(of_level, x.fraction, y.fraction) > 0;
    };
    if (!near_corner(blend.fine) && !near_corner(blend.coarse)) continue;
    sampler.sample(x, y, level, filter, channels);
    for (std::size_t c = 0; c < channels.size(); ++c) out[c][i] = static_cast<float>(value[c]);
  }
}

} // namespace tilepack
