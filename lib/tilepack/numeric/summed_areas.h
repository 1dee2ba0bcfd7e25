#pragma once

#include "tilepack/numeric/grid.h"
#include "tilepack/numeric/rect.h"

#include <algorithm>

namespace tilepack {

/// The sum over any rectangle of a plane in four look-ups, from a table of the sums over all rectangles that
/// begin at the north-west corner [Crow84].
///
/// `Sum` holds them: std::int64_t for integers, or double, which is exact as long as the values are whole
/// numbers and their sum stays below 2^53. A smaller integer will do where width × height × the largest value
/// fits into it.
///
///   const SummedAreas<std::int64_t> areas(grid);
///   areas.sum({x, y, 8, 8});             // of what lies inside of the grid
template <class Sum>
class SummedAreas {
public:
  SummedAreas() = default; ///< of nothing: all sums are 0

  template <class T>
  explicit SummedAreas(const Grid<T>& grid)
      : SummedAreas(grid.width, grid.height, [&](int x, int y) { return grid.at(x, y); }) {}

  /// Of the values value_at(x, y), which is called once each, row by row.
  template <class ValueAt>
  SummedAreas(int width, int height, const ValueAt& value_at) : table(width + 1, height + 1) {
    for (int y = 0; y < height; ++y) {
      Sum run{};
      for (int x = 0; x < width; ++x) {
        run = static_cast<Sum>(run + static_cast<Sum>(value_at(x, y)));
        table.at(x + 1, y + 1) = static_cast<Sum>(table.at(x + 1, y) + run);
      }
    }
  }

  int width() const { return std::max(0, table.width - 1); }
  int height() const { return std::max(0, table.height - 1); }

  /// The part of `area` that lies inside; width and height are 0 where there is none.
  Rect inside(Rect area) const {
    const int x0 = std::clamp(area.x, 0, width());
    const int y0 = std::clamp(area.y, 0, height());
    return {x0, y0, std::clamp(area.x + area.width, x0, width()) - x0,
            std::clamp(area.y + area.height, y0, height()) - y0};
  }

  /// Over the part of `area` that lies inside; 0 if there is none.
  Sum sum(Rect area) const {
    const Rect r = inside(area);
    if (r.width == 0 || r.height == 0) return Sum{};
    return static_cast<Sum>(table.at(r.x + r.width, r.y + r.height) - table.at(r.x + r.width, r.y) -
                            table.at(r.x, r.y + r.height) + table.at(r.x, r.y));
  }

  /// sum() by the number of values it was taken over; 0 if there is none.
  double mean(Rect area) const {
    const Rect r = inside(area);
    const double count = static_cast<double>(r.width) * r.height;
    return count > 0 ? static_cast<double>(sum(r)) / count : 0.0;
  }

  Sum sum() const { return table.empty() ? Sum{} : table.values.back(); }
  double mean() const { return mean({0, 0, width(), height()}); }

private:
  Grid<Sum> table; // (x, y): the sum of all values west of x and north of y
};

} // namespace tilepack
