#pragma once

#include "tilepack/sampler/footprint.h"
#include "tilepack/scanline/coverage.h"
#include "tilepack/scanline/screen_map.h"
#include "tilepack/scanline/span_batch.h"

#include <optional>
#include <vector>

namespace tilepack {

/// What is seen.
struct Scene {
  std::vector<TexturedPlane> planes;
  std::vector<TexturedTriangle> triangles;
};

/// A run of pixels of one surface, ready to be stepped through; with what mip selection needs of it.
struct ViewSpan {
  int row = 0;
  Span span;
  double nearness = 0; ///< reciprocal of the distance along the view at n = 0
  double du_down = 0;  ///< at n = 0 the derivative of u towards the next row, tiles a pixel
  double dv_down = 0;
  double nearness_down = 0; ///< the derivative of nearness towards the next row, over nearness
};

/// At the pixel whose offset from the span's start is (u, v), pixel number n of the span. No division, but
/// for spans along which the texture stands still: 1/(1 - bend n) is found back from the offset. Finite.
Footprint footprint(const ViewSpan& view, int n, double u, double v);

/// Set-up, part 1: a scene on the screen. Surfaces without a map (see screen_map) or outside the picture are
/// left out.
class ProjectedScene {
public:
  ProjectedScene(const Scene& scene, const Projection& projection);

  /// Set-up, part 2: the spans of rows first_row..first_row+count-1, surface by surface in the scene's order
  /// (planes first), each with one pixel or more.
  std::vector<ViewSpan> spans(int first_row, int count) const;

  Size size() const { return picture; }

private:
  struct Surface {
    ScreenMap map;
    bool unbounded = false;
    std::vector<SnappedTriangle> pieces;
    int first_row = 0, end_row = 0;
  };
  Size picture;
  std::vector<Surface> surfaces;
};

/// How spans are stepped through.
struct ViewStepping {
  SpanOptions options;
  SpanPrecision precision = SpanPrecision::f32;
  /// Chooses options.reseed for each 32 spans so that no pixel is off by more than this many; 0: don't.
  double wanted_error = 0;
};

/// What lies at each pixel of a band of rows. Entries of pixels that show nothing have span -1.
struct ViewPixels {
  int width = 0, rows = 0;
  int first_row = 0;
  std::vector<ViewSpan> spans;
  std::vector<std::int32_t> span; ///< width * rows: index into spans
  std::vector<std::int32_t> step; ///< n within it
  std::vector<double> u, v;       ///< offset from its start
};

/// Stepping: all spans filled, 32 side by side, the nearest surface kept at each pixel (of equals, the
/// first).
ViewPixels view_pixels(std::vector<ViewSpan> spans, int width, int first_row, int rows,
                       const ViewStepping& stepping);

/// One picture's stepping against another's: how far the texture has moved at worst.
struct ViewDifference {
  double largest_texels = 0;     ///< in texels of `tile` (level 0)
  double largest_mip_texels = 0; ///< in texels of the level trilinear filtering would read there
  double largest_pixels = 0;     ///< in pixels along the scanline; where the texture moves along it at all
  std::int64_t pixels = 0;       ///< compared
};

/// Of two results of view_pixels for the same spans.
ViewDifference difference(const ViewPixels& a, const ViewPixels& b, Size tile);

} // namespace tilepack
