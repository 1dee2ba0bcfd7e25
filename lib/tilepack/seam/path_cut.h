#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace tilepack {

/// Two materials overlap in a grid; how different they are at each of its texels.
struct MismatchGrid {
  int rows = 0;
  int columns = 0;
  std::vector<std::int64_t> values; ///< row by row, >= 0

  std::int64_t at(int row, int column) const {
    return values[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                  static_cast<std::size_t>(column)];
  }
};

/// The columns between which a cut may cross a row: first <= cut <= last, each in 0..columns.
struct CutRange {
  int first = 0;
  int last = 0;
};

/// A cut from the first row of a grid to the last: in row r the left material covers columns before
/// column[r], the right one the rest.
struct PathCut {
  std::vector<int> column;
  std::int64_t cost = 0;
};

/// What a cut costs: for each pair of neighbouring texels (beside or below one another) that it separates,
/// the mismatch at both. After the last row the cut goes on to `end_column`, and the texels of the last row
/// between there and column[last] are counted once more: below them the other material begins.
std::int64_t cut_cost(const MismatchGrid& grid, std::span<const int> column, int end_column);

/// The cheapest of all cuts within `allowed` (one range a row), by dynamic programming over rows [EF01]; the
/// cut may move any number of columns between two rows. Of equal ones the one that ends furthest left. Time
/// grows with rows * columns.
PathCut minimum_error_cut(const MismatchGrid& grid, std::span<const CutRange> allowed, int end_column);

} // namespace tilepack
