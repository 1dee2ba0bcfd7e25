#pragma once

#include <cstdint>

namespace tilepack {

/// A coordinate along one axis of the virtual texture: a whole tile and the fraction within it. Kept apart so
/// that 2^31 tiles a side lose nothing: the fraction has all 52 bits wherever it lies.
struct TileCoordinate {
  std::int64_t tile = 0;
  double fraction = 0; ///< 0 <= fraction < 1 after normalised(); from the west or north border of the tile
};

/// The same place with 0 <= fraction < 1. NaN and infinities become fraction 0 of the same tile.
TileCoordinate normalised(TileCoordinate coordinate);

/// The place `texels` texels of a level (tile_side texels a tile) from the origin of the virtual texture.
TileCoordinate from_texels(double texels, int tile_side);

} // namespace tilepack
