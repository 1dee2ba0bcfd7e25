#include "tilepack/synth/strip_axes.h"

#include <algorithm>

namespace tilepack {

StripAxes space_of(const FrameShape& shape, Direction direction) {
  return {direction, direction == Direction::horizontal ? shape.tile.width : shape.tile.height, shape.reach};
}

SourceTexel corner_origin(const StripAxes& space, SourceTexel corner, bool second) {
  const SourceTexel lattice_point = space.at(second ? space.length : 0, space.reach);
  return {corner.x - lattice_point.x, corner.y - lattice_point.y};
}

Overlap end_overlap(const FeatureImage& image, const FrameShape& shape, const StripAxes& space,
                    SourceTexel first, SourceTexel second) {
  Overlap overlap(space.width(), space.height(), image.channels);
  for (const bool at_second : {false, true}) {
    const SourceTexel origin = corner_origin(space, at_second ? second : first, at_second);
    for (int across = 0; across < 2 * space.reach; ++across)
      for (int i = std::min(shape.guard, shape.corner_reach - 1); i < shape.corner_reach; ++i) {
        const SourceTexel t = space.at(at_second ? space.length - 1 - i : i, across);
        const SourceTexel s = sum(origin, t);
        overlap.add(t.x, t.y, image.clamped_texel(s.x, s.y));
      }
  }
  return overlap;
}

} // namespace tilepack
