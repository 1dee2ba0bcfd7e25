#include "tilepack/sampler/ground_truth.h"

#include "tilepack/error/error.h"
#include "tilepack/image/wrap.h"
#include "tilepack/layout/place_tiles.h"
#include "tilepack/sampler/texel_sums.h"

#include <algorithm>
#include <string>
#include <utility>

namespace tilepack {
namespace {

const PackedMap& map_of(const Pack& pack, int map) {
  const int maps = static_cast<int>(pack.maps.size());
  if (map < 0 || map >= maps)
    throw Error(ErrorKind::usage, "map",
                std::to_string(map) + " is not a map of the pack; it has 0.." + std::to_string(maps - 1));
  return pack.maps[static_cast<std::size_t>(map)];
}

} // namespace

TileSet tile_set_of(const Pack& pack) {
  TileSet set{pack.tile_size, pack.colors, pack.tiles, {}, pack.guard};
  for (const PackedMap& map : pack.maps)
    set.maps.push_back({map.name, map.role, map.encoding, map.depth,
                        tiles_at_level(map.levels.at(0), pack.layout, pack.tile_size, 0)});
  return set;
}

GroundTruth::GroundTruth(const Pack& of_pack, int map_index, std::vector<std::vector<Image>> encoded_tiles)
    : pack(&of_pack), tiles(std::move(encoded_tiles)) {
  const PackedMap& map = map_of(of_pack, map_index);
  alpha = map.role == Role::color && map.channels % 2 == 0;
  for (auto& level : tiles)
    for (Image& tile : level) tile = to_linear(tile, map.encoding);
}

GroundTruth GroundTruth::of_level_0(const Pack& pack, int map) {
  const std::size_t stored = map_of(pack, map).levels.size();
  std::vector<std::vector<Image>> levels;
  for (TileMap& level : mip_chain(tile_set_of(pack), map, {MipMode::box}))
    if (levels.size() < stored) levels.push_back(std::move(level.tiles));
  return {pack, map, std::move(levels)};
}

GroundTruth GroundTruth::of_stored_levels(const Pack& pack, int map) {
  std::vector<std::vector<Image>> levels;
  for (const Image& level : map_of(pack, map).levels)
    levels.push_back(tiles_at_level(level, pack.layout, pack.tile_size, static_cast<int>(levels.size())));
  return {pack, map, std::move(levels)};
}

int GroundTruth::channels() const {
  return tiles.front().front().channels();
}

int GroundTruth::levels() const {
  return static_cast<int>(tiles.size());
}

void GroundTruth::sample(TileCoordinate x, TileCoordinate y, double level, Filter filter,
                         std::span<double> out) const {
  const TileCoordinate east = normalised(x);
  const TileCoordinate south = normalised(y);
  TexelSums sums;
  // Texel (i, j) counted from the north-west one of the cell, in whatever tile that is.
  const auto add = [&](const std::vector<Image>& images, int i, int j, double weight) {
    const Size side = images.front().size();
    const int texel_x = wrapped(i, side.width);
    const int texel_y = wrapped(j, side.height);
    const std::int64_t cell_x = wrapped(east.tile, pack->mapping.size.width) + (i - texel_x) / side.width;
    const std::int64_t cell_y = wrapped(south.tile, pack->mapping.size.height) + (j - texel_y) / side.height;
    const int tile = tile_at(pack->mapping, pack->colors, cell_x, cell_y);
    sums.add(images[static_cast<std::size_t>(tile)].texel(texel_x, texel_y), weight, alpha);
  };
  const auto add_level = [&](int number, double share) {
    const auto& images = tiles[static_cast<std::size_t>(number)];
    const Size side = images.front().size();
    if (filter == Filter::nearest)
      return add(images, nearest_texel(east.fraction, side.width), nearest_texel(south.fraction, side.height),
                 share);
    const Taps taps_x = bilinear_taps(east.fraction, side.width);
    const Taps taps_y = bilinear_taps(south.fraction, side.height);
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 2; ++i) {
        const double weight =
            (i == 0 ? 1.0 - taps_x.weight : taps_x.weight) * (j == 0 ? 1.0 - taps_y.weight : taps_y.weight);
        if (weight != 0.0) add(images, taps_x.first + i, taps_y.first + j, share * weight);
      }
  };
  const LevelBlend blend = level_blend(level, levels(), filter);
  add_level(blend.fine, 1.0 - blend.coarse_weight);
  if (blend.coarse_weight > 0.0) add_level(blend.coarse, blend.coarse_weight);
  sums.resolve(out, alpha);
}

} // namespace tilepack
