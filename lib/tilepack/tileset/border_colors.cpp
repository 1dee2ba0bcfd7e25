#include "tilepack/tileset/border_colors.h"

namespace tilepack {
namespace {

// Wide enough for any color count, so that pairs don't collide.
constexpr int pair_base = 256;

BorderColors borders_of(const EdgeTile& tile) {
  return {tile.north, tile.east, tile.south, tile.west};
}

// Pairs read from west to east and from north to south, whichever tile they are seen from.
BorderColors borders_of(const CornerTile& tile) {
  return {tile.nw * pair_base + tile.ne, tile.ne * pair_base + tile.se, tile.sw * pair_base + tile.se,
          tile.nw * pair_base + tile.sw};
}

} // namespace

std::vector<BorderColors> border_colors(const TileColors& tiles) {
  std::vector<BorderColors> borders;
  std::visit(
      [&](const auto& list) {
        for (const auto& tile : list) borders.push_back(borders_of(tile));
      },
      tiles);
  return borders;
}

} // namespace tilepack
