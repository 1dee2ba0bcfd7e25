#pragma once

#include <cstdint>

namespace tilepack {

/// The dithering operator of [LN03, figure 8]: v1 where b < random, else v2, so v2 has the probability b.
constexpr std::int64_t dithered(std::int64_t v1, std::int64_t v2, double b, double random) {
  return b > random ? v2 : v1;
}

/// In two dimensions, with one random number along each axis: bilinear interpolation of probabilities.
///   v1 v2
///   v3 v4
constexpr std::int64_t dithered(std::int64_t v1, std::int64_t v2, std::int64_t v3, std::int64_t v4,
                                double b_x, double b_y, double random_x, double random_y) {
  return dithered(dithered(v1, v2, b_x, random_x), dithered(v3, v4, b_x, random_x), b_y, random_y);
}

/// Where a place lies between the centres of the cells of a coarse map along an axis: cells `first` and first + 1
/// (any integers, the map wraps) with weights 1 - b and b. `cell` and `fraction`: the place in the coarse grid.
struct BetweenCentres {
  std::int64_t first = 0;
  double b = 0;
};
constexpr BetweenCentres between_centres(std::int64_t cell, double fraction) {
  return fraction < 0.5 ? BetweenCentres{cell - 1, fraction + 0.5} : BetweenCentres{cell, fraction - 0.5};
}

} // namespace tilepack
