#include "tilepack/synth/framed_set.h"

#include "tilepack/match/use_counts.h"
#include "tilepack/numeric/random.h"
#include "tilepack/synth/frame.h"
#include "tilepack/synth/strip_axes.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <array>

namespace tilepack {
namespace {

// Above this many texels a search would take more memory than the sample itself.
constexpr std::int64_t most_searched_texels = 150'000;

// Halved again and again while its tiles stay at least `smallest_tile` texels wide, and further if it is too
// large to be searched.
FeaturePyramid pyramid_down_to(const FeatureImage& image, Size tile, int smallest_tile) {
  FeaturePyramid levels(image);
  int side = std::min(tile.width, tile.height);
  const auto too_large = [&] {
    return static_cast<std::int64_t>(levels.back().width) * levels.back().height > most_searched_texels;
  };
  while (side / 2 >= smallest_tile || (too_large() && side / 2 >= 4)) {
    levels.add_half();
    side /= 2;
  }
  return levels;
}

// Texels beyond its borders that are kept beside a tile while it is mended: what its strips show there, which
// is what any neighbour shows unless its own cut runs closer. Without them a seam would drift to the border,
// where nothing would tell how it looks from the other side. As wide as half a square of the coarse polish,
// rounded up.
int margin_of(const FrameShape& shape) {
  return std::min(8, shape.reach);
}

SourceCanvas with_margin(const FrameShape& shape, const FrameSources& plan, const Frame& frame,
                         std::size_t id, const SourceCanvas& tile) {
  const int m = margin_of(shape);
  const int w = shape.tile.width;
  const int h = shape.tile.height;
  const FrameShape::Tile& t = shape.tiles[id];
  const auto north = static_cast<std::size_t>(t.north);
  const auto south = static_cast<std::size_t>(t.south);
  SourceCanvas canvas(w + 2 * m, h + 2 * m);
  for (int j = 0; j < canvas.height; ++j)
    for (int i = 0; i < canvas.width; ++i) {
      const int x = i - m;
      const int y = j - m;
      const bool beside = x < 0 || x >= w;
      SourceTexel& texel = canvas.at(i, j);
      if (beside && (y < 0 || y >= h)) {
        const FrameShape::Strip& strip = shape.horizontal[y < 0 ? north : south];
        const SourceTexel corner = plan.corners[static_cast<std::size_t>(x < 0 ? strip.first : strip.second)];
        texel = {corner.x + (x < 0 ? x : x - w), corner.y + (y < 0 ? y : y - h)};
      } else if (y < 0) {
        texel = frame.horizontal[north].at(x, shape.reach + y);
      } else if (y >= h) {
        texel = frame.horizontal[south].at(x, shape.reach + y - h);
      } else if (x < 0) {
        texel = frame.vertical[static_cast<std::size_t>(t.west)].at(shape.reach + x, y);
      } else if (x >= w) {
        texel = frame.vertical[static_cast<std::size_t>(t.east)].at(shape.reach + x - w, y);
      } else {
        texel = tile.at(x, y);
      }
    }
  return canvas;
}

SourceCanvas without_margin(const FrameShape& shape, const SourceCanvas& canvas) {
  const int m = margin_of(shape);
  SourceCanvas tile(shape.tile.width, shape.tile.height);
  for (int y = 0; y < tile.height; ++y)
    for (int x = 0; x < tile.width; ++x) tile.at(x, y) = canvas.at(x + m, y + m);
  return tile;
}

// Of a tile with its margin.
std::vector<std::uint8_t> fixed_texels(const FrameShape& shape) {
  const int m = margin_of(shape);
  std::vector<std::uint8_t> fixed;
  for (int y = -m; y < shape.tile.height + m; ++y)
    for (int x = -m; x < shape.tile.width + m; ++x) fixed.push_back(in_guard(shape, x, y));
  return fixed;
}

// The levels of the sample at which joins are polished.
struct MatchLevels {
  MatchLevels(const FeaturePyramid& sample_pyramid, const FramedSetSettings& settings)
      : pyramid(sample_pyramid) {
    const auto wanted = [](const PatchMatchOptions& options) {
      return options.passes > 0 && options.contrast_weight > 0;
    };
    if (wanted(settings.fine_match)) full = contrast_ranks(pyramid.front());
    if (wanted(settings.coarse_match) && pyramid.size() > 1) half = contrast_ranks(pyramid[1]);
  }

  // At half size and then at full size.
  void match_both(const std::vector<std::uint8_t>& fixed, Rect shown, const PatchMatchOptions& coarse,
                  const PatchMatchOptions& fine, std::vector<SourceCanvas>& canvases) const {
    if (pyramid.size() > 1) match_and_vote(pyramid[1], half, 2, fixed, shown, coarse, canvases);
    match_and_vote(pyramid.front(), full, 1, fixed, shown, fine, canvases);
  }

