#include "tilepack/sampler/ground_truth.h"

#include "tilepack/error/error.h"
#include "tilepack/layout/place_tiles.h"
#include "tilepack/mip/mip_chain.h"
#include "tilepack/pack/pack_maps.h"
#include "tilepack/tileset/value_space.h"

#include <algorithm>
#include <string>
#include <utility>

namespace tilepack {

TileSet tile_set_of(const Pack& pack) {
  TileSet set{pack.tile_size, pack.colors, pack.tiles, {}, pack.guard};
  for (const PackedMap& map : pack.maps)
    set.maps.push_back({map, tiles_at_level(map.levels.at(0), pack.layout, pack.tile_size, 0)});
  return set;
}

GroundTruth::GroundTruth(const Pack& of_pack, int map_index, WrapMode at_border,
                         std::vector<std::vector<Image>> encoded_tiles)
    : pack(&of_pack), tables(of_pack), border(at_border), tiles(std::move(encoded_tiles)) {
  const PackedMap& map = map_at(of_pack, map_index);
  alpha = value_space(map).has_alpha();
  for (auto& level : tiles)
    for (Image& tile : level) tile = to_linear(tile, map.encoding);
}

GroundTruth GroundTruth::of_level_0(const Pack& pack, int map, WrapMode border) {
  const std::size_t stored = map_at(pack, map).levels.size();
  std::vector<std::vector<Image>> levels;
  for (TileMap& level : mip_chain(tile_set_of(pack), map, {MipMode::box}))
    if (levels.size() < stored) levels.push_back(std::move(level.tiles));
  return {pack, map, border, std::move(levels)};
}

GroundTruth GroundTruth::of_stored_levels(const Pack& pack, int map, WrapMode border) {
  std::vector<std::vector<Image>> levels;
  for (const Image& level : map_at(pack, map).levels)
    levels.push_back(tiles_at_level(level, pack.layout, pack.tile_size, static_cast<int>(levels.size())));
  return {pack, map, border, std::move(levels)};
}

int GroundTruth::channels() const {
  return tiles.front().front().channels();
}

int GroundTruth::levels() const {
  return static_cast<int>(tiles.size());
}

// Texel (x, y) of the virtual texture, in whatever tile that is.
std::span<const float> GroundTruth::texel(int level, std::int64_t x, std::int64_t y) const {
  const auto& images = tiles[static_cast<std::size_t>(level)];
  const Size side = images.front().size();
  const std::int64_t column = within(x, pack->mapping.size.width * side.width, border);
  const std::int64_t row = within(y, pack->mapping.size.height * side.height, border);
  const std::uint32_t tile = tile_of_cell(tables.words(), {static_cast<std::uint32_t>(column / side.width),
                                                           static_cast<std::uint32_t>(row / side.height)});
  return images[tile].texel(static_cast<int>(column % side.width), static_cast<int>(row % side.height));
}

void GroundTruth::sample(TileCoordinate x, TileCoordinate y, double level, Filter filter,
                         std::span<double> out) const {
  const TileCoordinate east = within(x, pack->mapping.size.width, border);
  const TileCoordinate south = within(y, pack->mapping.size.height, border);
  ValueSums sums;
  const auto add_level = [&](int number, double share) {
    const Size side = tiles[static_cast<std::size_t>(number)].front().size();
    const auto add = [&](int i, int j, double weight) { // from the cell's north-west texel
      sums.add(texel(number, east.tile * side.width + i, south.tile * side.height + j), weight, alpha);
    };
    if (filter == Filter::nearest)
      return add(nearest_texel(east.fraction, side.width), nearest_texel(south.fraction, side.height), share);
    const Taps taps_x = bilinear_taps(east.fraction, side.width);
    const Taps taps_y = bilinear_taps(south.fraction, side.height);
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 2; ++i) {
        const double weight =
            (i == 0 ? 1.0 - taps_x.weight : taps_x.weight) * (j == 0 ? 1.0 - taps_y.weight : taps_y.weight);
        if (weight != 0.0) add(taps_x.first + i, taps_y.first + j, share * weight);
      }
  };
  const LevelBlend blend = level_blend(level, levels(), filter);
  add_level(blend.fine, 1.0 - blend.coarse_weight);
  if (blend.coarse_weight > 0.0) add_level(blend.coarse, blend.coarse_weight);
  sums.resolve(out, alpha);
}

void GroundTruth::sample(TileCoordinate x, TileCoordinate y, const Footprint& footprint,
                         std::span<double> out) const {
  const TileCoordinate east = within(x, pack->mapping.size.width, border);
  const TileCoordinate south = within(y, pack->mapping.size.height, border);
  const FootprintEllipse ellipse = ellipse_of(footprint, pack->tile_size);
  ValueSums sums;
  const auto add_level = [&](int number, double share) {
    const Size side = tiles[static_cast<std::size_t>(number)].front().size();
    const EllipseTexels covered(ellipse, number);
    const double at_x = east.fraction * side.width;
    const double at_y = south.fraction * side.height;
    double total = 0;
    covered.each(at_x, at_y, [&](int, int, double weight) { total += weight; });
    covered.each(at_x, at_y, [&](int i, int j, double weight) {
      sums.add(texel(number, east.tile * side.width + i, south.tile * side.height + j),
               share * weight / total, alpha);
    });
  };
  const LevelBlend blend = level_blend(level_of(ellipse), levels(), Filter::trilinear);
  add_level(blend.fine, 1.0 - blend.coarse_weight);
  if (blend.coarse_weight > 0.0) add_level(blend.coarse, blend.coarse_weight);
  sums.resolve(out, alpha);
}

} // namespace tilepack
