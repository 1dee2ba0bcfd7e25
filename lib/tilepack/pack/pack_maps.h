#pragma once

#include "tilepack/pack/pack.h"

#include <span>
#include <string>

namespace tilepack {

/// The number of the map of that name; the first, which is the main one, if `name` is empty. Error (usage,
/// field "map") that names the maps there are, and the nearest.
int map_called(const Pack& pack, const std::string& name);

/// The map of that number. Error (usage, field "map") outside of 0..maps-1.
const PackedMap& map_at(std::span<const PackedMap> maps, int map);
inline const PackedMap& map_at(const Pack& pack, int map) {
  return map_at(pack.maps, map);
}

/// Whether the level of that number is one of the map's far levels (mip/far_levels.h).
bool is_far(const PackedMap& map, int level);

/// The level of tiles of that number, 0 the finest. Error (usage, field "level") if it is not stored.
const Image& level_at(const PackedMap& map, int level);

} // namespace tilepack
