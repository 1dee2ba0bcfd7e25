#pragma once

#include "tilepack/check/issues.h"
#include "tilepack/layout/tile_index.h"
#include "tilepack/mip/level_size.h"
#include "tilepack/mip/mip_chain.h"
#include "tilepack/numeric/random.h"
#include "tilepack/pack/pack.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <span>
#include <string>

namespace tilepack::test {

struct GoodPackOptions {
  ColorCounts colors{2, 2, 0};
  Size tile{16, 16};
  int guard = 2;
  int channels = 3;
  Depth depth = Depth::u8;
  MipMode mips = MipMode::edges;
};

/// A tile whose texels are noise, shared with other tiles exactly where a pack promises it: `rows` deep along
/// each edge by the edge's color, everything else by the tile's id.
inline Image noise_tile(const EdgeTile& colors, int id, Size size, int rows, int channels, Depth depth) {
  Image tile(size.width, size.height, channels);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const bool north = y < rows;
      const bool south = y >= size.height - rows;
      const bool west = x < rows;
      const bool east = x >= size.width - rows;
      int owner = 1000 + id;
      if (int(north) + int(south) + int(west) + int(east) == 1)
        owner = north   ? 100 + colors.north
                : south ? 200 + colors.south
                : west  ? 300 + colors.west
                        : 400 + colors.east;
      for (int c = 0; c < channels; ++c) {
        const auto index = static_cast<std::uint64_t>((owner * 512 + y) * 512 + x) * 4 + c;
        const float value = static_cast<float>(random_below(1, "noise", index, 256)) / 255.0f;
        tile.texel(x, y)[c] = quantised(value, depth);
      }
    }
  return tile;
}

inline std::vector<int> shuffled(int n) {
  std::vector<int> table(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) table[i] = i;
  for (int i = n - 1; i > 0; --i)
    std::swap(
        table[i],
        table[random_below(5, "table", static_cast<std::uint64_t>(i), static_cast<std::uint32_t>(i + 1))]);
  return table;
}

/// A pack without a fault, of noise instead of a synthesized set.
inline Pack good_pack(const GoodPackOptions& options = {}) {
  const auto tiles = complete_edge_set(options.colors.horizontal, options.colors.vertical);
  Pack pack;
  pack.generator.version = std::string{"0.1.0"};
  pack.tile_size = options.tile;
  pack.colors = options.colors;
  pack.tiles = tiles;
  pack.layout = tile_index_layout(tiles);
  pack.mip_mode = options.mips;
  if (options.mips == MipMode::least_squares) pack.jump_weight = MipOptions{}.jump_weight;
  pack.guard = options.guard;
  pack.tile_levels = options.mips == MipMode::none ? 1 : level_count(options.tile);
  PackedMap map{"color", Role::color, Encoding::srgb, options.depth, options.channels, {}};
  TileSet set{options.tile,
              options.colors,
              tiles,
              {{"color", Role::color, Encoding::srgb, options.depth, {}}},
              options.guard};
  for (int id = 0; id < tile_count(pack.tiles); ++id)
    set.maps[0].tiles.push_back(
        noise_tile(tiles[id], id, options.tile, options.guard, options.channels, options.depth));
  for (const TileMap& level : mip_chain(set, 0, {.mode = options.mips}, &pack.layout))
    map.levels.push_back(quantised(atlas(level.tiles, pack.layout), options.depth));
  pack.maps.push_back(map);
  pack.mapping.kind = MappingKind::permutation;
  pack.mapping.size = {8, 8};
  pack.mapping.table = shuffled(16);
  return pack;
}

inline bool has(std::span<const Issue> issues, Rule rule) {
  return std::any_of(issues.begin(), issues.end(), [rule](const Issue& issue) { return issue.rule == rule; });
}

inline std::string listing(std::span<const Issue> issues) {
  std::string text;
  for (const Issue& issue : issues)
    text += code_of(issue.rule) + " " + issue.where + " | " + issue.found + " | " + issue.expected + "\n";
  return text;
}

} // namespace tilepack::test
