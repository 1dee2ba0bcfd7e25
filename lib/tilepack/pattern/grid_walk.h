#pragma once

#include "tilepack/numeric/wrap.h"
#include "tilepack/pattern/tile_map.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace tilepack {

/// A place and how it moves along a row of pixels.
struct PatternRun {
  PatternPlace place; ///< of the first pixel's centre, in units
  double step_u = 0;  ///< units from pixel to pixel, to the right
  double step_v = 0;
  std::size_t count = 0;

  PatternPlace at(std::size_t i) const {
    const auto n = static_cast<double>(i);
    return {{place.u.tile, place.u.fraction + n * step_u}, {place.v.tile, place.v.fraction + n * step_v}};
  }
  PatternRun part(std::size_t first, std::size_t pixels) const { return {at(first), step_u, step_v, pixels}; }
};

/// A run of pixels on a grid: in which cell each lies, and where in it. Whatever follows from the cell is found once a
/// stretch of pixels that share it.
class GridWalk {
public:
  /// (shift_x, shift_y): added to places, in cells. -0.5 makes cells those between four centres.
  GridWalk(const TileMapping& grid, const PatternRun& run, double shift_x = 0, double shift_y = 0)
      : cells_x(grid.x.cells), cells_y(grid.y.cells), step_x(run.step_u * grid.x.ratio()),
        step_y(run.step_v * grid.y.ratio()), count(run.count) {
    const TileCoordinate u = grid.x.cell_of(run.place.u), v = grid.y.cell_of(run.place.v);
    base_x = u.tile;
    base_y = v.tile;
    from_x = u.fraction + shift_x;
    from_y = v.fraction + shift_y;
  }

  double x(std::size_t i) const {
    return from_x + static_cast<double>(i) * step_x;
  } ///< cells from first_cell()
  double y(std::size_t i) const { return from_y + static_cast<double>(i) * step_y; }
  /// x(first + k) - less for k = 0..pixels-1, and y alike, as floats.
  void places(std::size_t first, std::size_t pixels, double less_x, double less_y, float* out_x,
              float* out_y) const {
    fill(from_x - less_x, step_x, first, pixels, out_x);
    fill(from_y - less_y, step_y, first, pixels, out_y);
  }
  PatternCell first_cell() const { return {base_x, base_y}; }
  double cells_a_pixel_x() const { return step_x; }

  /// Where pixel i lies: the cell (within the grid) and the place in it.
  struct Spot {
    std::int64_t x = 0, y = 0; ///< whole cells from first_cell()
    double in_x = 0, in_y = 0; ///< 0..1
  };
  Spot spot(std::size_t i) const {
    const double at_x = x(i), at_y = y(i), whole_x = std::floor(at_x), whole_y = std::floor(at_y);
    return {static_cast<std::int64_t>(whole_x), static_cast<std::int64_t>(whole_y), at_x - whole_x,
            at_y - whole_y};
  }
  /// The cell of a spot, moved by (dx, dy) cells, within the grid.
  PatternCell cell(const Spot& spot, std::int64_t dx = 0, std::int64_t dy = 0) const {
    return {wrapped(base_x + spot.x + dx, cells_x), wrapped(base_y + spot.y + dy, cells_y)};
  }

  /// The end of the stretch of pixels from i on that lie in the cell of pixel i.
  std::size_t stretch_end(std::size_t i) const {
    return std::min(end_along(from_x, step_x, i), end_along(from_y, step_y, i));
  }

  /// The end of the pixels from i on that lie less than `cells` cells east of the west side of the cell of pixel i. For
  /// runs that go east along a row.
  std::size_t end_before(std::size_t i, double cells) const {
    const double limit = std::floor(x(i)) + cells;
    const double steps =
        std::clamp((limit - from_x) / step_x, static_cast<double>(i + 1), static_cast<double>(count));
    auto end = static_cast<std::size_t>(steps);
    while (end > i + 1 && x(end - 1) >= limit) --end;
    while (end < count && x(end) < limit) ++end;
    return end;
  }

private:
  static void fill(double from, double step, std::size_t first, std::size_t pixels, float* out) {
    const auto begin = static_cast<std::int32_t>(first), end = static_cast<std::int32_t>(first + pixels);
    for (std::int32_t i = begin; i < end; ++i) out[i - begin] = static_cast<float>(from + i * step);
  }
  std::size_t end_along(double from, double step, std::size_t i) const {
    if (step == 0) return count;
    const auto place = [&](std::size_t n) { return std::floor(from + static_cast<double>(n) * step); };
    const double here = place(i);
    const double steps = ((step > 0 ? here + 1 : here) - from) / step;
    std::size_t end = i + 1;
    if (steps > static_cast<double>(i + 1))
      end = static_cast<std::size_t>(std::min(steps, static_cast<double>(count)));
    while (end > i + 1 && place(end - 1) != here) --end; // where rounding put the border a pixel off
    while (end < count && place(end) == here) ++end;
    return std::min(end, count);
  }

  std::int64_t cells_x, cells_y;
  std::int64_t base_x = 0, base_y = 0;
  double from_x = 0, from_y = 0;
  double step_x, step_y;
  std::size_t count;
};

} // namespace tilepack
