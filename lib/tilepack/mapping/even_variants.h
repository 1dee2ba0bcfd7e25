#pragma once

#include <vector>

namespace tilepack {

/// The variants of the cells of an even pattern (mapping/even_pattern.h), 64 x 64 row by row, each 0..variants-1:
/// the one of the cell whose north-west corner is there. Tiles of equal colors and equal variant are equal, so
/// variants are chosen such that in whatever window of 8 x 8 tiles no displacement of up to 4 tiles brings many
/// tiles onto equal ones, and equal tiles seldom lie side by side.
///
/// One cell after the other is given another variant; what worsens the sum of the fourth powers of all shares of
/// equal pairs by more than a threshold, which falls to nothing, is taken back. Cells of equal colors and different
/// variants count some, for they share their frame; and variants of one combination are to be about equally
/// frequent. All of it in integers: the same everywhere. About a tenth of a second.
///
/// pattern: even_pattern(colors); variants: 1..8.
std::vector<int> even_variants(const std::vector<int>& pattern, int colors, int variants);

} // namespace tilepack
