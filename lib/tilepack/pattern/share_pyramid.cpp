#include "tilepack/pattern/share_pyramid.h"

#include "tilepack/numeric/exact_math.h"
#include "tilepack/pattern/areas.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace tilepack {
namespace {

constexpr std::int64_t most_cells_of_pyramid = std::int64_t{1} << 24;

std::size_t cell_number(Size size, int x, int y) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(size.width) + static_cast<std::size_t>(x);
}

} // namespace

SharePyramid::SharePyramid(const StoredMap& map) {
  if (std::int64_t{map.size().width} * map.size().height >= most_cells_of_pyramid) return;
  std::set<std::int64_t> found;
  for (const float value : map.all().values) {
    found.insert(static_cast<std::int64_t>(std::floor(value)));
    if (found.size() > most_indices) return;
  }
  indices.assign(found.begin(), found.end());
  const std::size_t count = indices.size();
  sizes.push_back(map.size());
  std::vector<float> finest(map.all().values.size() * count);
  for (std::size_t cell = 0; cell < map.all().values.size(); ++cell) {
    const auto index = static_cast<std::int64_t>(std::floor(map.all().values[cell]));
    const auto at = std::lower_bound(indices.begin(), indices.end(), index) - indices.begin();
    finest[cell * count + static_cast<std::size_t>(at)] = 1;
  }
  levels.push_back(std::move(finest));
  while (sizes.back().width > 1 || sizes.back().height > 1) {
    const Size fine = sizes.back(), size{(fine.width + 1) / 2, (fine.height + 1) / 2};
    std::vector<float> level(static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height) *
                             count);
    for (int y = 0; y < size.height; ++y)
      for (int x = 0; x < size.width; ++x)
        for (int k = 0; k < 4; ++k) { // the last one again where a side is odd
          const int from_x = std::min(2 * x + k % 2, fine.width - 1),
                    from_y = std::min(2 * y + k / 2, fine.height - 1);
          for (std::size_t i = 0; i < count; ++i)
            level[cell_number(size, x, y) * count + i] +=
                0.25f * levels.back()[cell_number(fine, from_x, from_y) * count + i];
        }
    sizes.push_back(size);
    levels.push_back(std::move(level));
  }
}

std::size_t SharePyramid::bytes() const {
  std::size_t sum = 0;
  for (const std::vector<float>& level : levels) sum += level.size() * sizeof(float);
  return sum;
}

void SharePyramid::add_level(int level, TileCoordinate x, TileCoordinate y, double ramp, double weight,
                             std::vector<double>& out) const {
  const Size size = sizes[static_cast<std::size_t>(level)];
  const std::vector<float>& shares = levels[static_cast<std::size_t>(level)];
  const auto place = [&](TileCoordinate c) {
    const double scaled = std::ldexp(static_cast<double>(c.tile) + c.fraction, -level);
    const BetweenCentres between =
        between_centres(static_cast<std::int64_t>(std::floor(scaled)), scaled - std::floor(scaled));
    return BetweenCentres{between.first, std::clamp((between.b - 0.5) / ramp + 0.5, 0.0, 1.0)};
  };
  const BetweenCentres at_x = place(x), at_y = place(y);
  for (int k = 0; k < 4; ++k) {
    const double share = weight * (k % 2 != 0 ? at_x.b : 1 - at_x.b) * (k / 2 != 0 ? at_y.b : 1 - at_y.b);
    if (!(share > 0)) continue;
    const auto cell_x = static_cast<int>(wrapped(at_x.first + k % 2, std::int64_t{size.width}));
    const auto cell_y = static_cast<int>(wrapped(at_y.first + k / 2, std::int64_t{size.height}));
    const float* from = shares.data() + cell_number(size, cell_x, cell_y) * indices.size();
    for (std::size_t i = 0; i < indices.size(); ++i)
      if (from[i] > 0)
        out[static_cast<std::size_t>(std::max<std::int64_t>(indices[i], -1) + 1)] +=
            share * static_cast<double>(from[i]);
  }
}

void SharePyramid::add(TileCoordinate x, TileCoordinate y, double width, bool dithered, double weight,
                       std::vector<double>& out) const {
  const auto needed = static_cast<std::size_t>(std::max<std::int64_t>(indices.back(), -1) + 2);
  if (out.size() < needed) out.resize(needed);
  if (width <= 1) return add_level(0, x, y, dithered ? 1 : std::max(width, 1e-9), weight, out);
  const LevelBlend blend = level_blend(exact_log2(width), static_cast<int>(levels.size()), Filter::trilinear);
  add_level(blend.fine, x, y, 1, weight * (1 - blend.coarse_weight), out);
  if (blend.coarse_weight > 0) add_level(blend.coarse, x, y, 1, weight * blend.coarse_weight, out);
}

} // namespace tilepack
