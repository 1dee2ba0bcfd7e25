#include "tilepack/mip/shared_border.h"

#include "tilepack/tileset/border_keys.h"

#include <array>
#include <cstddef>
#include <map>
#include <tuple>
#include <utility>

namespace tilepack {
namespace {

using Side = BorderKeys::Side;
using Corner = BorderKeys::Corner;

std::vector<Place> side_places(Side side, Size size) {
  std::vector<Place> places;
  if (side == BorderKeys::north || side == BorderKeys::south)
    for (int x = 1; x < size.width - 1; ++x)
      places.push_back({x, side == BorderKeys::north ? 0 : size.height - 1});
  else
    for (int y = 1; y < size.height - 1; ++y)
      places.push_back({side == BorderKeys::west ? 0 : size.width - 1, y});
  return places;
}

Place corner_place(Corner corner, Size size) {
  return {corner == BorderKeys::nw || corner == BorderKeys::sw ? 0 : size.width - 1,
          corner == BorderKeys::nw || corner == BorderKeys::ne ? 0 : size.height - 1};
}

class Groups {
public:
  explicit Groups(const TileColors& colored_tiles) : keys(border_keys(colored_tiles)) {}

  template <typename KeyOf>
  void add(const std::vector<Place>& places, KeyOf&& key_of) {
    if (places.empty()) return;
    std::map<int, std::vector<int>> classes;
    for (std::size_t tile = 0; tile < keys.size(); ++tile)
      classes[key_of(keys[tile])].push_back(static_cast<int>(tile));
    for (auto& [key, tiles] : classes) groups.push_back({std::move(tiles), places});
  }

  void add_for_all(const std::vector<Place>& places) {
    add(places, [](const BorderKeys&) { return 0; });
  }

  std::vector<SharedTexels> take() { return std::move(groups); }

private:
  std::vector<BorderKeys> keys;
  std::vector<SharedTexels> groups;
};

void add_corners(Groups& groups, Size size) {
  if (size.width == 1 || size.height == 1) {
    std::vector<Place> ends{{0, 0}};
    if (size.width > 1 || size.height > 1) ends.push_back({size.width - 1, size.height - 1});
    groups.add_for_all(ends);
    return;
  }
  for (const Corner corner : {BorderKeys::nw, BorderKeys::ne, BorderKeys::sw, BorderKeys::se})
    groups.add({corner_place(corner, size)}, [&](const BorderKeys& k) { return k.corners[corner]; });
}

} // namespace

std::vector<SharedTexels> shared_border(const TileColors& tiles, Size size, MipMode mode) {
  if (mode != MipMode::edges && mode != MipMode::corners) return {};
  Groups groups(tiles);
  for (const auto& [first, second, length] : {std::tuple{BorderKeys::north, BorderKeys::south, size.height},
                                              std::tuple{BorderKeys::west, BorderKeys::east, size.width}}) {
    if (length == 1) {
      groups.add_for_all(side_places(first, size));
      continue;
    }
    for (const Side side : {first, second})
      groups.add(side_places(side, size), [&](const BorderKeys& k) { return k.sides[side]; });
  }
  if (mode == MipMode::corners) add_corners(groups, size);
  return groups.take();
}

} // namespace tilepack
