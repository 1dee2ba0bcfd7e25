#include "tilepack/synth/framed_set.h"

#include "tilepack/exemplar/cheapest_lines.h"
#include "tilepack/exemplar/object_scale.h"
#include "tilepack/exemplar/structure.h"
#include "tilepack/match/use_counts.h"
#include "tilepack/numeric/random.h"
#include "tilepack/numeric/side_by_side.h"
#include "tilepack/seam/patch_match.h"
#include "tilepack/seam/seam_repair.h"
#include "tilepack/synth/frame.h"
#include "tilepack/synth/frame_search.h"
#include "tilepack/synth/interiors.h"
#include "tilepack/synth/search_space.h"
#include "tilepack/synth/set_repair.h"
#include "tilepack/synth/strip_axes.h"

#include <algorithm>
#include <array>
#include <utility>

namespace tilepack {
namespace {

// Halved again and again while its tiles stay at least smallest_search_tile texels wide.
FeaturePyramid searched_pyramid(const FeatureImage& image, Size tile, const FramedSetSettings& settings) {
  FeaturePyramid levels(image);
  for (int side = std::min(tile.width, tile.height); side / 2 >= settings.smallest_search_tile; side /= 2)
    levels.add_half();
  return levels;
}

// A tile that may lie beside each tile, in each of eight directions: the first of the set.
class Neighbours {
public:
  explicit Neighbours(const FrameShape& shape) {
    const auto first = [&](auto&& wanted) {
      return static_cast<std::size_t>(std::find_if(shape.tiles.begin(), shape.tiles.end(), wanted) -
                                      shape.tiles.begin());
    };
    using Tile = FrameShape::Tile;
    for (std::size_t id = 0; id < shape.tiles.size(); ++id) {
      const Tile& t = shape.tiles[id];
      const std::size_t north = first([&](const Tile& n) { return n.south == t.north; });
      const std::size_t south = first([&](const Tile& n) { return n.north == t.south; });
      const auto beside = [&](const Tile& middle) {
        return std::pair{first([&](const Tile& n) { return n.east == middle.west; }),
                         first([&](const Tile& n) { return n.west == middle.east; })};
      };
      const auto [west, east] = beside(t);
      const auto [north_west, north_east] = beside(shape.tiles[north]);
      const auto [south_west, south_east] = beside(shape.tiles[south]);
      tiles.push_back({north_west, north, north_east, west, id, east, south_west, south, south_east});
    }
  }
  std::size_t of(std::size_t id, int column, int row) const {
    return tiles[id][static_cast<std::size_t>(3 * row + column)];
  }

private:
  std::vector<std::array<std::size_t, 9>> tiles;
};

// What lies near the four borders of a tile, for its neighbours to see.
class TileBorder {
public:
  TileBorder(const SourceCanvas& tile, int border_depth)
      : depth(border_depth), width(tile.width), height(tile.height), north(width, depth), south(width, depth),
        west(depth, height), east(depth, height) {
    for (int y = 0; y < depth; ++y)
      for (int x = 0; x < width; ++x) {
        north.at(x, y) = tile.at(x, y);
        south.at(x, y) = tile.at(x, height - depth + y);
      }
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < depth; ++x) {
        west.at(x, y) = tile.at(x, y);
        east.at(x, y) = tile.at(width - depth + x, y);
      }
  }
  const SourceTexel& at(int x, int y) const {
    if (y < depth) return north.at(x, y);
    if (y >= height - depth) return south.at(x, y - height + depth);
    return x < depth ? west.at(x, y) : east.at(x - width + depth, y);
  }

private:
  int depth, width, height;
  SourceCanvas north, south, west, east;
};

// A tile in the midst of `margin` texels beyond its borders: what neighbours show there. Without them a seam would drift to the border, where nothing
// would tell how it looks from the other side.
SourceCanvas with_margin(const Neighbours& neighbours, int margin, std::size_t id, const SourceCanvas& tile,
                         const std::vector<TileBorder>& borders) {
  const int w = tile.width;
  const int h = tile.height;
  SourceCanvas canvas(w + 2 * margin, h + 2 * margin);
  for (int j = 0; j < canvas.height; ++j) {
    const int y = j - margin;
    const int row = y < 0 ? 0 : y < h ? 1 : 2;
    for (int i = 0; i < canvas.width; ++i) {
      const int x = i - margin;
      const int column = x < 0 ? 0 : x < w ? 1 : 2;
      canvas.at(i, j) =
          column == 1 && row == 1
              ? tile.at(x, y)
              : borders[neighbours.of(id, column, row)].at(x - (column - 1) * w, y - (row - 1) * h);
    }
  }
  return canvas;
}

SourceCanvas without_margin(const SourceCanvas& canvas, int margin) {
  SourceCanvas tile(canvas.width - 2 * margin, canvas.height - 2 * margin);
  for (int y = 0; y < tile.height; ++y)
    for (int x = 0; x < tile.width; ++x) tile.at(x, y) = canvas.at(x + margin, y + margin);
  return tile;
}

// Of a tile with its margin.
std::vector<std::uint8_t> fixed_texels(const FrameShape& shape, int margin) {
  std::vector<std::uint8_t> fixed;
  for (int y = -margin; y < shape.tile.height + margin; ++y)
    for (int x = -margin; x < shape.tile.width + margin; ++x) fixed.push_back(in_guard(shape, x, y));
  return fixed;
}

// The levels of the sample at which PatchMatch works.
class MatchLevels {
public:
  MatchLevels(const FeaturePyramid& sample_pyramid, const FramedSetSettings& settings)
      : pyramid(sample_pyramid) {
    const auto wanted = [](const PatchMatchOptions& options) {
      return options.passes > 0 && options.contrast_weight > 0;
    };
    if (wanted(settings.fine_match)) full = contrast_ranks(pyramid.front());
    if (wanted(settings.coarse_match) && pyramid.size() > 1) half = contrast_ranks(pyramid[1]);
  }

