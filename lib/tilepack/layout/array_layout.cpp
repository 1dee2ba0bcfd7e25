#include "tilepack/layout/array_layout.h"

#include "tilepack/error/error.h"
#include "tilepack/tileset/limits.h"

#include <fmt/format.h>

#include <algorithm>

namespace tilepack {

Layout array_layout(int tiles, Size tile_size, int border) {
  if (tiles < 1 || tiles > limits::most_tiles)
    throw Error(ErrorKind::usage, "layout array",
                fmt::format("{} tiles; 1 to {}", tiles, limits::most_tiles));
  const int half = std::min(tile_size.width, tile_size.height) / 2;
  if (border < 0 || border > half || (border & (border - 1)) != 0)
    throw Error(ErrorKind::usage, field("border"),
                fmt::format("{} texels; 0 or a power of two up to half the tile, {}", border, half));
  Layout layout;
  layout.kind = LayoutKind::array;
  layout.columns = 1;
  layout.rows = tiles;
  layout.border = border;
  for (int tile = 0; tile < tiles; ++tile) layout.cells.push_back({tile, 0, tile});
  return layout;
}

} // namespace tilepack
