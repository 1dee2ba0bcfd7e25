#include "tilepack/scanline/view_spans.h"

#include "tilepack/scanline/span_constants.h"
#include "tilepack/scanline/span_method.h"

#include <algorithm>
#include <cmath>

namespace tilepack {
namespace {

// A footprint beyond this many tiles a pixel means the same as one of this size, and its square is finite.
double held(double value) {
  return std::isnan(value) ? 0.0 : std::clamp(value, -0x1p100, 0x1p100);
}

ViewSpan view_span(const ScreenMap& map, const PixelRun& run) {
  ViewSpan view;
  view.row = run.row;
  view.span = make_span(coefficients(map, run.row, run.first, run.count));
  if (view.span.count == 0) return view;
  const double x = run.first + view.span.first + 0.5, y = run.row + 0.5;
  view.span.first += run.first;
  view.nearness = map.w.at(x, y);
  // d(U/W)/dy = (U_y - (U/W) W_y)/W.
  const double u = map.u.at(x, y) / view.nearness, v = map.v.at(x, y) / view.nearness;
  view.du_down = held((map.u.y - u * map.w.y) / view.nearness);
  view.dv_down = held((map.v.y - v * map.w.y) / view.nearness);
  view.nearness_down = held(map.w.y / view.nearness);
  return view;
}

// Offsets of a batch into the pixels they win.
template <class Real>
void keep_nearest(std::span<const Span> spans, std::size_t first, const SpanBatch<Real>& batch,
                  ViewPixels& pixels, std::vector<double>& nearness) {
  for (std::size_t lane = 0; lane < spans.size(); ++lane) {
    const ViewSpan& view = pixels.spans[first + lane];
    const std::size_t row = static_cast<std::size_t>(view.row - pixels.first_row);
    for (int n = 0; n < view.span.count; ++n) {
      const int x = view.span.first + view.span.direction * n;
      const std::size_t at = row * static_cast<std::size_t>(pixels.width) + static_cast<std::size_t>(x);
      const double here = view.nearness * denominator(view.span, n);
      if (!(here > nearness[at])) continue;
      nearness[at] = here;
      pixels.span[at] = static_cast<std::int32_t>(first + lane);
      pixels.step[at] = n;
      pixels.u[at] = static_cast<double>(batch.u_at(static_cast<int>(lane), n));
      pixels.v[at] = static_cast<double>(batch.v_at(static_cast<int>(lane), n));
    }
  }
}

template <class Real>
void step_spans(ViewPixels& pixels, const ViewStepping& stepping) {
  std::vector<double> nearness(pixels.span.size(), 0.0);
  SpanBatch<Real> batch;
  std::vector<Span> spans;
  for (std::size_t first = 0; first < pixels.spans.size(); first += scanlines_side_by_side) {
    const std::size_t end = std::min(first + scanlines_side_by_side, pixels.spans.size());
    spans.clear();
    SpanOptions options = stepping.options;
    if (stepping.wanted_error > 0) options.reseed = max_span_pixels;
    for (std::size_t i = first; i < end; ++i) {
      spans.push_back(pixels.spans[i].span);
      if (stepping.wanted_error > 0) {
        const double unit = static_cast<double>(rounding_unit<Real>);
        options.reseed = std::min(options.reseed,
                                  reseed_interval(options.method, spans.back(), stepping.wanted_error, unit));
      }
    }
    fill_spans<Real>(spans, options, batch);
    keep_nearest<Real>(spans, first, batch, pixels, nearness);
  }
}

} // namespace

Footprint footprint(const ViewSpan& view, int n, double u, double v) {
  const Span& span = view.span;
  // offset = du n y with y = 1/(1 - bend n), so y = 1 + bend n y = 1 + (bend/du) offset.
  double y = 1;
  if (span.bend > 0) {
    if (span.du == 0 && span.dv == 0) {
      y = 1 / denominator(span, n);
    } else {
      y += span.bend * (std::abs(span.du) > std::abs(span.dv) ? u / span.du : v / span.dv);
    }
  }
  const double along = span.direction * y * y;
  return {held(span.du * along), held(span.dv * along), held((view.du_down - u * view.nearness_down) * y),
          held((view.dv_down - v * view.nearness_down) * y)};
}

ProjectedScene::ProjectedScene(const Scene& scene, const Projection& projection) : picture(projection.size) {
  for (const TexturedPlane& plane : scene.planes) {
    if (const auto map = screen_map(plane, projection)) {
      surfaces.push_back({*map, true, {}, 0, picture.height});
    }
  }
  for (const TexturedTriangle& triangle : scene.triangles) {
    const std::array corners{projection.at(triangle.corners[0]), projection.at(triangle.corners[1]),
                             projection.at(triangle.corners[2])};
    Surface surface;
    surface.pieces = clipped(corners, picture, projection.near);
    if (surface.pieces.empty()) continue;
    const auto map = screen_map(triangle, projection);
    if (!map) continue;
    surface.map = *map;
    std::int64_t lowest = surface.pieces[0][0].y, highest = lowest;
    for (const SnappedTriangle& piece : surface.pieces) {
      for (const SnappedPoint& p : piece) {
        lowest = std::min(lowest, p.y);
        highest = std::max(highest, p.y);
      }
    }
    surface.first_row = static_cast<int>(std::clamp<std::int64_t>(lowest / 256 - 1, 0, picture.height));
    surface.end_row = static_cast<int>(std::clamp<std::int64_t>(highest / 256 + 1, 0, picture.height));
    if (surface.first_row < surface.end_row) surfaces.push_back(std::move(surface));
  }
}

std::vector<ViewSpan> ProjectedScene::spans(int first_row, int count) const {
  std::vector<ViewSpan> found;
  std::vector<PixelRun> runs;
  for (const Surface& surface : surfaces) {
    const int begin = std::max(first_row, surface.first_row);
    const int end = std::min(first_row + count, surface.end_row);
    runs.clear();
    if (surface.unbounded) {
      for (int row = begin; row < end; ++row) runs.push_back({row, 0, picture.width});
    }
    for (const SnappedTriangle& piece : surface.pieces) append_coverage(piece, picture, begin, end, runs);
    for (const PixelRun& run : runs) {
      const ViewSpan view = view_span(surface.map, run);
      if (view.span.count > 0) found.push_back(view);
    }
  }
  return found;
}

ViewPixels view_pixels(std::vector<ViewSpan> spans, int width, int first_row, int rows,
                       const ViewStepping& stepping) {
  ViewPixels pixels;
  pixels.width = width;
  pixels.rows = rows;
  pixels.first_row = first_row;
  pixels.spans = std::move(spans);
  const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(rows);
  pixels.span.assign(count, -1);
  pixels.step.assign(count, 0);
  pixels.u.assign(count, 0.0);
  pixels.v.assign(count, 0.0);
  if (stepping.precision == SpanPrecision::f32) {
    step_spans<float>(pixels, stepping);
  } else {
    step_spans<double>(pixels, stepping);
  }
  return pixels;
}

ViewDifference difference(const ViewPixels& a, const ViewPixels& b, Size tile) {
  ViewDifference worst;
  for (std::size_t at = 0; at < a.span.size(); ++at) {
    if (a.span[at] < 0 || a.span[at] != b.span[at] || a.step[at] != b.step[at]) continue;
    const ViewSpan& view = a.spans[static_cast<std::size_t>(a.span[at])];
    const double u = b.u[at] - a.u[at], v = b.v[at] - a.v[at];
    const double texels = std::hypot(u * tile.width, v * tile.height);
    const Footprint f = footprint(view, a.step[at], a.u[at], a.v[at]);
    const double across = std::hypot(f.u_across * tile.width, f.v_across * tile.height);
    const double down = std::hypot(f.u_down * tile.width, f.v_down * tile.height);
    ++worst.pixels;
    worst.largest_texels = std::max(worst.largest_texels, texels);
    worst.largest_mip_texels = std::max(worst.largest_mip_texels, texels / std::max({across, down, 1.0}));
    // Back along the scanline to where b's offset is right, as in rounding_bound.
    const double slope = std::hypot(view.span.du, view.span.dv);
    if (slope == 0) continue;
    const auto place = [&](const ViewPixels& p) {
      const double g = (p.u[at] * view.span.du + p.v[at] * view.span.dv) / (slope * slope);
      return g / (1 + view.span.bend * g);
    };
    worst.largest_pixels = std::max(worst.largest_pixels, std::abs(place(a) - place(b)));
  }
  return worst;
}

} // namespace tilepack
