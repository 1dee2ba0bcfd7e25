#include "tilepack/mip/value_space.h"

#include "tilepack/image/encoding.h"
#include "tilepack/mip/srgb_tables.h"

#include <cmath>
#include <cstddef>

namespace tilepack {
namespace {

void make_unit(float* n) {
  const double squares =
      static_cast<double>(n[0]) * n[0] + static_cast<double>(n[1]) * n[1] + static_cast<double>(n[2]) * n[2];
  if (!(squares > 0)) {
    n[2] = 1.0f;
    return;
  }
  const double length = std::sqrt(squares);
  for (int c = 0; c < 3; ++c) n[c] = static_cast<float>(n[c] / length);
}

void make_unit(Image& tile) {
  const std::size_t channels = static_cast<std::size_t>(tile.channels());
  if (channels < 3) return;
  for (std::size_t i = 0; i < tile.data().size(); i += channels) make_unit(&tile.data()[i]);
}

} // namespace

Image decoded(const Image& tile, const TileMap& map) {
  if (map.role == Role::color) return to_linear(tile, map.encoding);
  Image result = tile;
  if (map.role != Role::normal) return result;
  for (float& v : result.data()) v = v * 2.0f - 1.0f;
  make_unit(result);
  return result;
}

Image halved_decoded(const Image& tile, const TileMap& map) {
  const bool codes = map.role == Role::color && map.encoding == Encoding::srgb && map.depth == Depth::u8;
  if (codes && tile.channels() % 2 == 1) return halved_from_srgb(tile);
  return halved(decoded(tile, map), weighting_of(map));
}

Image encoded(Image tile, const TileMap& map) {
  if (map.role == Role::color) {
    if (map.encoding == Encoding::srgb) encode_srgb(tile);
    return tile;
  }
  if (map.role != Role::normal) return tile;
  make_unit(tile);
  for (float& v : tile.data()) v = v * 0.5f + 0.5f;
  return tile;
}

Weighting weighting_of(const TileMap& map) {
  const bool alpha = map.role == Role::color && !map.tiles.empty() && map.tiles.front().channels() % 2 == 0;
  return alpha ? Weighting::by_alpha : Weighting::plain;
}

} // namespace tilepack
