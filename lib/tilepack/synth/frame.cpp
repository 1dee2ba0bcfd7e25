#include "tilepack/synth/frame.h"

#include "tilepack/tileset/border_colors.h"

#include <algorithm>

namespace tilepack {

FrameShape frame_shape(const SynthOptions& options, const Periodicity& periods, double reach,
                       double corner_reach) {
  FrameShape shape;
  shape.tile = options.tile_size;
  shape.alignment = PeriodAlignment(periods, shape.tile);
  const int side = std::min(options.tile_size.width, options.tile_size.height);
  shape.guard = std::max(1, options.guard);
  shape.reach =
      std::clamp(static_cast<int>(side * reach), shape.guard + 1, std::max(shape.guard + 1, side / 2));
  shape.corner_reach =
      std::clamp(static_cast<int>(side * corner_reach), shape.reach, std::max(shape.reach, side / 2));
  if (options.coloring == Coloring::corner) {
    const int k = options.colors.corner;
    shape.corners = k;
    for (int first = 0; first < k; ++first)
      for (int second = 0; second < k; ++second) shape.horizontal.push_back({first, second});
    shape.vertical = shape.horizontal;
    const TileColors tiles = complete_set(options.colors);
    for (const CornerTile& t : std::get<std::vector<CornerTile>>(tiles)) {
      const BorderColors b = borders_of(t, k); // indices of shape.horizontal and vertical
      shape.tiles.push_back({b.north, b.east, b.south, b.west});
    }
  } else {
    shape.corners = 1;
    shape.horizontal.resize(static_cast<std::size_t>(options.colors.horizontal));
    shape.vertical.resize(static_cast<std::size_t>(options.colors.vertical));
    const TileColors tiles = complete_set(options.colors);
    for (const EdgeTile& t : std::get<std::vector<EdgeTile>>(tiles))
      shape.tiles.push_back({t.north, t.east, t.south, t.west});
  }
  return shape;
}

FrameShape halved(const FrameShape& shape, int times) {
  FrameShape small = shape;
  const int scale = 1 << times;
  small.tile = {shape.tile.width / scale, shape.tile.height / scale};
  small.guard = shape.guard / scale;
  small.reach = std::max(1, shape.reach / scale);
  small.corner_reach = std::max(small.reach, shape.corner_reach / scale);
  return small;
}

namespace {

int distance_to_border(Size tile, int x, int y) {
  return std::min({x, y, tile.width - 1 - x, tile.height - 1 - y});
}

} // namespace

bool in_guard(const FrameShape& shape, int x, int y) {
  return distance_to_border(shape.tile, x, y) < shape.guard;
}

CutConstraint constraint_at(const FrameShape& shape, int x, int y) {
  const int distance = distance_to_border(shape.tile, x, y);
  if (distance < shape.guard) return CutConstraint::keep;
  return distance < shape.reach / unbiased_part ? CutConstraint::unbiased : CutConstraint::free;
}

} // namespace tilepack
