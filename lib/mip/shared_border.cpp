#include "tilepack/mip/shared_border.h"

#include <array>
#include <cstddef>
#include <map>
#include <tuple>
#include <utility>

namespace tilepack {
namespace {

// A color of an edge or a corner; edges under corner coloring have two, in the order west-east or
// north-south.
using Key = std::pair<int, int>;

enum Side { north, east, south, west };
enum Corner { nw, ne, sw, se };

struct TileKeys {
  std::array<Key, 4> sides;
  std::array<Key, 4> corners;
};

TileKeys keys_of(const EdgeTile& t) {
  return {{{{t.north, 0}, {t.east, 0}, {t.south, 0}, {t.west, 0}}}, {}}; // corners: one class for all
}

TileKeys keys_of(const CornerTile& t) {
  return {{{{t.nw, t.ne}, {t.ne, t.se}, {t.sw, t.se}, {t.nw, t.sw}}},
          {{{t.nw, 0}, {t.ne, 0}, {t.sw, 0}, {t.se, 0}}}};
}

std::vector<TileKeys> all_keys(const TileColors& tiles) {
  std::vector<TileKeys> keys;
  std::visit(
      [&](const auto& list) {
        for (const auto& tile : list) keys.push_back(keys_of(tile));
      },
      tiles);
  return keys;
}

std::vector<Place> side_places(Side side, Size size) {
  std::vector<Place> places;
  if (side == north || side == south)
    for (int x = 1; x < size.width - 1; ++x) places.push_back({x, side == north ? 0 : size.height - 1});
  else
    for (int y = 1; y < size.height - 1; ++y) places.push_back({side == west ? 0 : size.width - 1, y});
  return places;
}

Place corner_place(Corner corner, Size size) {
  return {corner == nw || corner == sw ? 0 : size.width - 1,
          corner == nw || corner == ne ? 0 : size.height - 1};
}

class Groups {
public:
  explicit Groups(const TileColors& colored_tiles) : keys(all_keys(colored_tiles)) {}

  template <typename KeyOf>
  void add(const std::vector<Place>& places, KeyOf&& key_of) {
    if (places.empty()) return;
    std::map<Key, std::vector<int>> classes;
    for (std::size_t tile = 0; tile < keys.size(); ++tile)
      classes[key_of(keys[tile])].push_back(static_cast<int>(tile));
    for (auto& [key, tiles] : classes) groups.push_back({std::move(tiles), places});
  }

  void add_for_all(const std::vector<Place>& places) {
    add(places, [](const TileKeys&) { return Key{}; });
  }

  std::vector<SharedTexels> take() { return std::move(groups); }

private:
  std::vector<TileKeys> keys;
  std::vector<SharedTexels> groups;
};

void add_corners(Groups& groups, Size size) {
  if (size.width == 1 || size.height == 1) {
    std::vector<Place> ends{{0, 0}};
    if (size.width > 1 || size.height > 1) ends.push_back({size.width - 1, size.height - 1});
    groups.add_for_all(ends);
    return;
  }
  for (const Corner corner : {nw, ne, sw, se})
    groups.add({corner_place(corner, size)}, [&](const TileKeys& k) { return k.corners[corner]; });
}

} // namespace

std::vector<SharedTexels> shared_border(const TileColors& tiles, Size size, MipMode mode) {
  if (mode == MipMode::none || mode == MipMode::box) return {};
  Groups groups(tiles);
  for (const auto& [first, second, length] :
       {std::tuple{north, south, size.height}, std::tuple{west, east, size.width}}) {
    if (length == 1) {
      groups.add_for_all(side_places(first, size));
      continue;
    }
    for (const Side side : {first, second})
      groups.add(side_places(side, size), [&](const TileKeys& k) { return k.sides[side]; });
  }
  const bool corner_texels =
      mode == MipMode::corners || (mode == MipMode::least_squares && coloring_of(tiles) == Coloring::corner);
  if (corner_texels) add_corners(groups, size);
  return groups.take();
}

} // namespace tilepack
