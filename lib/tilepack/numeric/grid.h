#pragma once

#include "tilepack/numeric/rect.h"

#include <cstddef>
#include <span>
#include <type_traits>
#include <vector>

namespace tilepack {

/// A plane of values, row by row: row 0 on top, x east, y south. What the values are is said by its name.
///
///   Grid<int> uses(width, height);       // all 0
///   uses.at(x, y) += 1;                  // unchecked: 0 <= x < width, 0 <= y < height
///   for (const int n : uses.row(y)) ...
template <class T>
struct Grid {
  static_assert(!std::is_same_v<T, bool>, "bits of a std::vector have no address: take char");

  int width = 0;
  int height = 0;
  std::vector<T> values; ///< width * height of them

  Grid() = default;
  Grid(int columns, int rows, const T& fill = T{})
      : width(columns), height(rows),
        values(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), fill) {}
  explicit Grid(Size size, const T& fill = T{}) : Grid(size.width, size.height, fill) {}

  /// Where (x, y) stands in `values`.
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
  T& at(int x, int y) { return values[index(x, y)]; }
  const T& at(int x, int y) const { return values[index(x, y)]; }

  std::span<T> row(int y) { return {values.data() + index(0, y), static_cast<std::size_t>(width)}; }
  std::span<const T> row(int y) const {
    return {values.data() + index(0, y), static_cast<std::size_t>(width)};
  }

  bool inside(int x, int y) const { return x >= 0 && y >= 0 && x < width && y < height; }
  Size size() const { return {width, height}; }
  bool empty() const { return values.empty(); }

  bool operator==(const Grid&) const = default;
};

} // namespace tilepack
