#include "tilepack/seam/scaled_cut.h"
#include "tilepack/synth/frame.h"
#include "tilepack/synth/strip_axes.h"
#include "tilepack/synth/strip_join.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace tilepack {

SourceCanvas joined_strip(const FeaturePyramid& pyramid, const FrameShape& shape, const StripAxes& axes,
                          SourceTexel place, SourceTexel first, SourceTexel second) {
  SourceCanvas canvas(axes.width(), axes.height());
  for (int y = 0; y < canvas.height; ++y)
    for (int x = 0; x < canvas.width; ++x) canvas.at(x, y) = {place.x + x, place.y + y};
  for (const End end : {End::first, End::second}) {
    const SourceTexel start = axes.at(end == End::first ? 0 : axes.length - axes.corner_reach, 0);
    const SourceTexel extent = axes.at(axes.corner_reach, 2 * axes.reach);
    LaidPatch patch{{start.x, start.y, extent.x, extent.y},
                    corner_origin(axes, end == End::first ? first : second, end),
                    {}};
    for (int y = 0; y < extent.y; ++y)
      for (int x = 0; x < extent.x; ++x) {
        const int along = axes.direction == Direction::horizontal ? x : y;
        const int from_end = end == End::first ? along : axes.corner_reach - 1 - along;
        patch.constraints.push_back(from_end < std::max(1, shape.guard) ? CutConstraint::take
                                                                        : CutConstraint::free);
      }
    lay_patch_by_scales(pyramid, canvas, patch);
  }
  return canvas;
}

Frame joined_frame(const FeaturePyramid& pyramid, const FrameShape& shape, const FrameSources& sources) {
  Frame frame;
  frame.horizontal.resize(sources.horizontal.size());
  frame.vertical.resize(sources.vertical.size());
  const std::size_t h = sources.horizontal.size();
  const auto corner = [&](int color) { return sources.corners[static_cast<std::size_t>(color)]; };
  tbb::parallel_for(std::size_t{0}, h + sources.vertical.size(), [&](std::size_t i) {
    const bool horizontal = i < h;
    const StripAxes axes = axes_of(shape, horizontal ? Direction::horizontal : Direction::vertical);
    const SourceTexel place = horizontal ? sources.horizontal[i] : sources.vertical[i - h];
    const FrameShape::Strip ends = horizontal ? shape.horizontal[i] : shape.vertical[i - h];
    (horizontal ? frame.horizontal[i] : frame.vertical[i - h]) =
        joined_strip(pyramid, shape, axes, place, corner(ends.first), corner(ends.second));
  });
  return frame;
}

} // namespace tilepack
