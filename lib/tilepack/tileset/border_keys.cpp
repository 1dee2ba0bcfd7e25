#include "tilepack/tileset/border_keys.h"

namespace tilepack {
namespace {

constexpr int most_colors = 64; // far above the format's limit of 8

int pair(int first, int second) {
  return first * most_colors + second;
}

BorderKeys keys_of(const EdgeTile& t) {
  return {{t.north, t.east, t.south, t.west}, {}};
}

BorderKeys keys_of(const CornerTile& t) {
  return {{pair(t.nw, t.ne), pair(t.ne, t.se), pair(t.sw, t.se), pair(t.nw, t.sw)}, {t.nw, t.ne, t.sw, t.se}};
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
