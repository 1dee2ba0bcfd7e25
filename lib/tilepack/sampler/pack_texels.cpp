#include "tilepack/sampler/pack_texels.h"

#include "tilepack/error/error.h"
#include "tilepack/mip/level_size.h"
#include "tilepack/numeric/wrap.h"
#include "tilepack/pack/pack_maps.h"

#include <algorithm>
#include <cmath>

namespace tilepack {
namespace {

const std::vector<PackedMap>& corner_maps(const Pack& pack) {
  if (!pack.corner_pack)
    throw Error(ErrorKind::usage, "corner pack", "the pack has none; bake it with " + field("corner-pack"));
  return pack.corner_pack->maps;
}

int in_texels(double coordinate) {
  return static_cast<int>(std::floor(coordinate));
}

} // namespace

PackTexels::PackTexels(const Pack& of_pack, const std::vector<PackedMap>& maps, int map_index,
                       int first_level, int last_level)
    : tables(of_pack) {
  map = &map_at(maps, map_index);
  alpha = value_space(*map).has_alpha();
  decoded.resize(static_cast<std::size_t>(chain_levels()));
  if (map->encoding == Encoding::linear) return;
  const int last = std::min(last_level, chain_levels() - 1);
  for (int level = std::max(first_level, 0); level <= last; ++level)
    decoded[static_cast<std::size_t>(level)] = to_linear(image(level), map->encoding);
}

PackTexels::PackTexels(const Pack& of_pack, int map_index, int first_level, int last_level)
    : PackTexels(of_pack, of_pack.maps, map_index, first_level, last_level) {
  turned = of_pack.layout.kind == LayoutKind::rotated;
  if (of_pack.layout.kind == LayoutKind::array) border = of_pack.layout.border;
  if (!turned) return;
  for (int level = 0; level < levels(); ++level) {
    std::vector<Placement>& of_tiles = placements.emplace_back();
    for (std::uint32_t tile = 0; tile < lookup().tiles; ++tile) {
      const TexturePlace place = place_of_tile(lookup(), tile);
      of_tiles.push_back(
          placement(lookup().layout, static_cast<int>(place.column), static_cast<int>(place.row), level));
    }
  }
}

PackTexels PackTexels::of_corners(const Pack& of_pack, int map_index, int first_level, int last_level) {
  return PackTexels(of_pack, corner_maps(of_pack), map_index, first_level, last_level);
}

PackTexels::Place PackTexels::place(std::int64_t cell_x, std::int64_t cell_y) const {
  const std::uint32_t tile = tile_of_cell(lookup(), cell_at(lookup().lattice, cell_x, cell_y));
  const TexturePlace place = place_of_tile(lookup(), tile);
  return {static_cast<int>(place.column), static_cast<int>(place.row), static_cast<int>(tile)};
}

const Image& PackTexels::image(int level) const {
  const auto l = static_cast<std::size_t>(level);
  if (!decoded[l].empty()) return decoded[l];
  return level < levels() ? map->levels[l] : map->far_levels[l - map->levels.size()];
}

std::span<const float> PackTexels::texel(int level, Place place, int i, int j) const {
  const Image& texture = image(level);
  const Size tile = tile_size(level);
  if (border >= 0) {
    const int beyond = border >> level;
    return texture.texel(std::clamp(i + beyond, 0, tile.width + 2 * beyond - 1),
                         place.row * (tile.height + 2 * beyond) +
                             std::clamp(j + beyond, 0, tile.height + 2 * beyond - 1));
  }
  return texture.texel(wrapped(place.column * tile.width + i, texture.width()),
                       wrapped(place.row * tile.height + j, texture.height()));
}

PackTexels::Taps PackTexels::taps(int level, Place place, double fraction_x, double fraction_y,
                                  Filter filter) const {
  if (level >= levels()) return far_taps(image(level), place, fraction_x, fraction_y);
  const Size tile = tile_size(level);
  Placement::Vector at;
  if (turned)
    at = placements[static_cast<std::size_t>(level)][static_cast<std::size_t>(place.tile)].at(fraction_x,
                                                                                              fraction_y);
  const auto texel_at = [&](int x, int y) {
    if (!turned) return texel(level, place, x, y);
    const Image& texture = image(level);
    return texture.texel(wrapped(x, texture.width()), wrapped(y, texture.height()));
  };
  Taps result;
  if (filter == Filter::nearest) {
    result.taps[0] = {
        turned ? texel_at(in_texels(at.x), in_texels(at.y))
               : texel_at(nearest_texel(fraction_x, tile.width), nearest_texel(fraction_y, tile.height)),
        1.0};
    result.count = 1;
    return result;
  }
  const auto along = [](double coordinate) {
    const double first = std::floor(coordinate - 0.5);
    return tilepack::Taps{static_cast<int>(first), coordinate - 0.5 - first};
  };
  const tilepack::Taps x = turned ? along(at.x) : bilinear_taps(fraction_x, tile.width);
  const tilepack::Taps y = turned ? along(at.y) : bilinear_taps(fraction_y, tile.height);
  // A texel of weight 0 is not read: what lies there, infinity included, must not show.
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 2; ++i) {
      const double weight = (i == 0 ? 1.0 - x.weight : x.weight) * (j == 0 ? 1.0 - y.weight : y.weight);
      if (weight != 0.0)
        result.taps[static_cast<std::size_t>(result.count++)] = {texel_at(x.first + i, y.first + j), weight};
    }
  return result;
}

