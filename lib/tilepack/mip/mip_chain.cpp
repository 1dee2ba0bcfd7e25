#include "tilepack/mip/mip_chain.h"

#include "tilepack/mip/alpha_coverage.h"
#include "tilepack/mip/box_levels.h"
#include "tilepack/mip/least_squares.h"
#include "tilepack/mip/level_values.h"
#include "tilepack/mip/normal_variance.h"
#include "tilepack/mip/shared_border.h"
#include "tilepack/numeric/as_size.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace tilepack {
namespace {

// The mean over the tiles of a group goes to all of them as one value, so they are equal bit for bit,
// whatever encoding and rounding follow. It is summed in double in the order of ids: a group of equal values
// keeps its value exactly.
void share(const SharedTexels& group, Weighting weighting, std::vector<Image>& tiles) {
  const std::size_t channels = as_size(tiles.front().channels());
  std::vector<double> sum(channels);
  std::vector<double> weighted(channels);
  for (const Place place : group.places) {
    sum.assign(channels, 0.0);
    weighted.assign(channels, 0.0);
    for (const int id : group.tiles) {
      const auto texel = tiles[as_size(id)].texel(place.x, place.y);
      for (std::size_t c = 0; c < channels; ++c) {
        sum[c] += static_cast<double>(texel[c]);
        weighted[c] += static_cast<double>(texel[c]) * static_cast<double>(texel[channels - 1]);
      }
    }
    const double alpha = sum[channels - 1];
    for (const int id : group.tiles) {
      const auto texel = tiles[as_size(id)].texel(place.x, place.y);
      for (std::size_t c = 0; c < channels; ++c) {
        const bool by_alpha = weighting == Weighting::by_alpha && c + 1 < channels && alpha > 0;
        texel[c] = static_cast<float>(by_alpha ? weighted[c] / alpha
                                               : sum[c] / static_cast<double>(group.tiles.size()));
      }
    }
  }
}

void sanitize(const TileColors& colors, Size size, MipMode mode, Weighting weighting,
              std::vector<Image>& tiles) {
  const std::vector<SharedTexels> groups = shared_border(colors, size, mode);
  tbb::parallel_for(std::size_t{0}, groups.size(),
                    [&](std::size_t i) { share(groups[i], weighting, tiles); });
}

// Level → tile id → values that may be averaged further, level 0 left out.
using Levels = std::vector<std::vector<Image>>;

Image encoded(Image tile, const TileMap& map) {
  constexpr std::size_t values_a_task = std::size_t{1} << 16;
  const std::size_t rows = std::max<std::size_t>(1, values_a_task / tile.row(0).size());
  tbb::parallel_for(tbb::blocked_range<int>(0, tile.height(), rows), [&](const auto& some) {
    for (int y = some.begin(); y < some.end(); ++y) encode(tile.row(y), map, tile.row(y));
  });
  return tile;
}

// The normals whose spread roughness takes up, or null.
const TileMap* normals_for(const TileSet& set, const MipOptions& options) {
  if (!options.roughness_from_normals) return nullptr;
  for (const TileMap& other : set.maps)
    if (other.role == Role::normal && other.tiles.front().channels() >= 3) return &other;
  return nullptr;
}

} // namespace

std::vector<TileMap> coarser_levels(const TileSet& set, int map_index, const MipOptions& options,
                                    const Layout* layout) {
  const TileMap& map = set.maps[as_size(map_index)];
  const int levels = options.mode == MipMode::none ? 1 : level_count(set.tile_size);
  std::vector<TileMap> coarser;
  for (int level = 1; level < levels; ++level) coarser.push_back({map, std::vector<Image>(map.tiles.size())});
  if (levels == 1) return coarser;

  const Weighting weighting = weighting_of(map);
  const bool keeps_alpha = options.alpha_coverage > 0 && weighting == Weighting::by_alpha;
  // Levels that nothing more is done to are encoded at once: those down to `finished`.
  int finished = 0;
  while (finished + 1 < levels && !keeps_alpha &&
         (options.mode == MipMode::box || exact_through_guard(set.guard, finished + 1)))
    ++finished;
  Levels boxes(as_size(levels), std::vector<Image>(map.tiles.size()));
  const std::vector<RoughnessChannel> rough = roughness_channels(map, map.tiles.front().channels());
  const TileMap* const normals = rough.empty() ? nullptr : normals_for(set, options);
  tbb::parallel_for(std::size_t{0}, map.tiles.size(), [&](std::size_t id) {
    std::vector<Image> own = box_levels(map.tiles[id], map, levels, finished);
    if (normals != nullptr) { // roughness is stored as it is averaged
      const std::vector<Image> means = box_levels(normals->tiles[id], *normals, levels, 0);
      for (std::size_t level = 1; level < own.size(); ++level)
        add_normal_variance(own[level], means[level], rough);
    }
    for (int level = 1; level < levels; ++level)
      (level <= finished ? coarser[as_size(level - 1)].tiles : boxes[as_size(level)])[id] =
          std::move(own[as_size(level)]);
  });

  const PackNeighbours neighbours = layout ? pack_neighbours(*layout) : PackNeighbours{};
  tbb::parallel_for(1, levels, [&](int level) {
    if (level <= finished || exact_through_guard(set.guard, level)) return;
    std::vector<Image>& tiles = boxes[as_size(level)];
    if (options.mode == MipMode::least_squares)
      fit_borders(set.tiles, neighbours, options.jump_weight, weighting, tiles);
    else
      sanitize(set.tiles, level_size(set.tile_size, level), options.mode, weighting, tiles);
  });
  if (keeps_alpha) {
    const double threshold = options.alpha_coverage / 100.0;
    const double coverage = alpha_coverage(map.tiles, threshold);
    tbb::parallel_for(1, levels,
                      [&](int level) { keep_alpha_coverage(boxes[as_size(level)], threshold, coverage); });
  }
  tbb::parallel_for(std::size_t{0}, map.tiles.size(), [&](std::size_t id) {
    for (int level = finished + 1; level < levels; ++level)
      coarser[as_size(level - 1)].tiles[id] = encoded(std::move(boxes[as_size(level)][id]), map);
  });
  return coarser;
}

std::vector<TileMap> mip_chain(const TileSet& set, int map_index, const MipOptions& options,
                               const Layout* layout) {
  std::vector<TileMap> chain = coarser_levels(set, map_index, options, layout);
  chain.insert(chain.begin(), set.maps[as_size(map_index)]);
  return chain;
}

} // namespace tilepack
