#include "tilepack/sampler/address.h"

#include "tilepack/numeric/wrap.h"

#include <algorithm>
#include <cmath>

namespace tilepack {
namespace {

constexpr double tile_limit = 0x1p62;
constexpr double below_one = 1.0 - 0x1p-53;

// Unsigned, since a caller may hand in any tile: going round the 64-bit range is defined, overflow is not.
std::int64_t plus(std::int64_t a, std::int64_t b) {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) + static_cast<std::uint64_t>(b));
}

} // namespace

TileCoordinate normalised(TileCoordinate coordinate) {
  if (!(std::fabs(coordinate.fraction) < tile_limit)) return {coordinate.tile, 0.0};
  const double whole = std::floor(coordinate.fraction);
  const double fraction = coordinate.fraction - whole;
  const std::int64_t tile = plus(coordinate.tile, static_cast<std::int64_t>(whole));
  if (fraction >= 1.0) return {plus(tile, 1), 0.0}; // -1e-20 - floor(-1e-20) rounds to 1
  return {tile, fraction};
}

TileCoordinate from_texels(double texels, int tile_side) {
  if (!std::isfinite(texels)) return {};
  // fmod is exact, so the remainder keeps every bit that `texels` had.
  const double rest = std::fmod(texels, tile_side);
  return normalised({static_cast<std::int64_t>(
                         std::fabs(texels) / tile_side < tile_limit ? (texels - rest) / tile_side : 0.0),
                     rest / tile_side});
}

TileCoordinate from_texels(std::int64_t whole, double rest, int tile_side) {
  const std::int64_t texel = wrapped(whole, static_cast<std::int64_t>(tile_side));
  return normalised(
      {(whole - texel) / tile_side, (static_cast<double>(texel) + rest) / static_cast<double>(tile_side)});
}

std::int64_t within(std::int64_t index, std::int64_t count, WrapMode border) {
  switch (border) {
  case WrapMode::wrap:
    return wrapped(index, count);
  case WrapMode::clamp:
    return std::clamp<std::int64_t>(index, 0, count - 1);
  case WrapMode::mirror:
    break;
  }
  const std::int64_t turned = wrapped(index, 2 * count);
  return turned < count ? turned : 2 * count - 1 - turned;
}

TileCoordinate within(TileCoordinate coordinate, std::int64_t tiles, WrapMode border) {
  const TileCoordinate at = normalised(coordinate);
  const TileCoordinate far_end{tiles - 1, below_one};
  switch (border) {
  case WrapMode::wrap:
    return {wrapped(at.tile, tiles), at.fraction};
  case WrapMode::clamp:
    return at.tile < 0 ? TileCoordinate{} : at.tile < tiles ? at : far_end;
  case WrapMode::mirror:
    break;
  }
  const std::int64_t turned = wrapped(at.tile, 2 * tiles);
  if (turned < tiles) return {turned, at.fraction};
  // Counted from 2 * tiles downwards: a whole number is the start of its own tile, not the end of the one
  // before.
  const double rest = 1.0 - at.fraction;
  if (rest < 1.0) return {2 * tiles - 1 - turned, rest};
  return turned == tiles ? far_end : TileCoordinate{2 * tiles - turned, 0.0};
}

} // namespace tilepack
