#include "tilepack/numeric/random.h"
#include "tilepack/seam/path_cut.h"

#include <catch2/catch.hpp>

using namespace tilepack;

namespace {

MismatchGrid random_grid(int rows, int columns, std::uint64_t seed) {
  MismatchGrid grid{rows, columns, {}};
  for (int i = 0; i < rows * columns; ++i)
    grid.values.push_back(random_below(seed, "grid", static_cast<std::uint64_t>(i), 50));
  return grid;
}

// All cuts within the ranges, one by one.
std::int64_t cheapest_by_trying(const MismatchGrid& grid, const std::vector<CutRange>& allowed, int end) {
  std::vector<int> column;
  for (const CutRange& range : allowed) column.push_back(range.first);
  std::int64_t best = cut_cost(grid, column, end);
  for (;;) {
    std::size_t row = 0;
    while (row < column.size() && column[row] == allowed[row].last) {
      column[row] = allowed[row].first;
      ++row;
    }
    if (row == column.size()) return best;
    ++column[row];
    best = std::min(best, cut_cost(grid, column, end));
  }
}

} // namespace

TEST_CASE("a minimum-error cut is as cheap as the best of all cuts") {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const int rows = 1 + static_cast<int>(seed % 5);
    const int columns = 1 + static_cast<int>(seed % 4);
    const MismatchGrid grid = random_grid(rows, columns, seed);
    std::vector<CutRange> allowed;
    for (int row = 0; row < rows; ++row) {
      const int a = static_cast<int>(
          random_below(seed, "a", static_cast<std::uint64_t>(row), static_cast<std::uint32_t>(columns + 1)));
      const int b = static_cast<int>(
          random_below(seed, "b", static_cast<std::uint64_t>(row), static_cast<std::uint32_t>(columns + 1)));
      allowed.push_back({std::min(a, b), std::max(a, b)});
    }
    const int end = static_cast<int>(random_below(seed, "end", 0, static_cast<std::uint32_t>(columns + 1)));
    const PathCut cut = minimum_error_cut(grid, allowed, end);
    CHECK(cut.cost == cheapest_by_trying(grid, allowed, end));
    CHECK(cut.cost == cut_cost(grid, cut.column, end));
    for (std::size_t row = 0; row < allowed.size(); ++row) {
      CHECK(cut.column[row] >= allowed[row].first);
      CHECK(cut.column[row] <= allowed[row].last);
    }
  }
}

TEST_CASE("a minimum-error cut costs no more than any straight one") {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const MismatchGrid grid = random_grid(40, 17, seed);
    const std::vector<CutRange> allowed(40, CutRange{0, 17});
    const PathCut cut = minimum_error_cut(grid, allowed, 8);
    for (int c = 0; c <= 17; ++c) CHECK(cut.cost <= cut_cost(grid, std::vector<int>(40, c), 8));
  }
}

TEST_CASE("a cut follows the texels where the materials are equal") {
  // Mismatch 9 everywhere but along a staircase of zeros; a free path leads between two zeros of a row.
  MismatchGrid grid{4, 6, std::vector<std::int64_t>(24, 9)};
  const std::vector<int> path{1, 2, 3, 4};
  for (int row = 0; row < 4; ++row)
    for (int x = path[static_cast<std::size_t>(row)] - 1; x <= path[static_cast<std::size_t>(row)] + 1; ++x)
      grid.values[static_cast<std::size_t>(row * 6 + x)] = 0;
  const PathCut cut = minimum_error_cut(grid, std::vector<CutRange>(4, CutRange{0, 6}), 4);
  CHECK(cut.cost == cut_cost(grid, cut.column, 4));
  CHECK(cut.cost == 0);
}
