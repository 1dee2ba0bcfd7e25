#include "tilepack/layout/de_bruijn.h"

#include "tilepack/error/error.h"
#include "tilepack/layout/tile_index.h"
#include "tilepack/tileset/limits.h"

#include <fmt/format.h>

#include <algorithm>

namespace tilepack {
namespace {

// Odd K. Let s be the cyclic sequence of the first colors of TileIndex1D: each ordered pair of colors occurs
// in it once, as neighbours. Every column is s shifted, and the shift from column c to c + 1 is c:
//
//   A[row][column] = s[(row + column (column - 1) / 2) mod n],   n = K²
//
// A vertical pair at place p of s beside one at place q then occurs only where column = q - p, so each 2 × 2
// block once. Going once round, the shifts add up to n (n - 1) / 2, which is 0 mod n for odd n: the torus
// closes. For even n it is n / 2, and it doesn't.
int odd_color(int n, int column, int row) {
  return color_pair_at((row + column * (column - 1) / 2) % n).first;
}

// Found by trying all 2^16 arrays; this is the first in lexicographic order.
constexpr int binary_torus[4][4] = {{0, 0, 0, 1}, {0, 0, 1, 0}, {1, 0, 1, 1}, {0, 1, 1, 1}};

// K = 4 doubles K = 2. The high bit repeats the 4 × 4 torus, so the place of a block mod 4 is known from its
// high bits. The low bits must tell the 16 places with these remainders apart, that is, spell the quotients
// X = column / 4 and Y = row / 4, two bits each: rows of even number carry a bit of Y, the others one of X,
// bit 0 in even columns and bit 1 in odd ones. Each 2 × 2 block holds one of each. Only its east column can
// lie in X + 1, and then it is an even one, whose bit is the opposite of bit 0 of X; so for Y.
int quaternary_color(int column, int row) {
  const int quotient = row % 2 == 0 ? row / 4 : column / 4;
  return 2 * binary_torus[row % 4][column % 4] + (quotient >> (column % 2)) % 2;
}

} // namespace

int de_bruijn_color(int corner_colors, int column, int row) {
  switch (corner_colors) {
  case 1:
  case 3:
    return odd_color(corner_colors * corner_colors, column, row);
  case 2:
    return binary_torus[row][column];
  case 4:
    return quaternary_color(column, row);
  default:
    throw Error(ErrorKind::usage, "layout de-bruijn",
                fmt::format("{} corner colors; 1 to {} have a stored torus", corner_colors,
                            limits::most_corner_colors));
  }
}

Layout de_bruijn_layout(const std::vector<CornerTile>& complete_set) {
  int colors = 0;
  for (const CornerTile& tile : complete_set)
    for (const int color : {tile.nw, tile.ne, tile.sw, tile.se}) {
      if (color < 0 || color >= limits::most_corner_colors)
        throw Error(
            ErrorKind::usage, "layout de-bruijn",
            fmt::format("corner color {}; colors are 0 to {} here", color, limits::most_corner_colors - 1));
      colors = std::max(colors, color + 1);
    }
  const int side = colors * colors;
  const int combinations = side * side;
  const int copies = whole_copies(complete_set.size(), combinations);
  Layout layout;
  layout.kind = LayoutKind::de_bruijn;
  layout.columns = side;
  layout.rows = copies * side;

  std::vector<int> given(static_cast<std::size_t>(copies) * static_cast<std::size_t>(combinations), -1);
  for (std::size_t id = 0; id < complete_set.size(); ++id) {
    const CornerTile& tile = complete_set[id];
    const std::size_t variant = id * static_cast<std::size_t>(copies) / complete_set.size();
    int& first = given[variant * static_cast<std::size_t>(combinations) +
                       static_cast<std::size_t>(id_in_complete_set(tile, colors))];
    if (first >= 0)
      throw Error(
          ErrorKind::invalid_content, "layout de-bruijn",
          fmt::format("tiles {} and {} have the same corner colors (nw {}, ne {}, sw {}, se {}); this "
                      "layout holds each combination once",
                      first, id, tile.nw, tile.ne, tile.sw, tile.se));
    first = static_cast<int>(id);
  }
  layout.cells.resize(complete_set.size());
  for (int row = 0; row < layout.rows; ++row)
    for (int column = 0; column < side; ++column) {
      const int east = (column + 1) % side;
      const int north = row % side;
      const int south = (row + 1) % side;
      const CornerTile tile{de_bruijn_color(colors, column, north), de_bruijn_color(colors, east, north),
                            de_bruijn_color(colors, column, south), de_bruijn_color(colors, east, south)};
      const int id =
          given[static_cast<std::size_t>(row / side * combinations + id_in_complete_set(tile, colors))];
      if (id < 0)
        throw Error(
            ErrorKind::invalid_content, "layout de-bruijn",
            fmt::format("no tile has nw {}, ne {}, sw {}, se {}; this layout needs all {} combinations "
                        "of {} corner colors; rotated and array do with fewer",
                        tile.nw, tile.ne, tile.sw, tile.se, combinations, colors));
      layout.cells[static_cast<std::size_t>(id)] = {id, column, row};
    }
  if (complete_set.empty())
    throw Error(ErrorKind::invalid_content, "layout de-bruijn", "no tiles; the set must be complete");
  return layout;
}

} // namespace tilepack