  // At half size and then at full size.
  void match_both(const std::vector<std::uint8_t>& fixed, Rect counted, const PatchMatchOptions& coarse,
                  const PatchMatchOptions& fine, std::vector<SourceCanvas>& canvases) const {
    if (pyramid.size() > 1) match_and_vote({pyramid[1], half, 2, fixed, counted}, coarse, canvases);
    match_and_vote({pyramid.front(), full, 1, fixed, counted}, fine, canvases);
  }

private:
  const FeaturePyramid& pyramid;
  ContrastRanks full; // none where nothing asks for them
  ContrastRanks half;
};

// The squares at the lattice points, which all strips there share, stay.
std::vector<std::uint8_t> fixed_texels(const StripAxes& axes, int guard) {
  std::vector<std::uint8_t> fixed;
  for (int y = 0; y < axes.height(); ++y)
    for (int x = 0; x < axes.width(); ++x) {
      const int along = axes.direction == Direction::horizontal ? x : y;
      fixed.push_back(std::min(along, axes.length - 1 - along) < guard);
    }
  return fixed;
}

// Strips are repaired before tiles are made of them, so that what crosses an edge is repaired on both its sides.
void repair_strips(const SearchSpace& space, const MatchLevels& levels, const FrameSources& sources,
                   const FramedSetSettings& settings, Direction direction,
                   std::vector<SourceCanvas>& strips) {
  const StripAxes axes = axes_of(space.shape, direction);
  const std::vector<std::uint8_t> fixed = fixed_texels(axes, space.shape.guard);
  const PeriodAlignment alignment = sources.alignment.seen_from(strip_place(axes, 1));
  const UseTable no_uses = prepared(UseCounts(space.small_image().width, space.small_image().height));
  each_side_by_side(strips.size(), [&](std::size_t i) {
    replace_worst_patches({space.pyramid, space.search, no_uses, alignment, fixed}, settings.repair,
                          strips[i]);
  });
  PatchMatchOptions coarse = settings.coarse_match;
  PatchMatchOptions fine = settings.fine_match;
  coarse.reuse_weight = fine.reuse_weight = 0.0; // few strips could not show all of the sample if they wanted
  const char* purpose = direction == Direction::horizontal ? "polish horizontal" : "polish vertical";
  coarse.seed = fine.seed = random_bits(fine.seed, purpose, 0);
  levels.match_both(fixed, {0, 0, axes.width(), axes.height()}, coarse, fine, strips);
}

// What tiles show of the level that is searched.
UseTable uses_by(const SearchSpace& space, const std::vector<SourceCanvas>& tiles) {
  UseCounts counts(space.small_image().width, space.small_image().height);
  const int scale = space.scale();
  for (const SourceCanvas& tile : tiles)
    for (const SourceTexel s : tile.texels) counts.add_texel(s.x / scale, s.y / scale);
  return prepared(counts);
}

void repair_tiles(const SearchSpace& space, const MatchLevels& levels, const FrameSources& sources,
                  const FramedSetSettings& settings, std::vector<SourceCanvas>& tiles,
                  const Progress& progress) {
  report(progress, "repair", 0.0);
  const FrameShape& shape = space.shape;
  repair_set(space, sources.alignment, uses_by(space, tiles), settings.set_repair, tiles);
  const UseTable uses = uses_by(space, tiles);
  const int margin = std::min({settings.margin, shape.reach.x, shape.reach.y});
  const PeriodAlignment alignment = sources.alignment.seen_from({-margin, -margin});
  const auto fixed = fixed_texels(shape, margin);
  const Neighbours neighbours(shape);
  std::vector<TileBorder> borders;
  for (const SourceCanvas& tile : tiles) borders.emplace_back(tile, margin);
  std::vector<SourceCanvas> wide(tiles.size());
  each_side_by_side(tiles.size(), [&](std::size_t id) {
    wide[id] = with_margin(neighbours, margin, id, tiles[id], borders);
    tiles[id] = {}; // sets of large tiles are large
    replace_worst_patches({space.pyramid, space.search, uses, alignment, fixed}, settings.repair, wide[id]);
  });
  report(progress, "repair", 0.3);
  levels.match_both(fixed, {margin, margin, shape.tile.width, shape.tile.height}, settings.coarse_match,
                    settings.fine_match, wide);
  for (std::size_t id = 0; id < tiles.size(); ++id) {
    tiles[id] = without_margin(wide[id], margin);
    wide[id] = {};
  }
  report(progress, "repair", 1.0);
}

SourceMap source_map(const SynthOptions& options, std::vector<SourceCanvas> tiles) {
  SourceMap result{options.tile_size, options.colors, complete_set(options.colors), {}, options.guard};
  for (auto& tile : tiles) result.texels.push_back(std::move(tile.texels));
  return result;
}

} // namespace

