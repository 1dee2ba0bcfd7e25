#include "tilepack/seam/path_cut.h"

#include <algorithm>
#include <limits>

namespace tilepack {
namespace {

// Crossing row `row` at `column` separates the texels column - 1 and column; at the ends of a row nothing.
std::int64_t crossing_cost(const MismatchGrid& grid, int row, int column) {
  if (column <= 0 || column >= grid.columns) return 0;
  return grid.at(row, column - 1) + grid.at(row, column);
}

// Moving from column a in `row` to column b in the next separates the texels between a and b from those
// below.
std::int64_t level_cost(const MismatchGrid& grid, int row, int x) {
  const int below = std::min(row + 1, grid.rows - 1);
  return grid.at(row, x) + grid.at(below, x);
}

} // namespace

std::int64_t cut_cost(const MismatchGrid& grid, std::span<const int> column, int end_column) {
  std::int64_t cost = 0;
  for (int row = 0; row < grid.rows; ++row) {
    const int here = column[static_cast<std::size_t>(row)];
    const int next = row + 1 < grid.rows ? column[static_cast<std::size_t>(row) + 1] : end_column;
    cost += crossing_cost(grid, row, here);
    for (int x = std::min(here, next); x < std::max(here, next); ++x) cost += level_cost(grid, row, x);
  }
  return cost;
}

PathCut minimum_error_cut(const MismatchGrid& grid, std::span<const CutRange> allowed, int end_column) {
  constexpr std::int64_t never = std::numeric_limits<std::int64_t>::max();
  const std::size_t width = static_cast<std::size_t>(grid.columns) + 1;
  const std::size_t rows = static_cast<std::size_t>(grid.rows);
  std::vector<std::int64_t> best(width, never); // cost of the cheapest cut that crosses this row here
  std::vector<std::int64_t> next(width, never);
  std::vector<int> from(width * rows, 0); // where it crossed the row before
  for (int c = allowed[0].first; c <= allowed[0].last; ++c)
    best[static_cast<std::size_t>(c)] = crossing_cost(grid, 0, c);

  // One sweep to the right and one to the left reach every move: a longer move is a shorter one plus one
  // level cost.
  const auto moved = [&](int row, const CutRange& target, int* origins) {
    std::fill(next.begin(), next.end(), never);
    std::int64_t carried = never;
    int origin = 0;
    for (int c = 0; c <= grid.columns; ++c) {
      if (carried != never) carried += level_cost(grid, row, c - 1);
      if (best[static_cast<std::size_t>(c)] < carried) {
        carried = best[static_cast<std::size_t>(c)];
        origin = c;
      }
      if (c >= target.first && c <= target.last && carried != never) {
        next[static_cast<std::size_t>(c)] = carried;
        origins[c] = origin;
      }
    }
    carried = never;
    for (int c = grid.columns; c >= 0; --c) {
      if (carried != never) carried += level_cost(grid, row, c);
      if (best[static_cast<std::size_t>(c)] < carried) {
        carried = best[static_cast<std::size_t>(c)];
        origin = c;
      }
      if (c >= target.first && c <= target.last && carried < next[static_cast<std::size_t>(c)]) {
        next[static_cast<std::size_t>(c)] = carried;
        origins[c] = origin;
      }
    }
  };

  for (int row = 1; row < grid.rows; ++row) {
    const CutRange& range = allowed[static_cast<std::size_t>(row)];
    moved(row - 1, range, from.data() + width * static_cast<std::size_t>(row));
    for (int c = range.first; c <= range.last; ++c)
      next[static_cast<std::size_t>(c)] += crossing_cost(grid, row, c);
    std::swap(best, next);
  }
  std::vector<int> last_origin(width, 0);
  moved(grid.rows - 1, {end_column, end_column}, last_origin.data());

  PathCut cut{std::vector<int>(rows), next[static_cast<std::size_t>(end_column)]};
  int column = last_origin[static_cast<std::size_t>(end_column)];
  for (std::size_t row = rows; row-- > 0;) {
    cut.column[row] = column;
    column = from[width * row + static_cast<std::size_t>(column)];
  }
  return cut;
}

} // namespace tilepack
