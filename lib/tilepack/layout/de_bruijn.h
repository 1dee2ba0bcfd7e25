#pragma once

#include "tilepack/layout/layout.h"

namespace tilepack {

/// A de Bruijn torus: a K² × K² array of corner colors 0..K-1, wrapping at its borders, in which every 2 × 2
/// block of colors occurs exactly once. Read as lattice points, it holds the complete corner-colored set
/// [LD06] with every neighbour agreeing along edges *and* at corners, so a bilinear fetch reads the right
/// texels everywhere, with one texture and no gutter.
///
///   K = 2:   0 0 0 1      the tile at (column, row) has nw there, ne to the east, sw to the south,
///            0 0 1 0      se to the south-east
///            1 0 1 1
///            0 1 1 1
///
/// K is 1 to 4; 0 <= column, row < K². Odd K by a closed form, K = 2 from a table, K = 4 from the torus of
/// K = 2 (see de_bruijn.cpp). Throws Error (usage) for other K.
int de_bruijn_color(int corner_colors, int column, int row);

/// The complete corner set in the de Bruijn torus of its colors; of variants, a complete set after the other, as many
/// copies of the torus one below the other, which agree where they meet, and the whole wraps. Throws Error: usage for more than 4 colors,
/// invalid_content naming the tile that is missing or there twice.
Layout de_bruijn_layout(const std::vector<CornerTile>& complete_set);

} // namespace tilepack
