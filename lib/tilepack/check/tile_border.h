#pragma once

#include "tilepack/image/image.h"
#include "tilepack/mip/shared_border.h"
#include "tilepack/numeric/enum_names.h"
#include "tilepack/tileset/tile_colors.h"

#include <string>
#include <string_view>
#include <vector>

namespace tilepack {

enum class Side { north, east, south, west };
inline constexpr Side all_sides[] = {Side::north, Side::east, Side::south, Side::west};

template <>
inline constexpr auto enum_names<Side> =
    std::array{EnumName{Side::north, "north"}, EnumName{Side::east, "east"}, EnumName{Side::south, "south"},
               EnumName{Side::west, "west"}};

/// The color of one side of a tile as one number (BorderColors). Two tiles fit across a border when the east
/// key of one is the west key of the other, or south and north.
int border_key(const TileColors& tiles, int tile, Side side);

/// "north edge (color 1)" or "north edge (corner colors 0, 1)".
std::string border_text(const TileColors& tiles, int tile, Side side);

/// The strip of a tile along one side: `rows` texels deep, `skip` texels left out at either end.
struct BorderStrip {
  Side side = Side::north;
  int rows = 1;
  int skip = 0;
};

/// Texels in a strip of a tile of this size: rows * (length - 2 * skip), 0 if the skips meet.
int texel_count(Size tile, BorderStrip strip);

/// Number `index` of the strip's texels in the tile: outermost row first, then from west to east or from
/// north to south.
Place texel_of(Size tile, BorderStrip strip, int index);

/// All channels of the strip's texels in that order; `tile` is the tile's rectangle in `image`.
std::vector<float> values_of(const Image& image, Rect tile, BorderStrip strip);

} // namespace tilepack
