#include "tilepack/synth/framed_set.h"

#include "tilepack/synth/frame.h"
#include "tilepack/tileset/random.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

namespace tilepack {
namespace {

// Above this many texels a search would take more memory than the sample itself.
constexpr std::int64_t most_searched_texels = 150'000;

// The image halved again and again while its tiles stay at least `smallest_tile` texels wide, and further if
// it is too large to be searched.
std::vector<FeatureImage> pyramid_down_to(FeatureImage image, Size tile, int smallest_tile) {
  std::vector<FeatureImage> levels;
  levels.push_back(std::move(image));
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

// Texels beyond its borders that are kept beside a tile while it is mended: what its strips show there, which
// is what any neighbour shows unless its own cut runs closer. Without them a seam would drift to the border,
// where nothing would tell how it looks from the other side. As wide as half a square of the coarse polish,
// rounded up.
int margin_of(const FrameShape& shape) {
  return std::min(8, shape.reach);
}

SourceCanvas with_margin(const FrameShape& shape, const FramePlan& plan, const Frame& frame, std::size_t id,
                         const SourceCanvas& tile) {
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

void polish_both(const std::vector<FeatureImage>& pyramid, const std::vector<std::uint8_t>& fixed,
                 const FramedSetSettings& settings, std::string_view purpose, std::size_t index,
                 SourceCanvas& canvas) {
  PolishOptions coarse = settings.coarse_polish;
  PolishOptions fine = settings.polish;
  coarse.seed = fine.seed = random_bits(fine.seed, purpose, index);
  if (pyramid.size() > 1) polish_at_half_size(pyramid[1], fixed, coarse, canvas);
  polish(pyramid.front(), fixed, fine, canvas);
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
    polish_both(pyramid, fixed, settings, "polish strip", i, canvas);
  });
}

} // namespace

FramedSetSettings settings_for(int effort, std::uint64_t seed) {
  struct Row {
    int starts, candidates, recounted, spots, tries, polish_passes;
  };
  static constexpr std::array<Row, 10> rows{{{1, 6, 0, 0, 0, 0},
                                             {1, 8, 0, 0, 0, 1},
                                             {1, 8, 0, 4, 1, 1},
                                             {2, 12, 0, 6, 1, 2},
                                             {2, 12, 0, 8, 2, 2},
                                             {3, 12, 0, 12, 2, 3},
                                             {4, 16, 0, 16, 2, 3},
                                             {8, 20, 2500, 24, 2, 4},
                                             {12, 24, 2500, 32, 3, 5},
                                             {16, 32, 2500, 48, 4, 6}}};
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
  settings.polish.doubt = 100;
  settings.coarse_polish.passes = row.polish_passes;
  settings.coarse_polish.reach = 6;
  settings.coarse_polish.seam_threshold = 500;
  return settings;
}

SourceMap framed_set(FeatureImage sample, const SynthOptions& options,
                     const FramedSetSettings& settings, const Progress& progress) {
  FrameShape shape = frame_shape(options, settings.reach, settings.corner_reach);
  const std::vector<FeatureImage> pyramid =
      pyramid_down_to(std::move(sample), shape.tile, settings.smallest_search_tile);
  const FeatureImage& image = pyramid.front();
  const SampleStatistics statistics(image);
  const FramePlan plan = searched_frame(pyramid, statistics, shape, settings.frame, progress);
  const PatchSearch search(pyramid.back());
  Frame frame = joined_frame(image, shape, plan);
  mend_frame(pyramid, search, shape, settings, frame);
  auto tiles = framed_tiles(shape, frame);
  const auto interiors =
      chosen_interiors(pyramid, search, statistics, shape, plan, tiles, settings.interiors, progress);
  join_interiors(image, shape, interiors, settings.interiors.bias, tiles);

  report(progress, "mending", 0.0);
  const auto fixed = fixed_texels(shape);
  tbb::parallel_for(std::size_t{0}, tiles.size(), [&](std::size_t id) {
    SourceCanvas canvas = with_margin(shape, plan, frame, id, tiles[id]);
    mend_spots(pyramid, search, fixed, settings.mend, canvas);
    polish_both(pyramid, fixed, settings, "polish tile", id, canvas);
    tiles[id] = without_margin(shape, canvas);
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
