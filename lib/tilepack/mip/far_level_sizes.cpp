#include "tilepack/mip/far_levels.h"

#include <algorithm>

namespace tilepack {

std::vector<Size> far_level_sizes(const Layout& layout, Size tile_size, int tile_levels) {
  const int layers = layout.kind == LayoutKind::array ? layout.rows : 1;
  Size side = texture_size(layout, tile_size, tile_levels - 1);
  side.height /= layers;
  std::vector<Size> sizes;
  while (side.width > 1 || side.height > 1) {
    side = {std::max(1, side.width / 2), std::max(1, side.height / 2)};
    sizes.push_back({side.width, side.height * layers});
  }
  return sizes;
}

} // namespace tilepack
