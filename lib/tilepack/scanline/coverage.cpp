#include "tilepack/scanline/coverage.h"

#include <algorithm>
#include <cmath>

namespace tilepack {
namespace {

constexpr std::int64_t steps = 256; // a pixel

// A half space that is positive inside.
struct ClipPlane {
  double x, y, w, one;
  double at(const ScreenPoint& p) const { return x * p.x + y * p.y + w * p.w + one; }
};

// Always from the inner to the outer end, so both triangles of a shared edge get the same bits.
ScreenPoint crossing(const ScreenPoint& in, const ScreenPoint& out, double at_in, double at_out) {
  const double t = at_in / (at_in - at_out);
  return {in.x + t * (out.x - in.x), in.y + t * (out.y - in.y), in.w + t * (out.w - in.w)};
}

std::vector<ScreenPoint> cut(const std::vector<ScreenPoint>& polygon, const ClipPlane& plane) {
  std::vector<ScreenPoint> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const ScreenPoint& a = polygon[i];
    const ScreenPoint& b = polygon[(i + 1) % polygon.size()];
    const double at_a = plane.at(a), at_b = plane.at(b);
    if (at_a >= 0) kept.push_back(a);
    if (at_a >= 0 && at_b < 0) kept.push_back(crossing(a, b, at_a, at_b));
    if (at_a < 0 && at_b >= 0) kept.push_back(crossing(b, a, at_b, at_a));
  }
  return kept;
}

SnappedPoint snapped(const ScreenPoint& p, Size picture) {
  // Clipping bounds both, up to rounding; the clamp keeps even that from overflowing.
  const auto snap = [](double value, int side) {
    return static_cast<std::int64_t>(std::floor(std::clamp(value, -2.0 * side, 3.0 * side) * steps + 0.5));
  };
  return {snap(p.x / p.w, picture.width), snap(p.y / p.w, picture.height)};
}

std::int64_t floor_divided(std::int64_t a, std::int64_t b) { // b > 0
  const std::int64_t q = a / b;
  return a % b < 0 ? q - 1 : q;
}

std::int64_t ceil_divided(std::int64_t a, std::int64_t b) {
  return -floor_divided(-a, b);
}

// The first pixel whose centre is on or right of the edge a → b (a above b) in the row with centre y.
std::int64_t first_right_of(const SnappedPoint& a, const SnappedPoint& b, std::int64_t y) {
  const std::int64_t height = b.y - a.y;
  // centre = 256 i + 128 >= a.x + (y - a.y)(b.x - a.x)/height, all times height.
  const std::int64_t edge = (a.x - steps / 2) * height + (y - a.y) * (b.x - a.x);
  return ceil_divided(edge, steps * height);
}

} // namespace

std::vector<SnappedTriangle> clipped(const std::array<ScreenPoint, 3>& corners, Size picture, double near) {
  for (const ScreenPoint& p : corners) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.w)) return {};
  }
  const double width = picture.width, height = picture.height;
  const std::array planes{ClipPlane{0, 0, 1, -near}, ClipPlane{1, 0, width, 0},
                          ClipPlane{-1, 0, 2 * width, 0}, ClipPlane{0, 1, height, 0},
                          ClipPlane{0, -1, 2 * height, 0}};
  std::vector<ScreenPoint> polygon(corners.begin(), corners.end());
  for (const ClipPlane& plane : planes) {
    const bool inside =
        std::all_of(polygon.begin(), polygon.end(), [&](const ScreenPoint& p) { return plane.at(p) >= 0; });
    if (!inside) polygon = cut(polygon, plane);
    if (polygon.size() < 3) return {};
  }
  std::vector<SnappedTriangle> triangles;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    triangles.push_back(
        {snapped(polygon[0], picture), snapped(polygon[i - 1], picture), snapped(polygon[i], picture)});
  }
  return triangles;
}

void append_coverage(const SnappedTriangle& triangle, Size picture, int first_row, int end_row,
                     std::vector<PixelRun>& runs) {
  SnappedTriangle t = triangle;
  std::sort(t.begin(), t.end(),
            [](const SnappedPoint& a, const SnappedPoint& b) { return a.y != b.y ? a.y < b.y : a.x < b.x; });
  const auto& [top, middle, bottom] = t;
  const std::int64_t area = (middle.x - top.x) * (bottom.y - top.y) - (bottom.x - top.x) * (middle.y - top.y);
  if (area == 0) return;
  const bool middle_is_left = area < 0;

  // Rows whose centre y satisfies top.y <= y < bottom.y: a level top edge is in, a level bottom edge out.
  const std::int64_t first = std::max<std::int64_t>(ceil_divided(top.y - steps / 2, steps), first_row);
  const std::int64_t end = std::min<std::int64_t>(ceil_divided(bottom.y - steps / 2, steps), end_row);
  for (std::int64_t row = std::max<std::int64_t>(first, 0); row < std::min<std::int64_t>(end, picture.height);
       ++row) {
    const std::int64_t y = row * steps + steps / 2;
    const std::int64_t along = first_right_of(top, bottom, y);
    const std::int64_t bent =
        y < middle.y ? first_right_of(top, middle, y) : first_right_of(middle, bottom, y);
    const std::int64_t left = std::max<std::int64_t>(middle_is_left ? bent : along, 0);
    const std::int64_t right = std::min<std::int64_t>(middle_is_left ? along : bent, picture.width);
    if (left < right) {
      runs.push_back({static_cast<int>(row), static_cast<int>(left), static_cast<int>(right - left)});
    }
  }
}

} // namespace tilepack
