#include "tilepack/sampler/pack_texels.h"

#include "tilepack/error/error.h"
#include "tilepack/image/wrap.h"

#include <algorithm>

namespace tilepack {

PackTexels::PackTexels(const Pack& of_pack, int map_index, int first_level, int last_level) : pack(&of_pack) {
  const int maps = static_cast<int>(of_pack.maps.size());
  if (map_index < 0 || map_index >= maps)
    throw Error(ErrorKind::usage, "map",
                std::to_string(map_index) + " is not a map of the pack; it has 0.." +
                    std::to_string(maps - 1));
  map = &of_pack.maps[static_cast<std::size_t>(map_index)];
  alpha = map->role == Role::color && map->channels % 2 == 0;
  decoded.resize(map->levels.size());
  if (map->encoding == Encoding::linear) return;
  const int last = std::min(last_level, levels() - 1);
  for (int level = std::max(first_level, 0); level <= last; ++level) {
    const auto l = static_cast<std::size_t>(level);
    decoded[l] = to_linear(map->levels[l], map->encoding);
  }
}

PackTexels::Place PackTexels::place(std::int64_t cell_x, std::int64_t cell_y) const {
  const int tile = tile_at(pack->mapping, pack->colors, cell_x, cell_y);
  const Cell& cell = pack->layout.cells[static_cast<std::size_t>(tile)];
  return {cell.column, cell.row};
}

std::span<const float> PackTexels::texel(int level, Place place, int i, int j) const {
  const auto l = static_cast<std::size_t>(level);
  const Image& image = decoded[l].empty() ? map->levels[l] : decoded[l];
  const Size tile = tile_size(level);
  return image.texel(wrapped(place.column * tile.width + i, image.width()),
                     wrapped(place.row * tile.height + j, image.height()));
}

int PackTexels::channels() const {
  return map->channels;
}

int PackTexels::levels() const {
  return static_cast<int>(map->levels.size());
}

Size PackTexels::tile_size(int level) const {
  return level_size(pack->tile_size, level);
}

} // namespace tilepack
