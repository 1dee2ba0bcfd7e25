#pragma once

#include "tilepack/numeric/grid.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace tilepack {

/// A choice between several layers for each texel of a rectangle, which costs what the texel costs in its layer and, for
/// each two neighbours that show different ones, what the border between them costs there. A texel has eight neighbours.
struct LabelProblem {
  Size size;
  int labels = 2;                   ///< 1..127
  Grid<std::int8_t> forced;         ///< the label that a texel must have; `free_label`: any
  std::vector<std::int64_t> prices; ///< label by label, in each row by row

  /// What it costs that texel (x, y) shows layer a and its neighbour at (x + dx, y + dy) shows layer b, a != b; >= 0.
  /// (dx, dy) is (1, 0), (0, 1), (1, 1) or (-1, 1).
  std::function<std::int64_t(int x, int y, int dx, int dy, int a, int b)> border;

  std::int64_t price(int label, std::size_t texel) const {
    return prices[static_cast<std::size_t>(label) * forced.values.size() + texel];
  }
};
constexpr std::int8_t free_label = -1;

/// What a choice costs.
std::int64_t cost_of(const LabelProblem& problem, const Grid<std::uint8_t>& labels);

/// The choice that costs least. Of two labels exactly (one minimum cut); of more by moves, each of
/// them the best way to give any set of texels one label (a minimum cut), until none brings anything, four times round at
/// most.
/// Deterministic.
Grid<std::uint8_t> least_labels(const LabelProblem& problem);

} // namespace tilepack
