#include "tilepack/tileset/border_keys.h"

#include "tilepack/tileset/border_colors.h"

namespace tilepack {
namespace {

std::array<int, 4> corners_of(const EdgeTile&) {
  return {};
}

std::array<int, 4> corners_of(const CornerTile& t) {
  return {t.nw, t.ne, t.sw, t.se};
}

template <typename Tile>
BorderKeys keys_of(const Tile& tile) {
  const BorderColors b = borders_of(tile);
  return {{b.north, b.east, b.south, b.west}, corners_of(tile)};
}

} // namespace

std::vector<BorderKeys> border_keys(const TileColors& tiles) {
  std::vector<BorderKeys> keys;
  std::visit(
      [&](const auto& list) {
        for (const auto& tile : list) keys.push_back(keys_of(tile));
      },
      tiles);
  return keys;
}

} // namespace tilepack
