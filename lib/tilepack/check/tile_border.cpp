#include "tilepack/check/tile_border.h"

#include "tilepack/tileset/border_colors.h"

#include <fmt/format.h>

#include <algorithm>

namespace tilepack {
namespace {

struct CornerPair {
  int first;
  int second;
};

CornerPair ends(const CornerTile& tile, Side side) {
  switch (side) {
  case Side::north:
    return {tile.nw, tile.ne};
  case Side::east:
    return {tile.ne, tile.se};
  case Side::south:
    return {tile.sw, tile.se};
  case Side::west:
    break;
  }
  return {tile.nw, tile.sw};
}

bool horizontal(Side side) {
  return side == Side::north || side == Side::south;
}

int length(Size tile, BorderStrip strip) {
  return std::max(0, (horizontal(strip.side) ? tile.width : tile.height) - 2 * strip.skip);
}

} // namespace

int border_key(const TileColors& tiles, int tile, Side side) {
  const BorderColors borders =
      std::visit([&](const auto& list) { return borders_of(list[static_cast<std::size_t>(tile)]); }, tiles);
  switch (side) {
  case Side::north:
    return borders.north;
  case Side::east:
    return borders.east;
  case Side::south:
    return borders.south;
  case Side::west:
    break;
  }
  return borders.west;
}

std::string border_text(const TileColors& tiles, int tile, Side side) {
  if (std::holds_alternative<std::vector<EdgeTile>>(tiles))
    return fmt::format("{} edge (color {})", name_of(side), border_key(tiles, tile, side));
  const CornerPair pair = ends(std::get<std::vector<CornerTile>>(tiles)[tile], side);
  return fmt::format("{} edge (corner colors {}, {})", name_of(side), pair.first, pair.second);
}

int texel_count(Size tile, BorderStrip strip) {
  return strip.rows * length(tile, strip);
}

Place texel_of(Size tile, BorderStrip strip, int index) {
  const int row = index / length(tile, strip);
  const int along = index % length(tile, strip) + strip.skip;
  switch (strip.side) {
  case Side::north:
    return {along, row};
  case Side::east:
    return {tile.width - 1 - row, along};
  case Side::south:
    return {along, tile.height - 1 - row};
  case Side::west:
    break;
  }
  return {row, along};
}

std::vector<float> values_of(const Image& image, Rect tile, BorderStrip strip) {
  const Size size{tile.width, tile.height};
  const int count = texel_count(size, strip);
  std::vector<float> values;
  values.reserve(static_cast<std::size_t>(count) * static_cast<std::size_t>(image.channels()));
  for (int i = 0; i < count; ++i) {
    const Place place = texel_of(size, strip, i);
    const auto texel = image.texel(tile.x + place.x, tile.y + place.y);
    values.insert(values.end(), texel.begin(), texel.end());
  }
  return values;
}

} // namespace tilepack
