#pragma once

#include "tilepack/mip/downsample.h"
#include "tilepack/tileset/material_map.h"

#include <span>

namespace tilepack {

/// The values of whole texels as they may be averaged: linear light for color and emissive, unit vectors for normals
/// of 3 or 4 channels (the first three; a stored vector is made a unit one first, since its length means
/// nothing but rounding), stored values for the rest. `to` has the length of `from`, and may be `from`.
void decode(std::span<const float> from, const TileMap& map, std::span<float> to);

/// Back to what is stored. Vectors of any length are made unit ones; the null vector points up.
void encode(std::span<const float> from, const TileMap& map, std::span<float> to);

/// halve_rows() of two rows as they are stored, decoded. Color in 8-bit codes takes a short cut.
void halve_decoded(std::span<const float> north, std::span<const float> south, const TileMap& map,
                   std::span<float> to);

/// How the texels of `map` are averaged: by alpha for color of 2 or 4 channels.
Weighting weighting_of(const TileMap& map);

} // namespace tilepack