SourceMap framed_set(const SampleAnalysis& sample, const SynthOptions& options,
                     const FramedSetSettings& wanted_settings, const Progress& progress) {
  const FramedSetSettings settings =
      fitted(wanted_settings, object_scale(sample.features), variance_of(sample.features), options.tile_size,
             PeriodAlignment(sample.periods, options.tile_size));
  const FeatureImage image =
      with_structure(sample.features, settings.structure, halvings_to_usual(options.tile_size));
  FrameShape shape = frame_shape(options, sample.periods, settings.reach, settings.corner_reach);
  if (shape.alignment.lattice())
    shape.alignment = shape.alignment.through(cheapest_lines(image, sample.periods));
  const SearchSpace space(sample, shape, searched_pyramid(image, shape.tile, settings),
                          settings.most_searched_texels);
  const MatchLevels levels(space.pyramid, settings);
  const FrameSources sources = searched_frame(space, settings.frame, settings.refine, progress);
  Frame frame = joined_frame(space.pyramid, shape, sources);
  both_side_by_side(
      [&] { repair_strips(space, levels, sources, settings, Direction::horizontal, frame.horizontal); },
      [&] { repair_strips(space, levels, sources, settings, Direction::vertical, frame.vertical); });
  auto tiles = framed_tiles(shape, frame);
  const auto interiors = chosen_interiors(space, sources, tiles, settings.interiors, progress).places;
  join_interiors(space, interiors, settings.interiors.bias, tiles);
  repair_tiles(space, levels, sources, settings, tiles, progress);
  return source_map(options, std::move(tiles));
}

} // namespace tilepack
