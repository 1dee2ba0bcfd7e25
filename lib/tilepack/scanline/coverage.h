#pragma once

#include "tilepack/scanline/camera.h"

#include <array>
#include <vector>

namespace tilepack {

/// A corner on the screen in 1/256 of a pixel: where triangles that share corners and edges agree exactly.
struct SnappedPoint {
  std::int64_t x = 0, y = 0;
  bool operator==(const SnappedPoint&) const = default;
};
using SnappedTriangle = std::array<SnappedPoint, 3>;

/// The pixels first..first+count-1 of a row.
struct PixelRun {
  int row = 0, first = 0, count = 0;
  bool operator==(const PixelRun&) const = default;
};

/// The part of a triangle nearer than nothing but the near distance, cut in homogeneous coordinates also to
/// one picture size around the picture (so that snapped coordinates stay small), as triangles that cover it.
/// Empty for a triangle behind the near plane or outside. A shared edge is cut alike in both its triangles.
std::vector<SnappedTriangle> clipped(const std::array<ScreenPoint, 3>& corners, Size picture, double near);

/// Pixels whose centre lies in the triangle, in rows first_row..end_row-1 of the picture. A centre exactly on
/// an edge belongs to it if that is a left edge, or a top edge that is level: two triangles that share an
/// edge cover its pixels once. Appends to `runs`.
void append_coverage(const SnappedTriangle& triangle, Size picture, int first_row, int end_row,
                     std::vector<PixelRun>& runs);

} // namespace tilepack
