#include "tilepack/synth/interiors.h"

#include "tilepack/match/use_counts.h"
#include "tilepack/numeric/random.h"
#include "tilepack/numeric/side_by_side.h"
#include "tilepack/seam/graph_cut.h"
#include "tilepack/seam/scaled_cut.h"
#include "tilepack/synth/inside_cuts.h"
#include "tilepack/synth/strip_axes.h"
#include "tilepack/synth/tile_levels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

namespace tilepack {
namespace {

struct Choice {
  SourceTexel place;
  std::int64_t mismatch;
};

bool costs_less(const Choice& a, const Choice& b) {
  return std::tuple(a.mismatch, a.place.y, a.place.x) < std::tuple(b.mismatch, b.place.y, b.place.x);
}

// The best position of each square block of positions, blocks as small as the limit allows.
std::vector<Choice> block_minima(PositionMap& map, std::size_t limit) {
  std::size_t open = 0;
  for (const PositionMap::Part& part : map.parts)
    open += part.values.size() -
            static_cast<std::size_t>(std::count(part.values.begin(), part.values.end(), ruled_out));
  int block = 1;
  while (open > limit * static_cast<std::size_t>(block) * static_cast<std::size_t>(block)) ++block;
  std::vector<Choice> choices;
  for (PositionMap::Part& part : map.parts) {
    const int right = part.area.x + part.area.width, bottom = part.area.y + part.area.height;
    // Of one grid for all parts, which lie further apart than blocks are wide.
    for (int y = part.area.y / block * block; y < bottom; y += block)
      for (int x = part.area.x / block * block; x < right; x += block) {
        Choice best{{x, y}, ruled_out};
        for (int j = std::max(y, part.area.y); j < std::min(bottom, y + block); ++j)
          for (int i = std::max(x, part.area.x); i < std::min(right, x + block); ++i)
            if (part.at(i, j) < best.mismatch) best = {{i, j}, part.at(i, j)};
        if (best.mismatch != ruled_out) choices.push_back(best);
      }
  }
  return choices;
}

// What is seen of a strip: cuts run half-way between border and reach.
Rect shown_part(const FrameShape& shape, SourceTexel strip, Direction direction) {
  const StripAxes axes = axes_of(shape, direction);
  const SourceTexel first = sum(strip, axes.at(0, axes.reach - axes.reach / 2));
  const SourceTexel extent = axes.at(axes.length, axes.reach);
  return {first.x, first.y, extent.x, extent.y};
}

void set_reuse_weights(const Saliency& saliency, double saliency_weight, int scale, UseCounts& counts) {
  const int side = saliency.side;
  for (int y = 0; y < saliency.high; ++y)
    for (int x = 0; x < saliency.wide; ++x) {
      const double excess = saliency.at(x, y) - salient_deviation;
      if (excess <= 0) continue;
      const int weight = 1 + static_cast<int>(std::lround(saliency_weight * excess));
      counts.set_reuse_weight({x * side / scale, y * side / scale, side / scale, side / scale}, weight);
    }
}

// A strip counts once, though it is shown in many tiles: whatever the insides are, it is, and an inside that
// shows it too wastes no more room than one that shows another inside again.
void add_strips(const FrameShape& shape, const FrameSources& sources, int scale, UseCounts& counts) {
  const auto add = [&](Rect r) {
    counts.add({r.x / scale, r.y / scale, r.width / scale, r.height / scale}, 1.0);
  };
  for (const SourceTexel& p : sources.horizontal) add(shown_part(shape, p, Direction::horizontal));
  for (const SourceTexel& p : sources.vertical) add(shown_part(shape, p, Direction::vertical));
}

SampleStatistics::Tally strips_tally(const FrameShape& shape, const FrameSources& sources,
                                     const SampleStatistics& statistics) {
  SampleStatistics::Tally tally = statistics.empty();
  const double h = static_cast<double>(shape.tiles.size()) / static_cast<double>(sources.horizontal.size());
  const double v = static_cast<double>(shape.tiles.size()) / static_cast<double>(sources.vertical.size());
  for (const SourceTexel& p : sources.horizontal)
    statistics.add(tally, shown_part(shape, p, Direction::horizontal), h);
  for (const SourceTexel& p : sources.vertical)
    statistics.add(tally, shown_part(shape, p, Direction::vertical), v);
  return tally;
}

// What a choice of all insides is judged by, at the scale of the search.
struct InteriorTask {
  const SampleStatistics& statistics;
  const InteriorOptions& options;
  const std::vector<std::vector<Choice>>& choices; // of each tile, best first
  UseCounts counts;                                // of what is placed; strips at first
  UseTable uses;                                   // the same, prepared
  SampleStatistics::Tally tally;                   // likewise
  Rect shown;                                      // of an inside, in its tile
  int scale;                                       // texels of the sample to one of the search
  double average;                                  // how often a part of the sample is shown
  double all_mismatches;                           // the sum of the best of each tile

