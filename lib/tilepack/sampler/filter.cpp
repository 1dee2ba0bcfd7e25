#include "tilepack/sampler/filter.h"

#include <algorithm>
#include <cmath>

namespace tilepack {

LevelBlend level_blend(double level, int levels, Filter filter) {
  const double last = levels - 1;
  const double inside = std::isnan(level) ? 0.0 : std::clamp(level, 0.0, last);
  if (filter != Filter::trilinear) {
    const int rounded = static_cast<int>(std::floor(inside + 0.5));
    return {rounded, rounded, 0.0};
  }
  const int fine = static_cast<int>(std::floor(inside));
  const double weight = inside - fine;
  return {fine, weight > 0 ? fine + 1 : fine, weight};
}

Taps bilinear_taps(double fraction, int tile_side) {
  const double position = fraction * tile_side - 0.5; // texel centres lie at +0.5
  const double first = std::floor(position);
  return {static_cast<int>(first), position - first};
}

int nearest_texel(double fraction, int tile_side) {
  return std::min(static_cast<int>(fraction * tile_side), tile_side - 1);
}

} // namespace tilepack