  const FeaturePyramid& pyramid;
  ContrastRanks full; // none where nothing asks for them
  ContrastRanks half;
};

// Strips are mended before tiles are made of them, so that what crosses an edge is mended on both its sides.
// The squares at the lattice points, which all strips there share, stay.
void repair_strips(const MatchLevels& levels, const PatchSearch& search, const FrameShape& shape,
                   const FrameSources& plan, const FramedSetSettings& settings, Direction direction,
                   std::vector<SourceCanvas>& strips) {
  const StripAxes space = space_of(shape, direction);
  const Rect all{0, 0, space.width(), space.height()};
  std::vector<std::uint8_t> fixed;
  for (int y = 0; y < all.height; ++y)
    for (int x = 0; x < all.width; ++x) {
      const int along = direction == Direction::horizontal ? x : y;
      fixed.push_back(std::min(along, space.length - 1 - along) < shape.guard);
    }
  const PeriodAlignment phase = plan.phase.seen_from(strip_place(space, 1));
  UseCounts nothing_shown(levels.pyramid.back().width, levels.pyramid.back().height);
  nothing_shown.prepare();
  tbb::parallel_for(std::size_t{0}, strips.size(), [&](std::size_t i) {
    replace_worst_patches(levels.pyramid, search, nothing_shown, phase, fixed, settings.repair, strips[i]);
  });
  PatchMatchOptions coarse = settings.coarse_match;
  PatchMatchOptions fine = settings.fine_match;
  coarse.freshness = fine.freshness = 0.0; // few strips could not show all of the sample if they wanted
  const char* purpose = direction == Direction::horizontal ? "polish horizontal" : "polish vertical";
  coarse.seed = fine.seed = random_bits(fine.seed, purpose, 0);
  levels.match_both(fixed, all, coarse, fine, strips);
}

UseCounts shown_at(const FeatureImage& small, int scale, const std::vector<SourceCanvas>& tiles) {
  UseCounts usage(small.width, small.height);
  for (const SourceCanvas& tile : tiles)
    for (const SourceTexel s : tile.texels) usage.add({s.x / scale, s.y / scale, 1, 1}, 1.0);
  usage.prepare();
  return usage;
}

} // namespace

FramedSetSettings settings_for(int effort, std::uint64_t seed) {
  struct Row {
    int starts, candidates, spots, tries, passes, sweeps;
  };
  static constexpr std::array<Row, 10> rows{{{1, 6, 0, 0, 0, 0},
                                             {1, 8, 0, 0, 1, 3},
                                             {1, 8, 2, 1, 2, 3},
                                             {2, 12, 3, 1, 2, 4},
                                             {2, 12, 4, 2, 2, 5},
                                             {3, 12, 4, 2, 4, 6},
                                             {3, 12, 6, 2, 5, 8},
                                             {3, 12, 8, 2, 6, 10},
                                             {3, 12, 8, 2, 10, 12},
                                             {3, 12, 8, 2, 16, 16}}};
  const Row& row = rows[static_cast<std::size_t>(effort)];
  FramedSetSettings settings;
  settings.frame.seed = seed;
  settings.frame.starts = row.starts;
  settings.frame.candidates = row.candidates;
  settings.interiors.seed = seed;
  if (effort == 0) {
    settings.interiors.starts = 4;
    settings.interiors.rounds = 2;
  }
  settings.repair.spots = row.spots;
  settings.repair.tries = row.tries;
  settings.fine_match.seed = seed;
  settings.fine_match.passes = row.passes;
  settings.fine_match.sweeps = row.sweeps;
  settings.fine_match.freshness = 0.2;
  settings.coarse_match = settings.fine_match;
  if (row.passes > 0) { // half as large, so that a pass more costs little
    ++settings.coarse_match.passes;
    ++settings.coarse_match.sweeps;
  }
  // Only here, where most matches are made: at full size the same contrast costs more likeness.
  settings.coarse_match.contrast_weight = 1.5;
  settings.coarse_match.reach = 6;
  settings.coarse_match.seam_threshold = 500;
  return settings;
}

SourceMap framed_set(const SampleAnalysis& sample, const SynthOptions& options,
                     const FramedSetSettings& settings, const Progress& progress) {
  const FeatureImage& image = sample.features;
  const FrameShape shape = frame_shape(options, sample.periods, settings.reach, settings.corner_reach);
  const FeaturePyramid pyramid = pyramid_down_to(image, shape.tile, settings.smallest_search_tile);
  const PatchSearch search(pyramid.back());
  const MatchLevels levels(pyramid, settings);
  const FrameSources plan = searched_frame(pyramid, search, sample, shape, settings.frame, progress);
  Frame frame = joined_frame(image, shape, plan);
  tbb::parallel_invoke(
      [&] { repair_strips(levels, search, shape, plan, settings, Direction::horizontal, frame.horizontal); },
      [&] { repair_strips(levels, search, shape, plan, settings, Direction::vertical, frame.vertical); });
  auto tiles = framed_tiles(shape, frame);
  const auto interiors =
      chosen_interiors(pyramid, search, sample, shape, plan, tiles, settings.interiors, progress).places;
  join_interiors(image, shape, interiors, settings.interiors.bias, tiles);

  report(progress, "mending", 0.0);
  const int margin = margin_of(shape);
  const PeriodAlignment phase = plan.phase.seen_from({-margin, -margin});
  const auto fixed = fixed_texels(shape);
  const UseCounts usage = shown_at(pyramid.back(), 1 << (pyramid.size() - 1), tiles);
  tbb::parallel_for(std::size_t{0}, tiles.size(), [&](std::size_t id) {
    tiles[id] = with_margin(shape, plan, frame, id, tiles[id]);
    replace_worst_patches(pyramid, search, usage, phase, fixed, settings.repair, tiles[id]);
  });
  report(progress, "mending", 0.3);
  levels.match_both(fixed, {margin, margin, shape.tile.width, shape.tile.height}, settings.coarse_match,
                    settings.fine_match, tiles);
  for (SourceCanvas& tile : tiles) tile = without_margin(shape, tile);
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
