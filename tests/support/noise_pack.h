#pragma once

#include "support/images.h"

#include "tilepack/image/encoding.h"
#include "tilepack/layout/de_bruijn.h"
#include "tilepack/layout/tile_index.h"
#include "tilepack/mapping/mapping.h"
#include "tilepack/mip/mip_chain.h"
#include "tilepack/pack/pack.h"

#include <filesystem>
#include <string>

namespace tilepack::test {

/// A pack of noise, made without synthesis: two edge colors, 8 x 4 texels a tile, a color map of 8 bits and a
/// height map of the depth asked for; `variants` of each combination.
inline Pack noise_pack(MappingKind mapping = MappingKind::permutation, Depth height_depth = Depth::u16,
                       std::uint64_t seed = 1, int variants = 1) {
  TileSet set;
  set.tile_size = {8, 4};
  set.colors = {2, 2, 0, variants};
  set.tiles = complete_set(set.colors);
  set.maps = {{"color", Role::color, Encoding::srgb, Depth::u8, {}},
              {"height", Role::height, Encoding::linear, height_depth, {}}};
  for (std::uint64_t i = 0; i < 16 * static_cast<std::uint64_t>(variants); ++i) {
    set.maps[0].tiles.push_back(noise(8, 4, 3, seed * 100 + i));
    set.maps[1].tiles.push_back(quantised(noise(8, 4, 1, seed * 200 + i), height_depth));
  }
  Pack pack;
  pack.generator = {"tilepack", "0.1.0", {{"colors", "2"}, {"guard", "0"}}, seed};
  pack.tile_size = set.tile_size;
  pack.colors = set.colors;
  pack.tiles = set.tiles;
  pack.layout = tile_index_layout(std::get<std::vector<EdgeTile>>(set.tiles));
  pack.mapping = mapping == MappingKind::permutation ? permutation_mapping({6, 5}, set.colors, seed)
                                                     : mix_mapping({6, 5}, seed);
  if (mapping == MappingKind::even) { // the same texels as corner-colored tiles
    pack.colors = {0, 0, 2, variants};
    pack.tiles = complete_set(pack.colors);
    pack.layout = de_bruijn_layout(std::get<std::vector<CornerTile>>(pack.tiles));
    pack.mapping = even_mapping({6, 5}, 2, seed, variants);
  }
  if (mapping == MappingKind::index) pack.mapping = index_mapping(pack.mapping, set.colors);
  for (int m = 0; m < 2; ++m) {
    const TileMap& map = set.maps[static_cast<std::size_t>(m)];
    PackedMap packed{map.name, map.role, map.encoding, map.depth, map.tiles.front().channels(), {}};
    for (const TileMap& level : mip_chain(set, m, {MipMode::edges}))
      packed.levels.push_back(quantised(atlas(level.tiles, pack.layout), map.depth));
    pack.maps.push_back(std::move(packed));
  }
  pack.tile_levels = level_count(set.tile_size);
  return pack;
}

} // namespace tilepack::test
