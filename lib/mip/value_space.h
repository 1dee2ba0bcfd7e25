#pragma once

#include "tilepack/mip/downsample.h"
#include "tilepack/tileset/map.h"

namespace tilepack {

/// The values of a tile as they may be averaged: linear light for Role::color, unit vectors for normals of 3
/// or 4 channels (the first three; a stored vector is made a unit one first, since its length means nothing
/// but rounding), stored values for the rest.
Image decoded(const Image& tile, const TileMap& map);

/// halved(decoded(tile, map), weighting_of(map)).
Image halved_decoded(const Image& tile, const TileMap& map);

/// Back to what is stored. Vectors of any length are made unit ones; the null vector points up.
Image encoded(Image tile, const TileMap& map);

/// How the texels of `map` are averaged: by alpha for color of 2 or 4 channels.
Weighting weighting_of(const TileMap& map);

} // namespace tilepack
