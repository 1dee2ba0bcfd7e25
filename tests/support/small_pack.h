#pragma once

#include "support/images.h"

#include "tilepack/layout/tile_index.h"
#include "tilepack/mip/mip_chain.h"
#include "tilepack/pack/pack.h"

namespace tilepack {

/// A pack of random texels, for tests of addressing and filtering: what a filter must find where is easiest
/// to tell when no two texels are alike. Levels are random too, not mips of each other.
struct SmallPack {
  Size tile_size{8, 8};
  ColorCounts colors{2, 2, 0};
  VirtualSize virtual_size{6, 5};
  int channels = 3;
  Role role = Role::color;
  Encoding encoding = Encoding::srgb;
  Depth depth = Depth::u8;
};

inline Pack small_pack(const SmallPack& wanted = {}) {
  Pack pack;
  pack.tile_size = wanted.tile_size;
  pack.colors = wanted.colors;
  const auto tiles = complete_edge_set(wanted.colors.horizontal, wanted.colors.vertical);
  pack.tiles = tiles;
  pack.layout = tile_index_layout(tiles);
  pack.tile_levels = level_count(wanted.tile_size);
  PackedMap map;
  map.name = "color";
  map.role = wanted.role;
  map.encoding = wanted.encoding;
  map.depth = wanted.depth;
  map.channels = wanted.channels;
  for (int level = 0; level < pack.tile_levels; ++level) {
    const Size tile = level_size(wanted.tile_size, level);
    map.levels.push_back(test::noise(pack.layout.columns * tile.width, pack.layout.rows * tile.height,
                                     wanted.channels, static_cast<std::uint64_t>(level), wanted.depth));
  }
  pack.maps.push_back(map);
  pack.mapping = permutation_mapping(wanted.virtual_size, wanted.colors, 7);
  return pack;
}

} // namespace tilepack
