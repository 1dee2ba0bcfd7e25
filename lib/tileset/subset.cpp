#include "tilepack/tileset/subset.h"

#include "tilepack/error/error.h"

#include <cstddef>

namespace tilepack {
namespace {

std::vector<std::size_t> ids_of(const TileSet& set, const TileColors& wanted) {
  std::vector<std::size_t> ids;
  if (const auto* edges = std::get_if<std::vector<EdgeTile>>(&wanted))
    for (const EdgeTile& tile : *edges)
      ids.push_back(
          static_cast<std::size_t>(id_in_complete_set(tile, set.colors.horizontal, set.colors.vertical)));
  else
    for (const CornerTile& tile : std::get<std::vector<CornerTile>>(wanted))
      ids.push_back(static_cast<std::size_t>(id_in_complete_set(tile, set.colors.corner)));
  return ids;
}

} // namespace

TileSet subset(const TileSet& set, const TileColors& wanted) {
  if (coloring_of(set.tiles) != coloring_of(wanted))
    throw Error(ErrorKind::internal, "subset", "edge tiles wanted of a corner-colored set, or the reverse");
  TileSet result{set.tile_size, set.colors, wanted, {}, set.guard};
  const std::vector<std::size_t> ids = ids_of(set, wanted);
  for (const TileMap& map : set.maps) {
    TileMap& chosen = result.maps.emplace_back(TileMap{map.name, map.role, map.encoding, map.depth, {}});
    for (const std::size_t id : ids) {
      if (id >= map.tiles.size())
        throw Error(ErrorKind::internal, "subset", "a color is beyond those of the complete set");
      chosen.tiles.push_back(map.tiles[id]);
    }
  }
  return result;
}

} // namespace tilepack
