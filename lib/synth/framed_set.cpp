#include "tilepack/synth/framed_set.h"

#include "tilepack/synth/frame.h"
#include "tilepack/tileset/random.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

namespace tilepack {
namespace {

// Above this many texels a search would take more memory than the sample itself.
constexpr std::int64_t most_searched_texels = 1'100'000;

// The image halved again and again while its tiles stay at least `smallest_tile` texels wide, and further if
// it is too large to be searched.
std::vector<FeatureImage> pyramid_down_to(const FeatureImage& image, Size tile, int smallest_tile) {
  std::vector<FeatureImage> levels{image};
  int side = std::min(tile.width, tile.height);
  const auto too_large = [&] {
    return static_cast<std::int64_t>(levels.back().width) * levels.back().height > most_searched_texels;
  };
  while (side / 2 >= smallest_tile || (too_large() && side / 2 >= 4)) {
    levels.push_back(halved(levels.back()));
    side /= 2;
  }
  return levels;
}

std::vector<std::uint8_t> guard_texels(const FrameShape& shape) {
  std::vector<std::uint8_t> fixed;
  for (int y = 0; y < shape.tile.height; ++y)
    for (int x = 0; x < shape.tile.width; ++x) fixed.push_back(in_guard(shape, x, y));
  return fixed;
}

// Strips are mended before tiles are made of them, so that what crosses an edge is mended on both its sides.
// The squares at the lattice points, which all strips there share, stay.
void mend_frame(const std::vector<FeatureImage>& pyramid, const PatchSearch& search, const FrameShape& shape,
                const FramedSetSettings& settings, Frame& frame) {
  const std::size_t h = frame.horizontal.size();
  tbb::parallel_for(std::size_t{0}, h + frame.vertical.size(), [&](std::size_t i) {
    const bool horizontal = i < h;
    SourceCanvas& canvas = horizontal ? frame.horizontal[i] : frame.vertical[i - h];
    std::vector<std::uint8_t> fixed;
    for (int y = 0; y < canvas.height; ++y)
      for (int x = 0; x < canvas.width; ++x) {
        const int from_end =
            horizontal ? std::min(x, canvas.width - 1 - x) : std::min(y, canvas.height - 1 - y);
        fixed.push_back(from_end < shape.guard);
      }
    MendOptions mend = settings.mend;
    mend.spots = settings.strip_spots;
    mend_spots(pyramid, search, fixed, mend, canvas);
    PolishOptions own = settings.polish;
    own.seed = random_bits(settings.polish.seed, "polish strip", i);
    polish(pyramid.front(), fixed, own, canvas);
  });
}

} // namespace

FramedSetSettings settings_for(int effort, std::uint64_t seed) {
  struct Row {
    int starts, candidates, recounted, spots, tries, polish_passes;
  };
  static constexpr std::array<Row, 10> rows{{{1, 6, 0, 0, 0, 0},
                                             {1, 8, 0, 0, 0, 1},
                                             {2, 8, 0, 4, 1, 1},
                                             {2, 12, 400, 6, 1, 2},
                                             {4, 12, 600, 8, 2, 2},
                                             {4, 12, 800, 12, 2, 3},
                                             {8, 16, 1000, 16, 2, 3},
                                             {16, 20, 1500, 24, 2, 4},
                                             {24, 24, 2500, 32, 3, 5},
                                             {48, 32, 2500, 48, 4, 6}}};
  const Row& row = rows[static_cast<std::size_t>(effort)];
  FramedSetSettings settings;
  settings.frame.seed = seed;
  settings.frame.starts = row.starts;
  settings.frame.candidates = row.candidates;
  settings.interiors.seed = seed;
  settings.interiors.recounted = row.recounted;
  settings.mend.spots = row.spots;
  settings.strip_spots = row.spots / 3;
  settings.mend.tries = row.tries;
  settings.polish.seed = seed;
  settings.polish.passes = row.polish_passes;
  return settings;
}

SourceMap framed_set(const FeatureImage& image, const SynthOptions& options,
                     const FramedSetSettings& settings, const Progress& progress) {
  FrameShape shape = frame_shape(options, settings.reach, settings.corner_reach);
  const SampleStatistics statistics(image);
  std::vector<FeatureImage> pyramid = pyramid_down_to(image, shape.tile, settings.smallest_search_tile);
  const FramePlan plan = searched_frame(pyramid, statistics, shape, settings.frame, progress);
  pyramid = pyramid_down_to(image, shape.tile, settings.smallest_interior_tile);
  const PatchSearch search(pyramid.back());
  Frame frame = joined_frame(image, shape, plan);
  mend_frame(pyramid, search, shape, settings, frame);
  auto tiles = framed_tiles(shape, frame);
  const auto interiors =
      chosen_interiors(pyramid, search, statistics, shape, plan, tiles, settings.interiors, progress);
  join_interiors(image, shape, interiors, settings.interiors.bias, tiles);

  report(progress, "mending", 0.0);
  const auto fixed = guard_texels(shape);
  tbb::parallel_for(std::size_t{0}, tiles.size(), [&](std::size_t id) {
    mend_spots(pyramid, search, fixed, settings.mend, tiles[id]);
    PolishOptions own = settings.polish;
    own.seed = random_bits(settings.polish.seed, "polish tile", id);
    polish(image, fixed, own, tiles[id]);
  });
  report(progress, "mending", 1.0);

  SourceMap result{options.tile_size, options.colors, {}, {}, options.guard};
  if (options.coloring == Coloring::corner)
    result.tiles = complete_corner_set(options.colors.corner);
  else
    result.tiles = complete_edge_set(options.colors.horizontal, options.colors.vertical);
  for (auto& tile : tiles) result.texels.push_back(std::move(tile.texels));
  return result;
}

} // namespace tilepack
