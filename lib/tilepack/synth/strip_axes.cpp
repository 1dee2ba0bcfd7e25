#include "tilepack/synth/strip_axes.h"

#include <algorithm>

namespace tilepack {

StripAxes axes_of(const FrameShape& shape, Direction direction) {
  return direction == Direction::horizontal
             ? StripAxes{direction, shape.tile.width, shape.reach.y, shape.corner_reach.x}
             : StripAxes{direction, shape.tile.height, shape.reach.x, shape.corner_reach.y};
}

SourceTexel corner_origin(const StripAxes& axes, SourceTexel corner, End end) {
  const SourceTexel lattice_point = axes.at(end == End::second ? axes.length : 0, axes.reach);
  return {corner.x - lattice_point.x, corner.y - lattice_point.y};
}

Overlap end_overlap(const FeatureImage& image, const FrameShape& shape, const StripAxes& axes,
                    SourceTexel first, SourceTexel second) {
  Overlap overlap(axes.width(), axes.height(), image.channels);
  for (const End end : {End::first, End::second}) {
    const SourceTexel origin = corner_origin(axes, end == End::first ? first : second, end);
    for (int across = 0; across < 2 * axes.reach; ++across)
      for (int i = std::min(shape.guard, axes.corner_reach - 1); i < axes.corner_reach; ++i) {
        const SourceTexel t = axes.at(end == End::first ? i : axes.length - 1 - i, across);
        const SourceTexel s = sum(origin, t);
        overlap.add(t.x, t.y, image.clamped_texel(s.x, s.y));
      }
  }
  return overlap;
}

} // namespace tilepack
