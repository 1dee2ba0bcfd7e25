#include "tilepack/sampler/fast_tables.h"

#include "tilepack/numeric/wrap.h"
#include "tilepack/sampler/address.h"

namespace tilepack {

void settle_coordinates(std::int32_t* tile, float* fraction, int count, std::int64_t side) {
  for (int i = 0; i < count; ++i) {
    TileCoordinate place = normalised({tile[i], static_cast<double>(fraction[i])});
    float rest = static_cast<float>(place.fraction);
    if (rest >= 1.0f) { // rounded up
      rest = 0.0f;
      ++place.tile;
    }
    tile[i] = static_cast<std::int32_t>(wrapped(place.tile, side));
    fraction[i] = rest;
  }
}

} // namespace tilepack
