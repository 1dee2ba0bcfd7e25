#pragma once

#include "tilepack/numeric/enum_names.h"

#include <cstddef>
#include <variant>
#include <vector>

namespace tilepack {

/// What neighbours must agree on: the colors of the edge between them, or of the corners at its ends.
enum class Coloring { edge, corner };

template <>
inline constexpr auto enum_names<Coloring> =
    std::array{EnumName{Coloring::edge, "edge"}, EnumName{Coloring::corner, "corner"}};

/// The edge colors of a tile: integers 0..K-1, horizontal edges (north, south) and vertical ones (west, east)
/// numbered apart.
///
///            north
///          ┌───────┐
///     west │       │ east        the lattice: tile at cell (x, y) has
///          └───────┘             north = H(x, y), south = H(x, y+1), west = V(x, y), east = V(x+1, y)
///            south
struct EdgeTile {
  int north = 0;
  int east = 0;
  int south = 0;
  int west = 0;
  bool operator==(const EdgeTile&) const = default;
};

/// The corner colors of a tile, 0..K-1: tile at cell (x, y) has nw = C(x, y), ne = C(x+1, y), sw = C(x, y+1),
/// se = C(x+1, y+1).   [LD06]
///
///      nw ┌───┐ ne
///      sw └───┘ se
struct CornerTile {
  int nw = 0;
  int ne = 0;
  int sw = 0;
  int se = 0;
  bool operator==(const CornerTile&) const = default;
};

/// How many colors a set uses: horizontal and vertical for edge coloring, corner for corner coloring; the
/// others 0. And how many variants each combination of them has: tiles of equal colors with insides of their own.
struct ColorCounts {
  int horizontal = 0; ///< Kh, 1..8: colors of north and south edges
  int vertical = 0;   ///< Kv, 1..8: colors of west and east edges
  int corner = 0;     ///< K, 1..4
  int variants = 1;   ///< V, 1..8; more than 1 only of complete sets
  bool operator==(const ColorCounts&) const = default;
};

/// The tiles of a set; the index of a tile is its id.
using TileColors = std::variant<std::vector<EdgeTile>, std::vector<CornerTile>>;

/// The complete set, each combination once: Kh² · Kv² edge tiles or K⁴ corner tiles, ids in lexicographic
/// order of (north, east, south, west) or (nw, ne, sw, se), the last the fastest.
std::vector<EdgeTile> complete_edge_set(int horizontal_colors, int vertical_colors);
std::vector<CornerTile> complete_corner_set(int corner_colors);

/// How many combinations of these colors there are: (Kh · Kv)² or K⁴.
int combinations(const ColorCounts& colors);

/// The complete set of these counts: its variants one after the other, each a complete set as above, so that
/// id = variant · combinations + id of the colors.
TileColors complete_set(const ColorCounts& colors);

/// How many complete sets of so many combinations `tiles` tiles may be, one after the other: 1 where their number
/// is no multiple of it, or of more than 8.
int whole_copies(std::size_t tiles, int combinations);

/// The id of a tile in its complete set, of the first variant.
int id_in_complete_set(const EdgeTile& tile, int horizontal_colors, int vertical_colors);
int id_in_complete_set(const CornerTile& tile, int corner_colors);

/// The smallest counts that hold all colors of the tiles; variants where they are the complete set of these
/// counts, else 1.
ColorCounts color_counts(const TileColors& tiles);

/// True for a complete set of these counts in its usual order, with 1 to 8 variants, which is what lets a hash
/// of colors find a tile.
bool is_complete_set(const TileColors& tiles);

int tile_count(const TileColors& tiles);
Coloring coloring_of(const TileColors& tiles);

} // namespace tilepack
