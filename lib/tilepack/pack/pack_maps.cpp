#include "tilepack/pack/pack_maps.h"

#include "tilepack/error/error.h"
#include "tilepack/error/nearest_name.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace tilepack {

int map_called(const Pack& pack, const std::string& name) {
  std::vector<std::string> known;
  for (const PackedMap& map : pack.maps) {
    if (name.empty() || map.name == name) return static_cast<int>(known.size());
    known.push_back(map.name);
  }
  const std::string nearest = nearest_name(name, known);
  throw Error(ErrorKind::usage, field("map"),
              fmt::format("the pack has no map '{}'{}; it has {}", name,
                          nearest.empty() ? "" : fmt::format(", did you mean '{}'?", nearest),
                          fmt::join(known, ", ")));
}

const PackedMap& map_at(std::span<const PackedMap> maps, int map) {
  if (map < 0 || map >= static_cast<int>(maps.size()))
    throw Error(ErrorKind::usage, field("map"),
                fmt::format("{} is not a map of the pack; it has 0..{}", map, maps.size() - 1));
  return maps[static_cast<std::size_t>(map)];
}

bool is_far(const PackedMap& map, int level) {
  const auto first = static_cast<int>(map.levels.size());
  return level >= first && level < first + static_cast<int>(map.far_levels.size());
}

const Image& level_at(const PackedMap& map, int level) {
  if (level < 0 || level >= static_cast<int>(map.levels.size()))
    throw Error(
        ErrorKind::usage, field("level"),
        fmt::format("{} is not stored; map {} has levels 0..{}", level, map.name, map.levels.size() - 1));
  return map.levels[static_cast<std::size_t>(level)];
}

} // namespace tilepack
