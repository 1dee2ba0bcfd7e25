#pragma once

#include "tilepack/mapping/mapping.h"

namespace tilepack {

/// Throws Error (usage) for the field "virtual-size" of an index map whose sides or cells are too few or too many.
void check_index_size(const VirtualSize& size);

/// An index map for any set of tiles, complete or not: filled row by row, from west to east, each cell with a
/// tile that fits its northern and western neighbours, chosen at random by `seed`.   [Cohen03]
///
///   * No avoidable repeats: a tile equal to its west or north neighbour is taken only where no other one
///     fits, and one equal to a corner neighbour only where the rest is worse.
///   * The map wraps: the last column fits the first and the last row the first. Rows that would make that
///     impossible are not chosen, or chosen anew.
///
/// Sides 1..65536 and at most 2^26 cells (Error, usage). Error (invalid_content) if no filling is found: some
/// sets have none, and small maps may have none that wraps.
Mapping filled_index_mapping(VirtualSize size, const TileColors& tiles, std::uint64_t seed);

} // namespace tilepack