// At the same point of the texture as in the last level of tiles.
PackTexels::Taps PackTexels::far_taps(const Image& far, Place place, double fraction_x,
                                      double fraction_y) const {
  const int last = levels() - 1;
  const Size tile = tile_size(last), whole = map->levels.back().size();
  const int beyond = std::max(border, 0) >> last;
  const Size cell{tile.width + 2 * beyond, tile.height + 2 * beyond};
  const int layers = border >= 0 ? whole.height / cell.height : 1;
  Placement::Vector at;
  if (turned)
    at = placements[static_cast<std::size_t>(last)][static_cast<std::size_t>(place.tile)].at(fraction_x,
                                                                                             fraction_y);
  else
    at = {place.column * cell.width + beyond + fraction_x * tile.width,
          (border >= 0 ? 0 : place.row) * cell.height + beyond + fraction_y * tile.height};
  const int height = far.height() / layers;
  const double x = at.x / whole.width * far.width() - 0.5;
  const double y = at.y / (border >= 0 ? cell.height : whole.height) * height - 0.5;
  const auto along = [&](double first, int step, int side) {
    const int i = static_cast<int>(std::floor(first)) + step;
    return border >= 0 ? std::clamp(i, 0, side - 1) : wrapped(i, side);
  };
  const double east = x - std::floor(x), south = y - std::floor(y);
  Taps result;
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 2; ++i) {
      const double weight = (i == 0 ? 1.0 - east : east) * (j == 0 ? 1.0 - south : south);
      if (weight != 0.0)
        result.taps[static_cast<std::size_t>(result.count++)] = {
            far.texel(along(x, i, far.width()), (border >= 0 ? place.row * height : 0) + along(y, j, height)),
            weight};
    }
  return result;
}

PackTexels::Taps PackTexels::texel_taps(int level, Place place, int i, int j) const {
  const Size tile = tile_size(level);
  if (turned) return taps(level, place, (i + 0.5) / tile.width, (j + 0.5) / tile.height, Filter::bilinear);
  Taps result;
  result.taps[0] = {texel(level, place, i, j), 1.0};
  result.count = 1;
  return result;
}

int PackTexels::channels() const {
  return map->channels;
}

int PackTexels::levels() const {
  return static_cast<int>(map->levels.size());
}

int PackTexels::chain_levels() const {
  return static_cast<int>(map->levels.size() + map->far_levels.size());
}

Size PackTexels::tile_size(int level) const {
  const LayoutWords& words = lookup().layout;
  return level_size({static_cast<int>(words.tile_width), static_cast<int>(words.tile_height)}, level);
}

} // namespace tilepack
