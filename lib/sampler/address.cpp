#include "tilepack/sampler/address.h"

#include "tilepack/image/wrap.h"

#include <cmath>

namespace tilepack {
namespace {

constexpr double tile_limit = 0x1p62;

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

} // namespace tilepack
