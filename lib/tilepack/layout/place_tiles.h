#pragma once

#include "tilepack/image/resample.h"
#include "tilepack/layout/layout.h"
#include "tilepack/tileset/material_map.h"

#include <vector>

namespace tilepack {

/// What the texels just outside a tile are made of, where a layout stores them (gutters, borders) or a filter
/// reads them (turned tiles).
enum class Outside {
  neighbours, ///< tiles that may lie there: the pack's own where its colors match, else the first that fit
  own,        ///< the tile's own border texels repeated: nothing of another tile is read
};

struct PlaceOptions {
  ResampleFilter filter = ResampleFilter::lanczos; ///< rotated layouts
  Outside outside = Outside::neighbours;           ///<
};

/// The texture of one level: every tile of `tiles` (that level's tiles of one map) in its place.
///
/// Grids and arrays copy texels. A rotated layout resamples, each texel from the tile that owns it and in
/// that tile's own frame: in linear light for color (weighted by alpha), as vectors for normals. Values are
/// encoded as `tiles` are, not yet rounded. `tile_size` is that of level 0.
Image place_tiles(const TileMap& tiles, const TileColors& colors, const Layout& layout, Size tile_size,
                  int level, const PlaceOptions& options = {});

/// The tiles of one level back from its texture, by id. Grids and arrays: as they went in. Rotated: bilinear,
/// by weight over the texels that the tile owns and no others, so a tile of one color comes back exactly;
/// values as encoded in `texture`.
std::vector<Image> tiles_at_level(const Image& texture, const Layout& layout, Size tile_size, int level);

} // namespace tilepack
