#include "tilepack/pattern/coarse_map.h"

#include "tilepack/numeric/exact_math.h"
#include "tilepack/pattern/areas.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace tilepack {
namespace {

constexpr int samples_a_cell = 2; // along each axis

std::size_t texel_number(Size size, std::int64_t x, std::int64_t y) {
  return static_cast<std::size_t>(wrapped(y, std::int64_t{size.height})) *
             static_cast<std::size_t>(size.width) +
         static_cast<std::size_t>(wrapped(x, std::int64_t{size.width}));
}

} // namespace

CoarseMap::CoarseMap(const TextureRuns& runs, NodeId texture, int map, PatternGrid scene, PatternGrid grid,
                     Size unit) {
  const TileMapping mapping(grid, scene);
  Level finest{{static_cast<int>(grid.width), static_cast<int>(grid.height)}, {}};
  finest.texels.resize(static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height));
  const double step = 1 / (samples_a_cell * mapping.x.ratio());
  const RunLookup lookup{map, exact_log2(step * std::max(unit.width, unit.height)), Filter::trilinear};
  const auto samples = static_cast<std::size_t>(grid.width) * samples_a_cell;
  const float share = 1.0f / (samples_a_cell * samples_a_cell);
  tbb::parallel_for(0, finest.size.height, [&](int y) {
    RunBuffer buffer;
    std::array<float, 5>* row = finest.texels.data() + texel_number(finest.size, 0, y);
    for (int j = 0; j < samples_a_cell; ++j)
      for (std::size_t first = 0; first < samples; first += longest_run) {
        const std::size_t count = std::min(longest_run, samples - first);
        const TileCoordinate v = mapping.y.place_in(y, (j + 0.5) / samples_a_cell);
        const TileCoordinate u =
            mapping.x.place_in(static_cast<std::int64_t>(first / samples_a_cell), 0.5 / samples_a_cell);
        runs.evaluate(texture, {{u, v}, step, 0, count}, lookup, buffer.view());
        for (std::size_t i = 0; i < count; ++i) {
          std::array<float, 5>& texel = row[(first + i) / samples_a_cell];
          for (int c = 0; c < runs.value_channels(map); ++c)
            texel[static_cast<std::size_t>(c)] += share * buffer.value[c][i] * buffer.cover[i];
          texel[4] += share * buffer.cover[i];
        }
      }
  });
  levels.push_back(std::move(finest));
  while (levels.back().size.width > 1 || levels.back().size.height > 1) {
    const Level& fine = levels.back();
    Level coarse{{(fine.size.width + 1) / 2, (fine.size.height + 1) / 2}, {}};
    coarse.texels.resize(static_cast<std::size_t>(coarse.size.width) *
                         static_cast<std::size_t>(coarse.size.height));
    for (int y = 0; y < coarse.size.height; ++y)
      for (int x = 0; x < coarse.size.width; ++x)
        for (int k = 0; k < 4; ++k) {
          const auto& from = fine.texels[texel_number(fine.size, std::min(2 * x + k % 2, fine.size.width - 1),
                                                      std::min(2 * y + k / 2, fine.size.height - 1))];
          for (std::size_t c = 0; c < 5; ++c)
            coarse.texels[texel_number(coarse.size, x, y)][c] += 0.25f * from[c];
        }
    levels.push_back(std::move(coarse));
  }
}

void CoarseMap::add(TileCoordinate x, TileCoordinate y, double width, double weight,
                    std::array<double, 4>& value, double& cover) const {
  const LevelBlend blend =
      level_blend(width > 1 ? exact_log2(width) : 0, static_cast<int>(levels.size()), Filter::trilinear);
  const auto add_level = [&](int number, double share) {
    const Level& level = levels[static_cast<std::size_t>(number)];
    const auto between = [&](TileCoordinate c) {
      const double scaled = std::ldexp(static_cast<double>(c.tile) + c.fraction, -number);
      return between_centres(static_cast<std::int64_t>(std::floor(scaled)), scaled - std::floor(scaled));
    };
    const BetweenCentres at_x = between(x), at_y = between(y);
    for (int k = 0; k < 4; ++k) {
      const double w = share * (k % 2 != 0 ? at_x.b : 1 - at_x.b) * (k / 2 != 0 ? at_y.b : 1 - at_y.b);
      const auto& texel = level.texels[texel_number(level.size, at_x.first + k % 2, at_y.first + k / 2)];
      for (std::size_t c = 0; c < 4; ++c) value[c] += w * static_cast<double>(texel[c]);
      cover += w * static_cast<double>(texel[4]);
    }
  };
  add_level(blend.fine, weight * (1 - blend.coarse_weight));
  if (blend.coarse_weight > 0) add_level(blend.coarse, weight * blend.coarse_weight);
}

std::size_t CoarseMap::bytes() const {
  std::size_t sum = 0;
  for (const Level& level : levels) sum += level.texels.size() * sizeof(level.texels[0]);
  return sum;
}

} // namespace tilepack
