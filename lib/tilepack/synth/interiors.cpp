#include "tilepack/synth/interiors.h"

#include "tilepack/match/use_counts.h"
#include "tilepack/numeric/random.h"
#include "tilepack/seam/graph_cut.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

namespace tilepack {
namespace {

int distance_to_border(Size tile, int x, int y) {
  return std::min({x, y, tile.width - 1 - x, tile.height - 1 - y});
}

// What a framed tile shows, and which of its texels show something.
struct Shown {
  FeatureImage features;
  std::vector<std::uint8_t> known;
};

Shown shown_by(const FeatureImage& image, const FrameShape& shape, const SourceCanvas& canvas) {
  Shown shown{{canvas.width, canvas.height, image.channels, {}}, {}};
  shown.features.values.resize(canvas.texels.size() * static_cast<std::size_t>(image.channels));
  shown.known.resize(canvas.texels.size());
  for (int y = 0; y < canvas.height; ++y)
    for (int x = 0; x < canvas.width; ++x) {
      const std::size_t i = canvas.index(x, y);
      const SourceTexel s = canvas.texels[i];
      if (s == no_source || in_guard(shape, x, y)) continue;
      shown.known[i] = 1;
      std::copy_n(image.texel(s.x, s.y), image.channels,
                  shown.features.values.begin() + static_cast<std::ptrdiff_t>(i) * image.channels);
    }
  return shown;
}

Shown halved_shown(const Shown& fine) {
  Shown coarse{halved(fine.features), {}};
  for (int y = 0; y < coarse.features.height; ++y)
    for (int x = 0; x < coarse.features.width; ++x) {
      const auto known = [&](int i, int j) {
        return fine.known[static_cast<std::size_t>(2 * y + j) *
                              static_cast<std::size_t>(fine.features.width) +
                          static_cast<std::size_t>(2 * x + i)] != 0;
      };
      coarse.known.push_back(known(0, 0) && known(1, 0) && known(0, 1) && known(1, 1));
    }
  return coarse;
}

Overlap overlap_of(const Shown& shown) {
  const FeatureImage& f = shown.features;
  Overlap overlap(f.width, f.height, f.channels);
  std::size_t i = 0;
  for (int y = 0; y < f.height; ++y)
    for (int x = 0; x < f.width; ++x, ++i)
      if (shown.known[i]) overlap.add(x, y, f.texel(x, y));
  return overlap;
}

struct Choice {
  SourceTexel place;
  std::int64_t misfit;
};

bool fits_better(const Choice& a, const Choice& b) {
  return std::tuple(a.misfit, a.place.y, a.place.x) < std::tuple(b.misfit, b.place.y, b.place.x);
}

// The best position of each square block of positions, blocks as small as the limit allows.
std::vector<Choice> block_minima(const PositionMap& map, std::size_t limit) {
  int block = 1;
  while (static_cast<std::size_t>((map.width + block - 1) / block) *
             static_cast<std::size_t>((map.height + block - 1) / block) >
         limit)
    ++block;
  std::vector<Choice> choices;
  for (int y = 0; y < map.height; y += block)
    for (int x = 0; x < map.width; x += block) {
      Choice best{{x, y}, map.at(x, y)};
      for (int j = y; j < std::min(map.height, y + block); ++j)
        for (int i = x; i < std::min(map.width, x + block); ++i)
          if (map.at(i, j) < best.misfit) best = {{i, j}, map.at(i, j)};
      if (best.misfit != ruled_out) choices.push_back(best);
    }
  return choices;
}

// What is seen of a strip: cuts run half-way between border and reach.
Rect shown_part(const FrameShape& shape, SourceTexel strip, bool horizontal) {
  const int shown = shape.reach;
  const int across = shape.reach - shown / 2;
  return horizontal ? Rect{strip.x, strip.y + across, shape.tile.width, shown}
                    : Rect{strip.x + across, strip.y, shown, shape.tile.height};
}

void set_prices(const Saliency& deviations, const InteriorOptions& options, int scale, UseCounts& usage) {
  constexpr int side = Saliency::side;
  for (int y = 0; y < deviations.high; ++y)
    for (int x = 0; x < deviations.wide; ++x) {
      const double excess = deviations.at(x, y) - striking_deviation;
      if (excess <= 0) continue;
      const int price = 1 + static_cast<int>(std::lround(options.caution * excess));
      usage.set_reuse_weight({x * side / scale, y * side / scale, side / scale, side / scale}, price);
    }
}

// A strip counts once, though it is shown in many tiles: whatever the insides are, it is, and an inside that
// shows it too wastes no more room than one that shows another inside again.
void add_strips(const FrameShape& shape, const FrameSources& plan, int scale, UseCounts& usage) {
  const auto add = [&](Rect r) {
    usage.add({r.x / scale, r.y / scale, r.width / scale, r.height / scale}, 1.0);
  };
  for (const SourceTexel& p : plan.horizontal) add(shown_part(shape, p, true));
  for (const SourceTexel& p : plan.vertical) add(shown_part(shape, p, false));
}

SampleStatistics::Tally strips_tally(const FrameShape& shape, const FrameSources& plan,
                                     const SampleStatistics& statistics) {
  SampleStatistics::Tally tally = statistics.empty();
  const double h = static_cast<double>(shape.tiles.size()) / static_cast<double>(plan.horizontal.size());
  const double v = static_cast<double>(shape.tiles.size()) / static_cast<double>(plan.vertical.size());
  for (const SourceTexel& p : plan.horizontal) statistics.add(tally, shown_part(shape, p, true), h);
  for (const SourceTexel& p : plan.vertical) statistics.add(tally, shown_part(shape, p, false), v);
  return tally;
}

// What a choice of all insides is judged by, at the scale of the search.
struct InteriorTask {
  const SampleStatistics& statistics;
  const InteriorOptions& options;
  const std::vector<std::vector<Choice>>& choices; // of each tile, best first
  UseCounts usage;                                 // of what is placed; strips at first
  SampleStatistics::Tally tally;                   // likewise
  Size tile;
  int inset;                // an inside is shown this far from the borders of its tile
  int scale;                // texels of the sample to one of the search
  double average = 0.0;     // how often a part of the sample is shown
  double all_misfits = 0.0; // the sum of the best of each tile

