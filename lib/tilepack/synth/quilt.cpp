#include "tilepack/synth/quilt.h"

#include "tilepack/match/patch_search.h"
#include "tilepack/numeric/random.h"
#include "tilepack/numeric/side_by_side.h"
#include "tilepack/seam/path_cut.h"
#include "tilepack/synth/quilt_geometry.h"

#include <tbb/blocked_range.h>

#include <algorithm>
#include <limits>

namespace tilepack {
namespace {

SourceTexel moved(SourceTexel origin, SourceTexel by) {
  return {origin.x + by.x, origin.y + by.y};
}

const std::uint8_t* look(const FeatureImage& image, SourceTexel at) {
  return image.clamped_texel(at.x, at.y);
}

// The problem at one scale: the same image and tile, both divided by a power of two.
struct Scene {
  const FeatureImage& image;
  QuiltGeometry geometry;

  int positions_x() const { return image.width - geometry.tile.width + 1; }
  int positions_y() const { return image.height - geometry.tile.height + 1; }
};

// Calls visit(quadrant, texel of the tile) for all texels through which a cut may run.
template <typename Visit>
void for_each_overlapping(const QuiltGeometry& geometry, Visit&& visit) {
  for (int quadrant = 0; quadrant < QuiltGeometry::quadrants; ++quadrant) {
    const auto ranges = geometry.allowed(quadrant);
    for (int row = 0; row < geometry.rows(quadrant); ++row) {
      const CutRange range = ranges[static_cast<std::size_t>(row)];
      const int last = std::min(range.last, geometry.columns(quadrant) - 1);
      for (int column = std::max(0, range.first - 1); column <= last; ++column)
        visit(quadrant, geometry.texel(quadrant, row, column));
    }
  }
}

PathCut quadrant_cut(const Scene& scene, int quadrant, SourceTexel horizontal, SourceTexel vertical) {
  const QuiltGeometry& geometry = scene.geometry;
  MismatchGrid grid{geometry.rows(quadrant), geometry.columns(quadrant), {}};
  grid.values.reserve(static_cast<std::size_t>(grid.rows) * static_cast<std::size_t>(grid.columns));
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const SourceTexel at = geometry.texel(quadrant, row, column);
      grid.values.push_back(squared_difference(
          look(scene.image, moved(horizontal, geometry.in_horizontal_window(quadrant, at))),
          look(scene.image, moved(vertical, geometry.in_vertical_window(quadrant, at))),
          scene.image.channels));
    }
  return minimum_error_cut(grid, geometry.allowed(quadrant), grid.columns);
}

// What a patch of one orientation meets, all patches of the other orientation together.
Overlap overlap_with(const Scene& scene, const std::vector<SourceTexel>& others, bool patch_is_horizontal) {
  const QuiltGeometry& geometry = scene.geometry;
  Overlap overlap(geometry.tile.width, geometry.tile.height, scene.image.channels);
  for (const SourceTexel& other : others)
    for_each_overlapping(geometry, [&](int quadrant, SourceTexel at) {
      const SourceTexel h = geometry.in_horizontal_window(quadrant, at);
      const SourceTexel v = geometry.in_vertical_window(quadrant, at);
      const SourceTexel mine = patch_is_horizontal ? h : v;
      overlap.add(mine.x, mine.y, look(scene.image, moved(other, patch_is_horizontal ? v : h)));
    });
  return overlap;
}

bool near_another(const Scene& scene, const std::vector<SourceTexel>& patches, std::size_t own,
                  SourceTexel at) {
  for (std::size_t i = 0; i < patches.size(); ++i)
    if (i != own && std::abs(patches[i].x - at.x) < scene.geometry.tile.width / 2 &&
        std::abs(patches[i].y - at.y) < scene.geometry.tile.height / 2)
      return true;
  return false;
}

// Moves patch `own` to where it fits `others` best, away from patches of its own kind if there is room.
void improve(const Scene& scene, const PatchSearch& search, std::vector<SourceTexel>& patches,
             std::size_t own, const Overlap& overlap) {
  const PositionMap map = search.mismatches(overlap);
  std::int64_t best = std::numeric_limits<std::int64_t>::max();
  SourceTexel place = patches[own];
  for (const bool apart : {true, false}) {
    for (int y = 0; y < map.height; ++y)
      for (int x = 0; x < map.width; ++x)
        if (map.at(x, y) < best && !(apart && near_another(scene, patches, own, {x, y}))) {
          best = map.at(x, y);
          place = {x, y};
        }
    if (best != std::numeric_limits<std::int64_t>::max()) break;
  }
  patches[own] = place;
}

SourceTexel random_position(const Scene& scene, std::uint64_t seed, std::uint64_t index) {
  return {static_cast<int>(
              random_below(seed, "quilt patch x", index, static_cast<std::uint32_t>(scene.positions_x()))),
          static_cast<int>(
              random_below(seed, "quilt patch y", index, static_cast<std::uint32_t>(scene.positions_y())))};
}

EdgePatches searched(const std::vector<Scene>& scenes, const PatchSearch& search, const SynthOptions& options,
                     std::uint64_t start) {
  const Scene& coarsest = scenes.back();
  EdgePatches patches;
  for (int i = 0; i < options.colors.horizontal; ++i)
    patches.horizontal.push_back(
        random_position(coarsest, options.seed, 16 * start + static_cast<std::uint64_t>(i)));
  for (int i = 0; i < options.colors.vertical; ++i)
    patches.vertical.push_back(
        random_position(coarsest, options.seed, 16 * start + 8 + static_cast<std::uint64_t>(i)));
  const int rounds = 2 + options.effort / 4;
  for (int round = 0; round < rounds; ++round)
    for (const bool horizontal : {true, false}) {
      auto& own = horizontal ? patches.horizontal : patches.vertical;
      const Overlap overlap =
          overlap_with(coarsest, horizontal ? patches.vertical : patches.horizontal, horizontal);
      for (std::size_t i = 0; i < own.size(); ++i) improve(coarsest, search, own, i, overlap);
    }
  for (std::size_t level = scenes.size() - 1; level-- > 0;) {
    const Scene& scene = scenes[level];
    auto doubled = patches.vertical;
    for (SourceTexel& at : doubled)
      at = {std::min(2 * at.x, scene.positions_x() - 1), std::min(2 * at.y, scene.positions_y() - 1)};
    const Overlap against_vertical = overlap_with(scene, doubled, true);
    for (SourceTexel& at : patches.horizontal)
      at = best_near(scene.image, against_vertical, {2 * at.x, 2 * at.y}, 2);
    const Overlap against_horizontal = overlap_with(scene, patches.horizontal, false);
    for (SourceTexel& at : patches.vertical)
      at = best_near(scene.image, against_horizontal, {2 * at.x, 2 * at.y}, 2);
  }
  return patches;
}

// Halved until a search takes a fraction of a second and the memory of its spectra stays below that of the
// sample, but not so far that a tile loses its features.
constexpr std::int64_t search_area = 300'000;
constexpr int smallest_searched_tile = 32;

std::vector<FeatureImage> pyramid(const FeatureImage& image, const SynthOptions& options) {
  std::vector<FeatureImage> levels;
  int width = image.width;
  int height = image.height;
  int tile = std::min(options.tile_size.width, options.tile_size.height);
  bool once = options.effort < 9;
  while (tile / 2 >= smallest_searched_tile &&
         (once || static_cast<std::int64_t>(width) * height > search_area)) {
    levels.push_back(halved(levels.empty() ? image : levels.back()));
    width /= 2;
    height /= 2;
    tile /= 2;
    once = false;
  }
  return levels;
}

} // namespace

