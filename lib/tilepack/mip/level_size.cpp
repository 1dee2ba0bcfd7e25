#include "tilepack/mip/level_size.h"

namespace tilepack {

int level_count(Size tile_size) {
  int count = 1;
  while (tile_size.width % 2 == 0 && tile_size.height % 2 == 0 && tile_size.width > 0 &&
         tile_size.height > 0) {
    tile_size = {tile_size.width / 2, tile_size.height / 2};
    ++count;
  }
  return count;
}

Size level_size(Size tile_size, int level) {
  return {tile_size.width >> level, tile_size.height >> level};
}

bool exact_through_guard(int guard, int level) {
  return level == 0 || (level < 31 && (1 << level) <= guard);
}

} // namespace tilepack
