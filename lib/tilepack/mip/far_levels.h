#pragma once

#include "tilepack/layout/layout.h"
#include "tilepack/tileset/material_map.h"

#include <vector>

namespace tilepack {

/// Far levels: what a mip chain goes on with where tiles have no more levels, for engines that read every level down to
/// one texel whether it is there or not. They are levels of the packed texture as a whole, each side half the
/// finer one's, rounded down and at least one texel, as graphics hardware counts; of an array each layer's own. Past
/// one texel a tile nothing depends any more on which tiles are neighbours in the virtual texture, but for
/// their mean: far levels lead there.

/// Their sizes, finest first, after `tile_levels` levels of tiles: of all layers one below the other. Empty where the
/// last level of tiles is one texel (a layer).
std::vector<Size> far_level_sizes(const Layout& layout, Size tile_size, int tile_levels);

/// A level of the packed texture, values as stored; `map` tells what they mean.
struct PlacedLevel {
  const Image& texels;
  const TileMap& map; ///< with a tile at least
};

/// The far levels of a map, from its last level of tiles: every texel is the mean of what it covers there, so that the
/// last one is the mean of the texture (or of each layer). Light, alpha and vectors are averaged as mip_chain() does it.
/// `normals`, of the same size, is the map whose spread roughness takes up; null where it takes up none. Encoded,
/// and not yet rounded.
std::vector<Image> far_levels(const PlacedLevel& last, int layers, const std::vector<Size>& sizes,
                              const PlacedLevel* normals = nullptr);

} // namespace tilepack
