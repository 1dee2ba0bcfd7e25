#include "tilepack/match/use_counts.h"

#include <algorithm>

namespace tilepack {

UseCounts::UseCounts(int image_width, int image_height, int square_side)
    : square(square_side), columns((image_width + square - 1) / square),
      rows((image_height + square - 1) / square),
      count(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows)) {}

void UseCounts::set_reuse_weight(Rect area, int price) {
  if (prices.empty()) prices.assign(count.size(), 1);
  const Bounds b = bounds(area);
  for (std::size_t j = b.first_y; j < b.last_y; ++j)
    for (std::size_t i = b.first_x; i < b.last_x; ++i)
      prices[j * static_cast<std::size_t>(columns) + i] = price;
}

void UseCounts::add(Rect area, double weight) {
  const Bounds b = bounds(area);
  for (std::size_t j = b.first_y; j < b.last_y; ++j)
    for (std::size_t i = b.first_x; i < b.last_x; ++i) {
      const std::size_t n = j * static_cast<std::size_t>(columns) + i;
      count[n] += prices.empty() ? weight : weight * prices[n];
    }
}

void UseCounts::prepare() {
  const std::size_t stride = static_cast<std::size_t>(columns) + 1;
  sums.assign(stride * (static_cast<std::size_t>(rows) + 1), 0.0);
  for (std::size_t j = 0; j < static_cast<std::size_t>(rows); ++j) {
    double run = 0.0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(columns); ++i) {
      run += count[j * static_cast<std::size_t>(columns) + i];
      sums[(j + 1) * stride + i + 1] = sums[j * stride + i + 1] + run;
    }
  }
}

double UseCounts::mean(Rect area) const {
  const Bounds b = bounds(area);
  const std::size_t stride = static_cast<std::size_t>(columns) + 1;
  const double total = sums[b.last_y * stride + b.last_x] - sums[b.first_y * stride + b.last_x] -
                       sums[b.last_y * stride + b.first_x] + sums[b.first_y * stride + b.first_x];
  return total / static_cast<double>((b.last_x - b.first_x) * (b.last_y - b.first_y));
}

double UseCounts::mean() const {
  return sums.back() / static_cast<double>(count.size());
}

// Whole squares: those at least half of which lie inside, and one at least.
UseCounts::Bounds UseCounts::bounds(Rect a) const {
  const auto rounded = [&](int v) { return std::max(0, (v + square / 2) / square); };
  const int x = std::min(rounded(a.x), columns - 1);
  const int y = std::min(rounded(a.y), rows - 1);
  const int last_x = std::min(columns, std::max(x + 1, rounded(a.x + a.width)));
  const int last_y = std::min(rows, std::max(y + 1, rounded(a.y + a.height)));
  return {static_cast<std::size_t>(x), static_cast<std::size_t>(y), static_cast<std::size_t>(last_x),
          static_cast<std::size_t>(last_y)};
}

} // namespace tilepack
