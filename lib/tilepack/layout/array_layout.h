#pragma once

#include "tilepack/layout/layout.h"

namespace tilepack {

/// One tile a layer of a texture array. In the image of a level the layers lie below each other, tile 0 on
/// top, so that its texels in file order are those of the array, layer by layer, as engines upload them.
///
///   +--------+
///   | +----+ |
///   | | 0  | |   layer 0: tile 0, round it `border` texels of what may lie there (see place_tiles)
///   | +----+ |
///   +--------+
///   | +----+ |
///   | | 1  | |   layer 1
///   | +----+ |
///   +--------+
///
/// With borders, bilinear filtering at a tile's border reads them instead of being clamped. All layers halve
/// from level to level, and so does the border; the levels end with a border of one texel. `border` is 0 or a
/// power of two, at most half the shorter side of the tile; Error (usage) otherwise, or for a tile count
/// outside 1..limits::most_tiles.
Layout array_layout(int tiles, Size tile_size, int border);

} // namespace tilepack
