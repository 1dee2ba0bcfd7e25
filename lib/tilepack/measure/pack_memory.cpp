#include "tilepack/measure/pack_memory.h"

#include "tilepack/mip/level_size.h"

#include <algorithm>

namespace tilepack {
namespace {

using MapFiles = std::vector<TextureFile>;

int bytes_a_channel(Depth depth) {
  switch (depth) {
  case Depth::u8:
    return 1;
  case Depth::u16:
  case Depth::f16:
    return 2;
  case Depth::f32:
    break;
  }
  return 4;
}

std::uint64_t bytes_of(const std::vector<PackedMap>& maps, const std::vector<MapFiles>& files) {
  std::uint64_t bytes = 0;
  for (std::size_t m = 0; m < std::min(maps.size(), files.size()); ++m)
    for (const Size& size : level_sizes(files[m]))
      bytes += static_cast<std::uint64_t>(size.width) * static_cast<std::uint64_t>(size.height) *
               static_cast<std::uint64_t>(maps[m].channels * bytes_a_channel(maps[m].depth));
  return bytes;
}

} // namespace

std::uint64_t bytes_in_memory(const Pack& pack, const PackDescription& description) {
  return bytes_of(pack.maps, description.map_files) +
         (pack.corner_pack ? bytes_of(pack.corner_pack->maps, description.corner_files) : 0);
}

double bytes_stored_whole(const Pack& pack) {
  double texels = 0;
  for (int level = 0; level < pack.tile_levels; ++level) {
    const Size tile = level_size(pack.tile_size, level);
    texels += static_cast<double>(pack.mapping.size.width) * tile.width *
              (static_cast<double>(pack.mapping.size.height) * tile.height);
  }
  double bytes = 0;
  for (const PackedMap& map : pack.maps) bytes += texels * map.channels * bytes_a_channel(map.depth);
  return bytes;
}

} // namespace tilepack
