#pragma once

#include "tilepack/image/image.h"
#include "tilepack/layout/rotated_scheme.h"
#include "tilepack/numeric/enum_names.h"
#include "tilepack/tileset/tile_colors.h"

#include <cstdint>
#include <string_view>
#include <vector>

namespace tilepack {

enum class LayoutKind {
  tile_index, ///< complete edge-colored set in a grid, neighbours agree along edges (tile_index.h)
  de_bruijn,  ///< complete corner-colored set in a grid, neighbours agree at corners too (de_bruijn.h)
  rotated,    ///< any N = n² + k² tiles (or twice that), turned, filling a torus (rotated_layout.h)
  array,      ///< one tile a layer of a texture array (array_layout.h)
};

template <>
inline constexpr auto enum_names<LayoutKind> =
    std::array{EnumName{LayoutKind::tile_index, "tile-index"}, EnumName{LayoutKind::de_bruijn, "de-bruijn"},
               EnumName{LayoutKind::rotated, "rotated"}, EnumName{LayoutKind::array, "array"}};

/// Where a tile sits in a grid of equal cells.
struct Cell {
  int tile = 0;   ///< id
  int column = 0; ///< 0..columns-1, from the west
  int row = 0;    ///< 0..rows-1, from the north
  bool operator==(const Cell&) const = default;
};

/// The outcome of a search for places that let every tile of a rotated layout agree with its neighbours.
enum class Matching {
  found,     ///< filtering across borders reads texels that could lie there in the plane: no gutter needed
  none,      ///< every arrangement was ruled out
  not_found, ///< the search ended at its limit
};

template <>
inline constexpr auto enum_names<Matching> =
    std::array{EnumName{Matching::found, "found"}, EnumName{Matching::none, "none"},
               EnumName{Matching::not_found, "not-found"}};

/// What a rotated layout adds: the scheme, and the texture it fills.
struct RotatedGrid {
  RotatedScheme scheme;
  int gutter = 0; ///< texels of level 0 round each tile that are its own continuation, 0..tile side
  Size size;      ///< of the texture at level 0, texels
  Matching matching = Matching::none; ///< of colors across all borders
  bool operator==(const RotatedGrid&) const = default;
};

/// The places of all tiles in one texture, each tile once.
///
///   tile_index, de_bruijn   a grid of columns × rows tiles; the texture wraps at its borders
///   array                   1 × N: the layers, one below the other, each with `border` texels round its
///   tile;
///                           nothing wraps, layers are apart
///   rotated                 the texture wraps; a cell's north-west corner (gutter included) lies at
///                           (column / columns, row / rows) of the texture's sides: the places that the
///                           scheme can reach form a fine grid, of which it uses N
struct Layout {
  LayoutKind kind = LayoutKind::tile_index;
  int columns = 0;
  int rows = 0;
  std::vector<Cell> cells; ///< in the order of the tiles' ids
  int border = 0;          ///< array: texels round each tile at level 0, halved from level to level
  RotatedGrid rotated;     ///< rotated only
  bool operator==(const Layout&) const = default;
};

/// The size of the texture at `level`, where a tile has tile_size texels at level 0.
Size texture_size(const Layout& layout, Size tile_size, int level);

/// How many of `tile_levels` levels the layout can hold: an array with borders ends where a border would be
/// half a texel; a rotated layout ends before tiles that own no texel.
int levels_held(const Layout& layout, Size tile_size, int tile_levels);

/// Where a tile lies in the texture of one level: the point (x, y) of the tile, as fractions 0..1 of its
/// sides, is at texel coordinate origin + x * east + y * south.
struct Placement {
  struct Vector {
    double x = 0;
    double y = 0;
    bool operator==(const Vector&) const = default;
  };
  Vector origin;
  Vector east;
  Vector south;

  Vector at(double x, double y) const {
    return {origin.x + x * east.x + y * south.x, origin.y + x * east.y + y * south.y};
  }
};

/// Exact for grids and arrays: origin and axes are whole texels there.
Placement placement(const Layout& layout, int tile, Size tile_size, int level);

/// A layout's geometry as words of 32 bits, from which the size of every level and the place of every tile
/// follow: what a lookup or a shader needs of it beside the cells. Sizes are in texels of level 0; level l has
/// each side, and the border, shifted right by l.
struct LayoutWords {
  std::uint32_t columns = 0;    ///< see Layout
  std::uint32_t rows = 0;       ///<
  std::uint32_t tile_width = 0; ///< 1..16384
  std::uint32_t tile_height = 0;
  std::uint32_t border = 0;        ///< array: round each tile; others 0
  std::uint32_t n = 0;             ///< rotated: the scheme's, n >= 1; others 0
  std::uint32_t k = 0;             ///< rotated: 0..n
  std::uint32_t squares = 0;       ///< rotated: 1 or 2
  std::uint32_t gutter = 0;        ///< rotated
  std::uint32_t texture_width = 0; ///< at level 0
  std::uint32_t texture_height = 0;
};

LayoutWords layout_words(const Layout& layout, Size tile_size);

/// As above, from words: of a level, and of the tile whose cell has this column and row.
Size texture_size(const LayoutWords& words, int level);
Placement placement(const LayoutWords& words, int column, int row, int level);

/// All tiles of one level of a grid layout (tile_index, de_bruijn, array without border) side by side: an
/// image of columns × rows tiles.
Image atlas(const std::vector<Image>& tiles, const Layout& layout);

/// The same, each tile given up once it is in its place: sets of large tiles are large.
Image atlas(std::vector<Image>&& tiles, const Layout& layout);

/// Inverse of atlas: the tiles by id, cut out of `image`, whose size must be a multiple of the grid.
std::vector<Image> tiles_of(const Image& image, const Layout& layout);

} // namespace tilepack
