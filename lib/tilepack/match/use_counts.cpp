#include "tilepack/match/use_counts.h"

#include <algorithm>

namespace tilepack {

UseSquares::Bounds UseSquares::bounds(Rect a) const {
  const auto rounded = [&](int v) { return std::max(0, (v + side / 2) / side); };
  const int x = std::min(rounded(a.x), columns - 1);
  const int y = std::min(rounded(a.y), rows - 1);
  const int last_x = std::min(columns, std::max(x + 1, rounded(a.x + a.width)));
  const int last_y = std::min(rows, std::max(y + 1, rounded(a.y + a.height)));
  return {static_cast<std::size_t>(x), static_cast<std::size_t>(y), static_cast<std::size_t>(last_x),
          static_cast<std::size_t>(last_y)};
}

UseCounts::UseCounts(int image_width, int image_height, int square_side)
    : squares{square_side, (image_width + square_side - 1) / square_side,
              (image_height + square_side - 1) / square_side},
      counts(static_cast<std::size_t>(squares.columns) * static_cast<std::size_t>(squares.rows)) {}

void UseCounts::set_reuse_weight(Rect area, int weight) {
  if (reuse_weights.empty()) reuse_weights.assign(counts.size(), 1);
  const UseSquares::Bounds b = squares.bounds(area);
  for (std::size_t j = b.first_y; j < b.last_y; ++j)
    for (std::size_t i = b.first_x; i < b.last_x; ++i)
      reuse_weights[j * static_cast<std::size_t>(squares.columns) + i] = weight;
}

void UseCounts::add(Rect area, double weight) {
  const UseSquares::Bounds b = squares.bounds(area);
  for (std::size_t j = b.first_y; j < b.last_y; ++j)
    for (std::size_t i = b.first_x; i < b.last_x; ++i) {
      const std::size_t n = j * static_cast<std::size_t>(squares.columns) + i;
      counts[n] += reuse_weights.empty() ? weight : weight * reuse_weights[n];
    }
}

UseTable prepared(const UseCounts& counts) {
  UseTable table(counts.squares);
  const auto columns = static_cast<std::size_t>(counts.squares.columns);
  const auto rows = static_cast<std::size_t>(counts.squares.rows);
  const std::size_t stride = columns + 1;
  table.sums.assign(stride * (rows + 1), 0.0);
  for (std::size_t j = 0; j < rows; ++j) {
    double run = 0.0;
    for (std::size_t i = 0; i < columns; ++i) {
      run += counts.counts[j * columns + i];
      table.sums[(j + 1) * stride + i + 1] = table.sums[j * stride + i + 1] + run;
    }
  }
  return table;
}

double UseTable::mean(Rect area) const {
  const UseSquares::Bounds b = squares.bounds(area);
  const std::size_t stride = static_cast<std::size_t>(squares.columns) + 1;
  const double total = sums[b.last_y * stride + b.last_x] - sums[b.first_y * stride + b.last_x] -
                       sums[b.last_y * stride + b.first_x] + sums[b.first_y * stride + b.first_x];
  return total / static_cast<double>((b.last_x - b.first_x) * (b.last_y - b.first_y));
}

double UseTable::mean() const {
  return sums.back() / (static_cast<double>(squares.columns) * static_cast<double>(squares.rows));
}

} // namespace tilepack
