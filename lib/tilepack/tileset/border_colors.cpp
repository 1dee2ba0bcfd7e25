#include "tilepack/tileset/border_colors.h"

namespace tilepack {

BorderColors borders_of(const EdgeTile& tile) {
  return {tile.north, tile.east, tile.south, tile.west};
}

BorderColors borders_of(const CornerTile& tile, int base) {
  const auto side = [base](int first, int second) { return first * base + second; };
  return {side(tile.nw, tile.ne), side(tile.ne, tile.se), side(tile.sw, tile.se), side(tile.nw, tile.sw)};
}

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
