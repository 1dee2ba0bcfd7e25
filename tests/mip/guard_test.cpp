#include "tilepack/layout/de_bruijn.h"
#include "tilepack/layout/tile_index.h"
#include "tilepack/mip/border_path.h"
#include "tilepack/mip/mip_chain.h"
#include "tilepack/numeric/random.h"
#include "tilepack/tileset/border_keys.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstddef>

using namespace tilepack;

namespace {

constexpr int side = 32;
constexpr int guard = 8;
constexpr int exact_levels = 4; // 0 to log2(guard)

std::size_t as_size(int i) {
  return static_cast<std::size_t>(i);
}

float noise(int kind, int key, int x, int y) {
  const auto index = static_cast<std::uint64_t>(((kind * 4096 + key) * side + y) * side + x);
  return static_cast<float>(random_below(1, "noise", index, 256)) / 255.0f;
}

// Tiles of noise whose bands of `guard` texels along an edge depend on its key alone, and whose corner
// squares depend on the corner's color if corners are colored; else, each tile has its own.
TileSet guarded_set(const TileColors& colors, const ColorCounts& counts) {
  TileSet set{{side, side}, counts, colors, {}, guard};
  const std::vector<BorderKeys> keys = border_keys(colors);
  const bool by_corner = coloring_of(colors) == Coloring::corner;
  TileMap map{"color", Role::color, Encoding::srgb, Depth::u8, {}};
  for (std::size_t id = 0; id < keys.size(); ++id) {
    Image tile(side, side, 1);
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        const bool west = x < guard;
        const bool east = x >= side - guard;
        const bool north = y < guard;
        const bool south = y >= side - guard;
        float v = noise(0, static_cast<int>(id), x, y);
        if ((west || east) && (north || south)) {
          const int corner =
              north ? (west ? BorderKeys::nw : BorderKeys::ne) : (west ? BorderKeys::sw : BorderKeys::se);
          if (by_corner) v = noise(1 + corner, keys[id].corners[as_size(corner)], x, y);
        } else if (west || east || north || south) {
          const int s = north   ? BorderKeys::north
                        : south ? BorderKeys::south
                        : west  ? BorderKeys::west
                                : BorderKeys::east;
          v = noise(5 + s, keys[id].sides[as_size(s)], x, y);
        }
        tile.texel(x, y)[0] = v;
      }
    map.tiles.push_back(tile);
  }
  set.maps.push_back(map);
  return set;
}

// The texel (x, y) of level tiles, as the filter sees it from `tile`, one texel beyond its border at most.
float seen(const std::vector<Image>& tiles, const PackNeighbours& pack, int tile, int x, int y) {
  const int n = tiles.front().width();
  const int dx = x < 0 ? -1 : x >= n ? 1 : 0;
  const int dy = y < 0 ? -1 : y >= n ? 1 : 0;
  const int place = (dy + 1) * 3 + dx + 1;
  const int there = pack.around[as_size(tile)][as_size(place < 4 ? place : place - 1)];
  return tiles[as_size(there)].texel(x - dx * n, y - dy * n)[0];
}

// Places where what is read over a border differs from what some legal neighbour in the plane holds there.
// `margin` texels at the ends of each side are left out.
int wrong_reads(const TileSet& set, const std::vector<Image>& tiles, const PackNeighbours& pack, int margin) {
  const std::vector<BorderKeys> keys = border_keys(set.tiles);
  const int n = tiles.front().width();
  int wrong = 0;
  for (int a = 0; a < static_cast<int>(keys.size()); ++a)
    for (int b = 0; b < static_cast<int>(keys.size()); ++b) {
      const auto& from = keys[as_size(a)];
      const auto& to = keys[as_size(b)];
      for (int i = margin; i < n - margin; ++i) {
        const Image& there = tiles[as_size(b)];
        if (from.sides[BorderKeys::south] == to.sides[BorderKeys::north])
          wrong += seen(tiles, pack, a, i, n) != there.texel(i, 0)[0];
        if (from.sides[BorderKeys::north] == to.sides[BorderKeys::south])
          wrong += seen(tiles, pack, a, i, -1) != there.texel(i, n - 1)[0];
        if (from.sides[BorderKeys::east] == to.sides[BorderKeys::west])
          wrong += seen(tiles, pack, a, n, i) != there.texel(0, i)[0];
        if (from.sides[BorderKeys::west] == to.sides[BorderKeys::east])
          wrong += seen(tiles, pack, a, -1, i) != there.texel(n - 1, i)[0];
      }
      if (margin == 0 && from.corners[BorderKeys::se] == to.corners[BorderKeys::nw])
        wrong += seen(tiles, pack, a, n, n) != tiles[as_size(b)].texel(0, 0)[0];
      if (margin == 0 && from.corners[BorderKeys::nw] == to.corners[BorderKeys::se])
        wrong += seen(tiles, pack, a, -1, -1) != tiles[as_size(b)].texel(n - 1, n - 1)[0];
    }
  return wrong;
}

MipOptions with(MipMode mode) {
  MipOptions options;
  options.mode = mode;
  return options;
}

} // namespace

// A bilinear filter reads the tile itself and what lies one texel beyond its border. The tile itself is a box
// at these levels; so if all that can be read beyond equals what every legal neighbour has there, filtering
// is exact at every position.

TEST_CASE(
    "corner colors with a guard band: exact everywhere at levels 0 to log2 of the guard, in every mode") {
  const auto colors = complete_corner_set(2);
  const TileSet set = guarded_set(colors, {0, 0, 2});
  const Layout layout = de_bruijn_layout(colors);
  const auto box = mip_chain(set, 0, with(MipMode::box), &layout);
  for (const MipMode mode : {MipMode::box, MipMode::edges, MipMode::corners, MipMode::least_squares}) {
    const auto chain = mip_chain(set, 0, with(mode), &layout);
    for (int level = 0; level < exact_levels; ++level) {
      CHECK(wrong_reads(set, chain[as_size(level)].tiles, pack_neighbours(layout), 0) == 0);
      CHECK(chain[as_size(level)].tiles == box[as_size(level)].tiles);
    }
  }
  CHECK(wrong_reads(set, box[exact_levels].tiles, pack_neighbours(layout), 0) > 0);
}

TEST_CASE("edge colors with a guard band: exact but for the corners' squares, in every mode") {
  const auto colors = complete_edge_set(2, 2);
  const TileSet set = guarded_set(colors, {2, 2, 0});
  const Layout layout = tile_index_layout(colors);
  for (const MipMode mode : {MipMode::box, MipMode::edges, MipMode::corners, MipMode::least_squares}) {
    const auto chain = mip_chain(set, 0, with(mode), &layout);
    for (int level = 0; level < exact_levels; ++level) {
      CHECK(wrong_reads(set, chain[as_size(level)].tiles, pack_neighbours(layout), guard >> level) == 0);
      CHECK(wrong_reads(set, chain[as_size(level)].tiles, pack_neighbours(layout), 0) > 0);
    }
  }
}
