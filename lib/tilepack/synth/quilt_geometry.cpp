#include "tilepack/synth/quilt_geometry.h"

#include <algorithm>

namespace tilepack {

QuiltGeometry::QuiltGeometry(Size tile_size, int guard_width)
    : tile(tile_size), guard(std::max(1, guard_width)), centre_x(tile_size.width / 2),
      centre_y(tile_size.height / 2) {}

std::vector<CutRange> QuiltGeometry::allowed(int quadrant) const {
  const int n = rows(quadrant);
  const int m = columns(quadrant);
  const int reach = std::max(1, std::min(tile.width, tile.height) / 5);
  std::vector<CutRange> ranges;
  ranges.reserve(static_cast<std::size_t>(n));
  for (int row = 0; row < n; ++row) {
    const int diagonal = (2 * row + 1) * m / (2 * n);
    CutRange range{std::max(0, diagonal - reach), std::min(m, diagonal + reach)};
    if (row < guard) {
      range.last = std::min({range.last, guard, m});
      range.first = std::min(range.first, range.last);
    } else {
      range.first = std::min(std::max(range.first, guard), m);
      range.last = std::max(range.first, range.last);
    }
    ranges.push_back(range);
  }
  return ranges;
}

} // namespace tilepack