EdgePatches chosen_edge_patches(const FeatureImage& image, const SynthOptions& options,
                                const Progress& progress) {
  const std::vector<FeatureImage> smaller = pyramid(image, options);
  std::vector<Scene> scenes{{image, QuiltGeometry(options.tile_size, options.guard)}};
  Size tile = options.tile_size;
  int guard = options.guard;
  for (const FeatureImage& level : smaller) {
    tile = {tile.width / 2, tile.height / 2};
    guard /= 2;
    scenes.push_back({level, QuiltGeometry(tile, guard)});
  }
  report(progress, "patch search", 0.0);
  const PatchSearch search(smaller.empty() ? image : smaller.back());
  const int starts = 2 + 2 * options.effort;
  std::vector<EdgePatches> found(static_cast<std::size_t>(starts));
  std::vector<std::int64_t> costs(found.size());
  each_side_by_side(found.size(), [&](std::size_t i) {
    found[i] = searched(scenes, search, options, i);
    costs[i] = quilting_cost(image, options, found[i]);
  });
  report(progress, "patch search", 1.0);
  return found[static_cast<std::size_t>(std::min_element(costs.begin(), costs.end()) - costs.begin())];
}

std::int64_t quilting_cost(const FeatureImage& image, const SynthOptions& options,
                           const EdgePatches& patches) {
  const Scene scene{image, QuiltGeometry(options.tile_size, options.guard)};
  std::int64_t sum = 0;
  for (const SourceTexel& h : patches.horizontal)
    for (const SourceTexel& v : patches.vertical)
      for (int quadrant = 0; quadrant < QuiltGeometry::quadrants; ++quadrant)
        sum += quadrant_cut(scene, quadrant, h, v).cost;
  // A pair meets in a quadrant in Kh * Kv tiles, whatever the other two edges are.
  return sum * static_cast<std::int64_t>(patches.horizontal.size() * patches.vertical.size());
}