  Rect inside(SourceTexel at) const { return {at.x + shown.x, at.y + shown.y, shown.width, shown.height}; }
  Rect inside_in_sample(SourceTexel at) const {
    const Rect r = inside(at);
    return {r.x * scale, r.y * scale, r.width * scale, r.height * scale};
  }
  void place(SourceTexel at, double weight) {
    counts.add(inside(at), weight);
    statistics.add(tally, inside_in_sample(at), weight);
    uses = prepared(counts);
  }
  // With its own tile not placed.
  double fit_and_reuse(const Choice& choice) const {
    return static_cast<double>(choice.mismatch) *
           (1.0 + options.reuse_weight * uses.mean(inside(choice.place)) / average);
  }
};

// By Fisher and Yates; `stream` tells shuffles apart, by at least as much as there are elements.
void shuffle(std::vector<std::size_t>& order, std::uint64_t seed, std::size_t stream) {
  for (std::size_t i = order.size(); i > 1; --i)
    std::swap(order[i - 1],
              order[random_below(seed, "interior order", stream + i, static_cast<std::uint32_t>(i))]);
}

// One tile after another takes what is best beside all others, in another order in each round and start.
InteriorChoice choose_all(InteriorTask task, std::size_t start) {
  const InteriorOptions& options = task.options;
  const std::size_t tiles = task.choices.size();
  const double statistics_weight = options.statistics_weight * task.all_mismatches;
  std::vector<const Choice*> chosen(tiles, nullptr);
  std::vector<std::size_t> order(tiles);
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (int round = 0; round < options.rounds; ++round) {
    shuffle(order, options.seed,
            (start * static_cast<std::size_t>(options.rounds) + static_cast<std::size_t>(round)) * tiles);
    for (const std::size_t id : order) {
      if (chosen[id] != nullptr) task.place(chosen[id]->place, -1.0);
      double least = std::numeric_limits<double>::max();
      for (const Choice& choice : task.choices[id]) {
        if (static_cast<double>(choice.mismatch) >= least) break; // nor do those after it cost less
        double cost = task.fit_and_reuse(choice);
        if (cost >= least) continue; // spares most of the looks at the statistics, which take longest
        cost += statistics_weight *
                task.statistics.distance_with(task.tally, task.inside_in_sample(choice.place), 1.0);
        if (cost < least) {
          least = cost;
          chosen[id] = &choice;
        }
      }
      task.place(chosen[id]->place, 1.0);
    }
  }
  InteriorChoice result;
  result.cost = statistics_weight * task.statistics.distance(task.tally);
  for (const Choice* choice : chosen) {
    task.place(choice->place, -1.0);
    result.cost += task.fit_and_reuse(*choice);
    task.place(choice->place, 1.0);
    result.places.push_back(choice->place);
  }
  return result;
}

// The places between which each tile chooses, best first. `framed`: see framed_tiles.
std::vector<std::vector<Choice>> listed_choices(const SearchSpace& space, const PeriodAlignment& alignment,
                                                const std::vector<SourceCanvas>& framed,
                                                const std::vector<TileLevels>& tiles,
                                                const InteriorOptions& options) {
  const std::size_t limit =
      options.cuts > 0 ? static_cast<std::size_t>(options.cuts)
                       : std::min(options.choices_per_tile,
                                  std::max(options.fewest_choices, options.choices_in_all / tiles.size()));
  std::vector<std::vector<Choice>> choices(tiles.size());
  each_side_by_side(tiles.size(), [&](std::size_t id) {
    PositionMap map = space.search.mismatches(tiles[id].overlap(space.pyramid.size() - 1));
    rule_out_of_step(map, alignment, space.scale());
    choices[id] = block_minima(map, limit);
    if (options.cuts > 0) {
      const InsideCuts cuts(space, framed[id], options.bias);
      for (Choice& choice : choices[id]) choice.mismatch = cuts.cost(choice.place);
    }
    std::sort(choices[id].begin(), choices[id].end(), costs_less);
  });
  return choices;
}

// Cuts run half-way between borders and the reach of strips.
Rect inside_shown(const FrameShape& shape, Size small_tile, int scale) {
  const int most = std::min(small_tile.width, small_tile.height) / 2 - 1;
  const int x = std::min(shape.reach.x / 2 / scale, most), y = std::min(shape.reach.y / 2 / scale, most);
  return {x, y, small_tile.width - 2 * x, small_tile.height - 2 * y};
}

InteriorTask interior_task(const SearchSpace& space, const FrameSources& sources,
                           const std::vector<std::vector<Choice>>& choices, const InteriorOptions& options) {
  const SampleStatistics& statistics = space.sample.statistics;
  const FeatureImage& small = space.small_image();
  const Size tile = space.small_shape.tile;
  const int scale = space.scale();
  int square = std::max(1, std::min(tile.width, tile.height) / options.use_squares);
  // Of a sample much larger than tiles fewer and larger ones are counted: all of them, after every choice.
  while (4 * square <= std::min(tile.width, tile.height) &&
         static_cast<double>(small.width) * small.height > options.most_squares * square * square)
    square *= 2;
  UseCounts counts(small.width, small.height, square);
  set_reuse_weights(space.sample.saliency, options.saliency_weight, scale, counts);
  add_strips(space.shape, sources, scale, counts);
  double all_mismatches = 0.0;
  for (const auto& list : choices) all_mismatches += static_cast<double>(list.front().mismatch);
  return {statistics,
          options,
          choices,
          counts,
          prepared(counts),
          strips_tally(space.shape, sources, statistics),
          inside_shown(space.shape, tile, scale),
          scale,
          static_cast<double>(choices.size()) * tile.width * tile.height /
              (static_cast<double>(small.width) * small.height),
          all_mismatches};
}

InteriorChoice best_of_starts(const InteriorTask& task) {
  const InteriorOptions& options = task.options;
  std::vector<InteriorChoice> starts(std::clamp<std::size_t>(
      options.tiles_in_all_starts / task.choices.size(), 1, static_cast<std::size_t>(options.starts)));
  each_side_by_side(starts.size(), [&](std::size_t start) { starts[start] = choose_all(task, start); });
  return *std::min_element(starts.begin(), starts.end(),
                           [](const auto& a, const auto& b) { return a.cost < b.cost; });
}

// Brings places found in the last level to the first, and there in step with what repeats.
void refine(const SearchSpace& space, const PeriodAlignment& alignment, const std::vector<TileLevels>& tiles,
            std::vector<SourceTexel>& places) {
  constexpr int distance = 2; // the rounding of the level before, and one
  each_side_by_side(tiles.size(), [&](std::size_t id) {
    for (std::size_t level = space.pyramid.size() - 1; level-- > 0;)
      places[id] = tiles[id].best_near(level, {2 * places[id].x, 2 * places[id].y}, distance);
    const Size tile = space.shape.tile;
    if (!alignment.free() && !alignment.allows(places[id], 1))
      places[id] = alignment.nearest(places[id], {0, 0},
                                     {space.image().width - tile.width, space.image().height - tile.height});
  });
}

// What a cut at the scale of the search settles for the cut at full size.
std::vector<CutConstraint> settled_by_search(const SearchSpace& space, const SourceCanvas& framed,
                                             SourceTexel place, std::int64_t bias) {
  const Size full{framed.width, framed.height};
  int level = space.levels() - 1;
  std::vector<CutConstraint> settled; // for `level`; by none, all is free
  if (level == 0) settled.assign(framed.texels.size(), CutConstraint::free);
  while (level > 0) {
    const FeatureImage& image = space.pyramid[static_cast<std::size_t>(level)];
    InsideCuts cuts(space, framed, bias, level);
    if (!settled.empty()) cuts.settle(settled);
    const int scale = 1 << level;
    const Size size = cuts.size();
    const std::vector<std::uint8_t> taken =
        cuts.taken({std::clamp((place.x + scale / 2) / scale, 0, image.width - size.width),
                    std::clamp((place.y + scale / 2) / scale, 0, image.height - size.height)});
    const int next = scale > widest_step ? level - 1 : 0;
    settled = settled_by(taken, size, {full.width >> next, full.height >> next}, 1 << (level - next));
    level = next;
  }
  return settled;
}

} // namespace

std::vector<SourceCanvas> framed_tiles(const FrameShape& shape, const Frame& frame) {
  std::vector<SourceCanvas> tiles(shape.tiles.size());
  const int w = shape.tile.width;
  const int h = shape.tile.height;
  const FrameShape::Reach reach = shape.reach;
  each_side_by_side(tiles.size(), [&](std::size_t id) {
    const FrameShape::Tile& t = shape.tiles[id];
    const SourceCanvas& north = frame.horizontal[static_cast<std::size_t>(t.north)];
    const SourceCanvas& south = frame.horizontal[static_cast<std::size_t>(t.south)];
    const SourceCanvas& west = frame.vertical[static_cast<std::size_t>(t.west)];
    const SourceCanvas& east = frame.vertical[static_cast<std::size_t>(t.east)];
    SourceCanvas canvas(w, h);
    for (int y = 0; y < h; ++y)
      for (int x = 0; x < w; ++x) {
        const int from_south = h - 1 - y;
        const int from_east = w - 1 - x;
        const int vertical = std::min(y, from_south);
        const int horizontal = std::min(x, from_east);
        SourceTexel& texel = canvas.at(x, y);
        if (vertical >= reach.y && horizontal >= reach.x)
          texel = no_source;
        else if (vertical * reach.x <= horizontal * reach.y) // the diagonal, and nearer to a horizontal edge
          texel = y <= from_south ? north.at(x, reach.y + y) : south.at(x, reach.y - 1 - from_south);
        else
          texel = x <= from_east ? west.at(reach.x + x, y) : east.at(reach.x - 1 - from_east, y);
      }
    tiles[id] = std::move(canvas);
  });
  return tiles;
}

InteriorChoice chosen_interiors(const SearchSpace& space, const FrameSources& sources,
                                const std::vector<SourceCanvas>& framed, const InteriorOptions& options,
                                const Progress& progress) {
  report(progress, "interiors", 0.0);
  const std::vector<TileLevels> levels = tile_levels(space, framed);
  const auto choices = listed_choices(space, sources.alignment, framed, levels, options);
  report(progress, "interiors", 0.5);
  InteriorChoice best = best_of_starts(interior_task(space, sources, choices, options));
  refine(space, sources.alignment, levels, best.places);
  report(progress, "interiors", 1.0);
  return best;
}

void join_interiors(const SearchSpace& space, const std::vector<SourceTexel>& interiors, std::int64_t bias,
                    std::vector<SourceCanvas>& tiles) {
  const FrameShape& shape = space.shape;
  each_side_by_side(tiles.size(), [&](std::size_t id) {
    SourceCanvas& canvas = tiles[id];
    const std::vector<CutConstraint> settled = settled_by_search(space, canvas, interiors[id], bias);
    LaidPatch patch{{0, 0, canvas.width, canvas.height}, interiors[id], {}};
    patch.constraints.reserve(canvas.texels.size());
    for (int y = 0; y < canvas.height; ++y)
      for (int x = 0; x < canvas.width; ++x) {
        const CutConstraint own = settled[canvas.index(x, y)];
        patch.constraints.push_back(canvas.at(x, y) == no_source ? CutConstraint::take
                                    : in_guard(shape, x, y)      ? CutConstraint::keep
                                    : own != CutConstraint::free ? own
                                                                 : constraint_at(shape, x, y));
      }
    lay_patch(space.image(), canvas, patch, bias);
  });
}

} // namespace tilepack