  Rect inside(SourceTexel at) const {
    return {at.x + inset, at.y + inset, tile.width - 2 * inset, tile.height - 2 * inset};
  }
  Rect inside_in_sample(SourceTexel at) const {
    const Rect r = inside(at);
    return {r.x * scale, r.y * scale, r.width * scale, r.height * scale};
  }
  void place(SourceTexel at, double weight) {
    usage.add(inside(at), weight);
    statistics.add(tally, inside_in_sample(at), weight);
    usage.prepare();
  }
  // With its own tile not placed.
  double fit_and_freshness(const Choice& choice) const {
    return static_cast<double>(choice.misfit) *
           (1.0 + options.freshness * usage.mean(inside(choice.place)) / average);
  }
};

// One tile after another takes what is best beside all others, in another order in each round and start.
InteriorChoice choose_all(InteriorTask task, std::size_t start) {
  const InteriorOptions& options = task.options;
  const std::size_t tiles = task.choices.size();
  const double likeness = options.likeness * task.all_misfits;
  std::vector<const Choice*> chosen(tiles, nullptr);
  std::vector<std::size_t> order(tiles);
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (int round = 0; round < options.rounds; ++round) {
    const std::size_t stream =
        (start * static_cast<std::size_t>(options.rounds) + static_cast<std::size_t>(round)) * tiles;
    for (std::size_t i = tiles; i > 1; --i)
      std::swap(
          order[i - 1],
          order[random_below(options.seed, "interior order", stream + i, static_cast<std::uint32_t>(i))]);
    for (const std::size_t id : order) {
      if (chosen[id] != nullptr) task.place(chosen[id]->place, -1.0);
      double least = std::numeric_limits<double>::max();
      for (const Choice& choice : task.choices[id]) {
        if (static_cast<double>(choice.misfit) >= least) break; // nor do those after it cost less
        double cost = task.fit_and_freshness(choice);
        if (cost >= least) continue; // spares most of the looks at the statistics, which take longest
        cost +=
            likeness * task.statistics.distance_with(task.tally, task.inside_in_sample(choice.place), 1.0);
        if (cost < least) {
          least = cost;
          chosen[id] = &choice;
        }
      }
      task.place(chosen[id]->place, 1.0);
    }
  }
  InteriorChoice result;
  result.cost = likeness * task.statistics.distance(task.tally);
  for (const Choice* choice : chosen) {
    task.place(choice->place, -1.0);
    result.cost += task.fit_and_freshness(*choice);
    task.place(choice->place, 1.0);
    result.places.push_back(choice->place);
  }
  return result;
}

} // namespace

bool in_guard(const FrameShape& shape, int x, int y) {
  return distance_to_border(shape.tile, x, y) < shape.guard;
}

std::vector<SourceCanvas> framed_tiles(const FrameShape& shape, const Frame& frame) {
  std::vector<SourceCanvas> tiles(shape.tiles.size());
  const int w = shape.tile.width;
  const int h = shape.tile.height;
  tbb::parallel_for(std::size_t{0}, tiles.size(), [&](std::size_t id) {
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
        if (std::min(vertical, horizontal) >= shape.reach)
          texel = no_source;
        else if (vertical <= horizontal)
          texel = y <= from_south ? north.at(x, shape.reach + y) : south.at(x, shape.reach - 1 - from_south);
        else
          texel = x <= from_east ? west.at(shape.reach + x, y) : east.at(shape.reach - 1 - from_east, y);
      }
    tiles[id] = std::move(canvas);
  });
  return tiles;
}