SourceMap quilted(const FeatureImage& image, const SynthOptions& options, const EdgePatches& patches) {
  const Scene scene{image, QuiltGeometry(options.tile_size, options.guard)};
  const QuiltGeometry& geometry = scene.geometry;
  const std::size_t verticals = patches.vertical.size();
  std::vector<PathCut> cuts(patches.horizontal.size() * verticals * QuiltGeometry::quadrants);
  each_side_by_side(cuts.size(), [&](std::size_t i) {
    const std::size_t pair = i / QuiltGeometry::quadrants;
    cuts[i] = quadrant_cut(scene, static_cast<int>(i % QuiltGeometry::quadrants),
                           patches.horizontal[pair / verticals], patches.vertical[pair % verticals]);
  });

  const auto tiles = complete_edge_set(options.colors.horizontal, options.colors.vertical);
  SourceMap result{options.tile_size, options.colors, tiles, {}, options.guard};
  result.texels.resize(tiles.size());
  each_side_by_side(tiles.size(), [&](std::size_t id) {
    auto& texels = result.texels[id];
    texels.resize(static_cast<std::size_t>(geometry.tile.width) *
                  static_cast<std::size_t>(geometry.tile.height));
    for (int quadrant = 0; quadrant < QuiltGeometry::quadrants; ++quadrant) {
      const auto h =
          static_cast<std::size_t>(QuiltGeometry::lower(quadrant) ? tiles[id].south : tiles[id].north);
      const auto v =
          static_cast<std::size_t>(QuiltGeometry::right(quadrant) ? tiles[id].east : tiles[id].west);
      const PathCut& cut =
          cuts[(h * verticals + v) * QuiltGeometry::quadrants + static_cast<std::size_t>(quadrant)];
      for (int row = 0; row < geometry.rows(quadrant); ++row)
        for (int column = 0; column < geometry.columns(quadrant); ++column) {
          const SourceTexel at = geometry.texel(quadrant, row, column);
          const bool before = column < cut.column[static_cast<std::size_t>(row)];
          texels[static_cast<std::size_t>(at.y) * static_cast<std::size_t>(geometry.tile.width) +
                 static_cast<std::size_t>(at.x)] =
              before ? moved(patches.vertical[v], geometry.in_vertical_window(quadrant, at))
                     : moved(patches.horizontal[h], geometry.in_horizontal_window(quadrant, at));
        }
    }
  });
  return result;
}

} // namespace tilepack
