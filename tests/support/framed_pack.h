#pragma once

#include "tilepack/bake/packing.h"
#include "tilepack/numeric/random.h"
#include "tilepack/tileset/border_colors.h"

#include <variant>

namespace tilepack {

/// Random 8-bit tiles whose outermost texels agree as a filter needs them to: along an edge by its color
/// (both colors at its ends for corner coloring), in a corner by what is known of the point there (the colors
/// of the tile's two edges that meet in it; its corner color). Nothing else is alike in two tiles.
inline TileSet framed_set(const TileColors& colors, Size size, std::uint64_t seed) {
  TileSet set{size, color_counts(colors), colors, {}, 1};
  TileMap map{"color", Role::color, Encoding::srgb, Depth::u8, {}};
  const std::vector<BorderColors> borders = border_colors(colors);
  const auto value = [&](std::uint64_t key, std::size_t channel) {
    return static_cast<float>(random_below(seed, "framed", key * 4 + channel, 256)) / 255.0f;
  };
  // Keys of different kinds of texels don't meet.
  const auto key_of = [](std::uint64_t kind, std::uint64_t a, std::uint64_t b, std::uint64_t c) {
    return ((kind * 70000 + a) * 70000 + b) * 70000 + c;
  };
  for (std::size_t id = 0; id < borders.size(); ++id) {
    const BorderColors& b = borders[id];
    const auto corner_key = [&](std::uint64_t corner, int horizontal, int vertical) {
      if (const auto* corners = std::get_if<std::vector<CornerTile>>(&colors)) {
        const CornerTile& tile = (*corners)[id];
        const int color[] = {tile.nw, tile.ne, tile.sw, tile.se};
        return key_of(20 + corner, static_cast<std::uint64_t>(color[corner]), 0, 0);
      }
      return key_of(20 + corner, static_cast<std::uint64_t>(horizontal), static_cast<std::uint64_t>(vertical),
                    0);
    };
    Image tile(size.width, size.height, 3);
    for (int y = 0; y < size.height; ++y)
      for (int x = 0; x < size.width; ++x) {
        const bool west = x == 0;
        const bool east = x == size.width - 1;
        const bool north = y == 0;
        const bool south = y == size.height - 1;
        const auto along = [](int i) { return static_cast<std::uint64_t>(i); };
        std::uint64_t key = key_of(1, id, along(x), along(y));
        if (north && west)
          key = corner_key(0, b.north, b.west);
        else if (north && east)
          key = corner_key(1, b.north, b.east);
        else if (south && west)
          key = corner_key(2, b.south, b.west);
        else if (south && east)
          key = corner_key(3, b.south, b.east);
        else if (north)
          key = key_of(10, along(b.north), along(x), 0);
        else if (south)
          key = key_of(11, along(b.south), along(x), 0);
        else if (west)
          key = key_of(12, along(b.west), along(y), 0);
        else if (east)
          key = key_of(13, along(b.east), along(y), 0);
        for (std::size_t c = 0; c < 3; ++c) tile.texel(x, y)[c] = value(key, c);
      }
    map.tiles.push_back(tile);
  }
  set.maps.push_back(map);
  return set;
}

} // namespace tilepack
