#pragma once

#include "tilepack/image/image.h"
#include "tilepack/mip/mip_mode.h"
#include "tilepack/tileset/tile_colors.h"

#include <vector>

namespace tilepack {

/// A place within a tile: 0 <= x < width, 0 <= y < height of the level.
struct Place {
  int x = 0;
  int y = 0;
  bool operator==(const Place&) const = default;
};

/// Tiles that must hold the same value, place for place.
struct SharedTexels {
  std::vector<int> tiles;    ///< ids, ascending
  std::vector<Place> places; ///< each place for itself is one value, shared by all of `tiles`
};

/// What a sanitized level of tiles of `size` promises: for every group, its tiles are equal at its places.
///
/// The promise is what makes bilinear filtering through the pack continuous. Take an edge of color c, tile A
/// north of it and B south of it. Just above the edge the filter stands in A and reads A's last row a and,
/// below it, the first row b' of whichever tile of north color c the *pack* has under A; just below, it
/// stands in B and reads b and the last row a' of the pack's tile over B. On the edge itself both weigh one
/// half, so the two sides meet if and only if a + b' = a' + b for all tiles that can stand there, that is, if
/// a is the same for all tiles of south color c and b the same for all tiles of north color c. The two rows
/// need not equal each other, so each is a class of its own (averaging both together would only lose the step
/// that the texture has there). Then also b' = b: what the filter sees is what the virtual texture has.
/// Columns likewise, and corner texels, of which a filter at a lattice point reads four.
///
///   none, box,
///   least_squares  no promise
///   edges          north rows by color, south rows by color, west and east columns by color, without the
///                  corner texels. Under corner coloring the color of an edge is the pair of its ends.
///   corners        and each corner texel: over all tiles under edge coloring, since any tile can lie
///                  diagonally across; by its own color under corner coloring
///
/// A side one texel long is both borders
/// at once, so both classes apply to it; they link all tiles of a complete set, and the places form one group
/// of all tiles.
std::vector<SharedTexels> shared_border(const TileColors& tiles, Size size, MipMode mode);

} // namespace tilepack
