#include "tilepack/seam/graph_cut.h"
#include "tilepack/synth/frame.h"
#include "tilepack/synth/strip_axes.h"

#include <tbb/parallel_for.h>

namespace tilepack {

Frame joined_frame(const FeatureImage& image, const FrameShape& shape, const FrameSources& plan) {
  Frame frame;
  frame.horizontal.resize(plan.horizontal.size());
  frame.vertical.resize(plan.vertical.size());
  const std::size_t h = plan.horizontal.size();
  tbb::parallel_for(std::size_t{0}, h + plan.vertical.size(), [&](std::size_t i) {
    const bool horizontal = i < h;
    const StripAxes space = space_of(shape, horizontal ? Direction::horizontal : Direction::vertical);
    const SourceTexel place = horizontal ? plan.horizontal[i] : plan.vertical[i - h];
    const FrameShape::Strip ends = horizontal ? shape.horizontal[i] : shape.vertical[i - h];
    SourceCanvas canvas(space.width(), space.height());
    for (int y = 0; y < canvas.height; ++y)
      for (int x = 0; x < canvas.width; ++x) canvas.at(x, y) = {place.x + x, place.y + y};
    for (const bool second : {false, true}) {
      const SourceTexel corner = plan.corners[static_cast<std::size_t>(second ? ends.second : ends.first)];
      const SourceTexel start = space.at(second ? space.length - shape.corner_reach : 0, 0);
      const SourceTexel extent = space.at(shape.corner_reach, 2 * shape.reach);
      LaidPatch move{{start.x, start.y, extent.x, extent.y}, corner_origin(space, corner, second), {}};
      for (int y = 0; y < extent.y; ++y)
        for (int x = 0; x < extent.x; ++x) {
          const int along = horizontal ? x : y;
          const int from_end = second ? shape.corner_reach - 1 - along : along;
          move.freedom.push_back(from_end < shape.guard ? CutConstraint::take : CutConstraint::free);
        }
      lay_patch(image, canvas, move);
    }
    (horizontal ? frame.horizontal[i] : frame.vertical[i - h]) = std::move(canvas);
  });
  return frame;
}

} // namespace tilepack