InteriorChoice chosen_interiors(const FeaturePyramid& pyramid, const PatchSearch& search,
                                const SampleAnalysis& sample, const FrameShape& shape,
                                const FrameSources& plan, const std::vector<SourceCanvas>& framed,
                                const InteriorOptions& options, const Progress& progress) {
  const std::size_t tiles = framed.size();
  const SampleStatistics& statistics = sample.statistics;
  const FeatureImage& small = pyramid.back();
  const int levels = static_cast<int>(pyramid.size());
  const int scale = 1 << (levels - 1);
  report(progress, "interiors", 0.0);

  constexpr std::size_t most_choices = 2'500;
  constexpr std::size_t most_in_all = 1'000'000;
  const std::size_t limit = std::min(most_choices, std::max<std::size_t>(64, most_in_all / tiles));
  std::vector<std::vector<Choice>> choices(tiles);
  tbb::parallel_for(std::size_t{0}, tiles, [&](std::size_t id) {
    Shown shown = shown_by(pyramid.front(), shape, framed[id]);
    for (int level = 1; level < levels; ++level) shown = halved_shown(shown);
    PositionMap map = search.mismatches(overlap_of(shown));
    rule_out_of_step(map, plan.phase, scale);
    choices[id] = block_minima(map, limit);
    std::sort(choices[id].begin(), choices[id].end(), fits_better);
  });
  report(progress, "interiors", 0.5);

  const Size tile{shape.tile.width / scale, shape.tile.height / scale};
  const int square = std::max(1, std::min(tile.width, tile.height) / 16);
  InteriorTask task{statistics, options, choices, {small.width, small.height, square}, {}, tile, 0, scale};
  task.inset = std::min(shape.reach / 2 / scale, std::min(tile.width, tile.height) / 2 - 1);
  task.average = static_cast<double>(tiles) * tile.width * tile.height /
                 (static_cast<double>(small.width) * small.height);
  for (const auto& list : choices) task.all_misfits += static_cast<double>(list.front().misfit);
  set_prices(sample.deviations, options, scale, task.usage);
  add_strips(shape, plan, scale, task.usage);
  task.usage.prepare();
  task.tally = strips_tally(shape, plan, statistics);
  // The larger the set, the longer an order takes, and the less one differs from another.
  constexpr std::size_t most_tiles = 256; // of all starts together
  std::vector<InteriorChoice> starts(
      std::clamp<std::size_t>(most_tiles / tiles, 1, static_cast<std::size_t>(options.starts)));
  tbb::parallel_for(std::size_t{0}, starts.size(),
                    [&](std::size_t start) { starts[start] = choose_all(task, start); });
  InteriorChoice best = *std::min_element(starts.begin(), starts.end(),
                                          [](const auto& a, const auto& b) { return a.cost < b.cost; });
  std::vector<SourceTexel>& places = best.places;

  tbb::parallel_for(std::size_t{0}, tiles, [&](std::size_t id) {
    std::vector<Shown> shown{shown_by(pyramid.front(), shape, framed[id])};
    for (int level = 1; level < levels - 1; ++level) shown.push_back(halved_shown(shown.back()));
    for (int level = levels - 2; level >= 0; --level) {
      const auto l = static_cast<std::size_t>(level);
      places[id] = best_near(pyramid[l], overlap_of(shown[l]), {2 * places[id].x, 2 * places[id].y}, 2);
    }
  });
  report(progress, "interiors", 1.0);
  return best;
}

void join_interiors(const FeatureImage& image, const FrameShape& shape,
                    const std::vector<SourceTexel>& interiors, std::int64_t bias,
                    std::vector<SourceCanvas>& tiles) {
  tbb::parallel_for(std::size_t{0}, tiles.size(), [&](std::size_t id) {
    SourceCanvas& canvas = tiles[id];
    LaidPatch move{{0, 0, canvas.width, canvas.height}, interiors[id], {}};
    move.freedom.reserve(canvas.texels.size());
    for (int y = 0; y < canvas.height; ++y)
      for (int x = 0; x < canvas.width; ++x)
        move.freedom.push_back(canvas.at(x, y) == no_source ? CutConstraint::take
                               : in_guard(shape, x, y)      ? CutConstraint::keep
                                                            : CutConstraint::free);
    lay_patch(image, canvas, move, bias);
  });
}

} // namespace tilepack
