#include "tilepack/synth/frame.h"

#include "tilepack/tileset/border_colors.h"

#include <algorithm>

namespace tilepack {

FrameShape frame_shape(const SynthOptions& options, const Periodicity& periods, ReachShares reach,
                       ReachShares corner_reach) {
  FrameShape shape;
  shape.tile = options.tile_size;
  shape.alignment = PeriodAlignment(periods, shape.tile);
  const int side = std::min(options.tile_size.width, options.tile_size.height);
  shape.guard = std::max(1, options.guard);
  const auto texels = [&](double share, int least) {
    return std::clamp(static_cast<int>(side * share), least, std::max(least, side / 2));
  };
  shape.reach = {texels(reach.x, shape.guard + 1), texels(reach.y, shape.guard + 1)};
  shape.corner_reach = {texels(corner_reach.x, shape.reach.x), texels(corner_reach.y, shape.reach.y)};
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
  small.reach = {std::max(1, shape.reach.x / scale), std::max(1, shape.reach.y / scale)};
  small.corner_reach = {std::max(small.reach.x, shape.corner_reach.x / scale),
                        std::max(small.reach.y, shape.corner_reach.y / scale)};
  return small;
}

namespace {

int from_side(int side, int at) {
  return std::min(at, side - 1 - at);
}

} // namespace

bool in_guard(const FrameShape& shape, int x, int y) {
  return std::min(from_side(shape.tile.width, x), from_side(shape.tile.height, y)) < shape.guard;
}

CutConstraint constraint_at(const FrameShape& shape, int x, int y) {
  if (in_guard(shape, x, y)) return CutConstraint::keep;
  return from_side(shape.tile.width, x) < shape.reach.x / unbiased_part ||
                 from_side(shape.tile.height, y) < shape.reach.y / unbiased_part
             ? CutConstraint::unbiased
             : CutConstraint::free;
}

} // namespace tilepack
