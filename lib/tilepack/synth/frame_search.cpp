#include "tilepack/synth/frame_search.h"

#include "tilepack/numeric/random.h"
#include "tilepack/numeric/side_by_side.h"
#include "tilepack/synth/border_match_costs.h"
#include "tilepack/synth/frame_refine.h"
#include "tilepack/synth/strip_axes.h"
#include "tilepack/synth/strip_candidates.h"
#include "tilepack/synth/strip_join.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <utility>

namespace tilepack {
namespace {

// The least of f(0) … f(count - 1), with eight minima side by side so that vectors can be used.
template <class F>
double least_of(std::size_t count, F f) {
  constexpr std::size_t lanes = 8;
  float least[lanes];
  std::fill_n(least, lanes, std::numeric_limits<float>::max());
  std::size_t p = 0;
  for (; p + lanes <= count; p += lanes)
    for (std::size_t k = 0; k < lanes; ++k) {
      const float v = f(p + k);
      least[k] = v < least[k] ? v : least[k];
    }
  for (; p < count; ++p) least[0] = std::min(least[0], f(p));
  return static_cast<double>(*std::min_element(least, least + lanes));
}

// A side of a tile: the strip along it (horizontal ones come first), and on which side of the strip's edge the
// tile lies.
struct TileSide {
  std::size_t strip;
  EdgeSide side;
};
using TileSides = std::array<TileSide, 4>; // north, east, south, west

// What all starts share, at the scale of the search.
struct FrameProblem {
  const SearchSpace& space;
  const FrameSearchOptions& options;
  BorderMatchCosts match_costs;
  StripRanking ranking;
  std::vector<TileSides> tiles; // by which the set is judged
  std::vector<double> uses;     // of each strip: tiles that show it, as the north or west of one

  const FrameShape& shape() const { return space.small_shape; }
  std::size_t strips() const { return shape().horizontal.size() + shape().vertical.size(); }
  Direction direction(std::size_t strip) const {
    return strip < shape().horizontal.size() ? Direction::horizontal : Direction::vertical;
  }
  const FrameShape::Strip& ends(std::size_t strip) const {
    const std::size_t h = shape().horizontal.size();
    return strip < h ? shape().horizontal[strip] : shape().vertical[strip - h];
  }
  StripAxes axes(std::size_t strip) const { return axes_of(shape(), direction(strip)); }
};

// Sets of more tiles than judged_tiles are judged by a part of them, evenly spread over the ids.
std::vector<TileSides> judged_tiles(const FrameShape& shape, std::size_t most) {
  const std::size_t step = (shape.tiles.size() + most - 1) / most;
  const std::size_t h = shape.horizontal.size();
  std::vector<TileSides> tiles;
  // An odd step meets all colors in turn.
  for (std::size_t id = 0; id < shape.tiles.size(); id += step | 1) {
    const FrameShape::Tile& t = shape.tiles[id];
    tiles.push_back({TileSide{static_cast<std::size_t>(t.north), EdgeSide::after},
                     TileSide{h + static_cast<std::size_t>(t.east), EdgeSide::before},
                     TileSide{static_cast<std::size_t>(t.south), EdgeSide::before},
                     TileSide{h + static_cast<std::size_t>(t.west), EdgeSide::after}});
  }
  return tiles;
}

FrameProblem problem_of(const SearchSpace& space, const FrameSearchOptions& options) {
  FrameProblem problem{space,
                       options,
                       BorderMatchCosts(space.small_image(), space.small_shape, options.inside_positions),
                       StripRanking(space, options),
                       judged_tiles(space.small_shape, options.judged_tiles),
                       {}};
  problem.uses.assign(problem.strips(), 0.0);
  for (const TileSides& tile : problem.tiles)
    for (const TileSide& side : tile) problem.uses[side.strip] += 0.5;
  return problem;
}

struct CornerPatches {
  std::vector<SourceTexel> places; // as in FrameSources
  PeriodAlignment alignment;       // of all of them, and of what joins them
};

// The place of a corner patch nearest to this one that is in step with the first.
SourceTexel in_step(const SearchSpace& space, const PeriodAlignment& alignment, SourceTexel at,
                    FrameShape::Reach margin) {
  const FeatureImage& image = space.small_image();
  const int scale = space.scale();
  const SourceTexel texel =
      alignment.nearest({at.x * scale, at.y * scale}, {margin.x * scale, margin.y * scale},
                        {(image.width - margin.x) * scale, (image.height - margin.y) * scale});
  return {std::clamp((texel.x + scale / 2) / scale, margin.x, std::max(margin.x, image.width - margin.x)),
          std::clamp((texel.y + scale / 2) / scale, margin.y, std::max(margin.y, image.height - margin.y))};
}

// By how much the part of a corner patch that is shown on average is more salient than it should be.
double excess_of_corner(const SearchSpace& space, SourceTexel at) {
  const int across = space.small_shape.corner_reach.x / 2, down = space.small_shape.corner_reach.y / 2;
  const int scale = space.scale();
  return excess_in(space.sample.saliency,
                   {(at.x - across) * scale, (at.y - down) * scale, 2 * across * scale, 2 * down * scale});
}

// Of a few random places for each patch that which shows least of what the eye finds again, and of these the
// farthest from those placed already: half of all lattice points show a patch, if there are two.
CornerPatches placed_corners(const SearchSpace& space, const FrameSearchOptions& options,
                             std::uint64_t start) {
  constexpr std::uint64_t most_corners = 16,
                          most_trials = 16; // numbers of random choices are packed by these
  const FrameShape& shape = space.small_shape;
  const FeatureImage& image = space.small_image();
  const int scale = space.scale();
  const FrameShape::Reach margin = shape.corner_reach;
  const auto range_x = static_cast<std::uint32_t>(std::max(1, image.width - 2 * margin.x + 1));
  const auto range_y = static_cast<std::uint32_t>(std::max(1, image.height - 2 * margin.y + 1));
  CornerPatches corners{{}, shape.alignment};
  for (int corner = 0; corner < shape.corners; ++corner) {
    SourceTexel best{};
    double least_excess = std::numeric_limits<double>::max();
    int best_distance = -1;
    for (int trial = 0; trial < options.corner_trials; ++trial) {
      const std::uint64_t index = (start * most_corners + static_cast<std::uint64_t>(corner)) * most_trials +
                                  static_cast<std::uint64_t>(trial);
      SourceTexel at{margin.x + static_cast<int>(random_below(options.seed, "corner x", index, range_x)),
                     margin.y + static_cast<int>(random_below(options.seed, "corner y", index, range_y))};
      if (corner > 0 || shape.alignment.holds_first_part())
        at = in_step(space, corners.alignment, at, margin);
      int distance = std::numeric_limits<int>::max();
      for (const SourceTexel& other : corners.places)
        distance = std::min(distance, std::abs(at.x - other.x) + std::abs(at.y - other.y));
      const double excess = options.saliency_weight > 0 ? excess_of_corner(space, at) : 0.0;
      if (excess < least_excess || (excess == least_excess && distance > best_distance)) {
        least_excess = excess;
        best_distance = distance;
        best = at;
      }
    }
    corners.places.push_back(best);
    if (corner == 0 && !shape.alignment.holds_first_part())
      corners.alignment = shape.alignment.through({best.x * scale, best.y * scale});
  }
  return corners;
}

struct StripChoices {
  std::vector<StripCandidate> candidates;
  std::vector<std::array<MatchCostMap, 2>> maps; // per candidate, by EdgeSide
  std::size_t chosen = 0;
};

// The corner patches at the two ends of a strip.
std::pair<SourceTexel, SourceTexel> patches_at(const FrameProblem& problem, const CornerPatches& corners,
                                               std::size_t strip) {
  const FrameShape::Strip& ends = problem.ends(strip);
  return {corners.places[static_cast<std::size_t>(ends.first)],
          corners.places[static_cast<std::size_t>(ends.second)]};
}

// A start: random corner patches, and the places to choose from of every strip between them. What insides would
// cost with each of these is not known yet.
struct FrameStart {
  CornerPatches corners;
  std::vector<StripChoices> strips;
};

FrameStart frame_start(const FrameProblem& problem, std::uint64_t start) {
  const FrameShape& shape = problem.shape();
  const FeatureImage& image = problem.space.small_image();
  const int scale = problem.space.scale();
  const CornerPatches corners = placed_corners(problem.space, problem.options, start);
  std::vector<StripChoices> strips(problem.strips());
  each_side_by_side(strips.size(), [&](std::size_t i) {
    const StripAxes axes = problem.axes(i);
    const auto [first, second] = patches_at(problem, corners, i);
    PositionMap map = problem.space.search.mismatches(end_overlap(image, shape, axes, first, second));
    rule_out_of_step(map, corners.alignment.seen_from(strip_place(axes, scale)), scale);
    strips[i].candidates = problem.ranking.best(map, axes, axes.corner_reach);
  });
  return {corners, std::move(strips)};
}

// What the ends of all strips cost where each takes that of its best places which can be cut to them best. By far
// cheaper than a search of the frame, and it tells how well the frame can be joined.
double end_cost(const FrameProblem& problem, const FrameStart& start) {
  const FeatureImage& image = problem.space.small_image();
  const FeaturePyramid level(image);
  const auto most = static_cast<std::size_t>(problem.options.screened_candidates);
  std::vector<std::int64_t> least(problem.strips(), std::numeric_limits<std::int64_t>::max());
  each_side_by_side(least.size(), [&](std::size_t i) {
    const auto& candidates = start.strips[i].candidates;
    const auto [first, second] = patches_at(problem, start.corners, i);
    for (std::size_t c = 0; c < std::min(most, candidates.size()); ++c)
      least[i] = std::min(least[i], seam_energy(image, joined_strip(level, problem.shape(), problem.axes(i),
                                                                    candidates[c].place, first, second)));
  });
  double total = 0.0;
  for (const std::int64_t cost : least) total += static_cast<double>(cost);
  return total;
}

// The starts from which the frame is searched, those whose ends can be joined best.
std::vector<FrameStart> screened_starts(const FrameProblem& problem) {
  const FrameSearchOptions& options = problem.options;
  std::vector<FrameStart> starts(static_cast<std::size_t>(std::max(options.screened, options.starts)));
  std::vector<double> costs(starts.size());
  each_side_by_side(starts.size(), [&](std::size_t start) {
    starts[start] = frame_start(problem, start);
    if (options.screened > options.starts) costs[start] = end_cost(problem, starts[start]);
  });
  std::vector<std::size_t> order(starts.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return costs[a] < costs[b]; });
  order.resize(static_cast<std::size_t>(options.starts));
  std::vector<FrameStart> best;
  for (const std::size_t i : order) best.push_back(std::move(starts[i]));
  return best;
}

// What insides cost with each place of each strip.
void compare_insides(const FrameProblem& problem, FrameStart& start) {
  const FrameShape& shape = problem.shape();
  const FeatureImage& image = problem.space.small_image();
  each_side_by_side(start.strips.size(), [&](std::size_t i) {
    const StripAxes axes = problem.axes(i);
    const SourceTexel first = patches_at(problem, start.corners, i).first;
    const SourceTexel second = patches_at(problem, start.corners, i).second;
    StripChoices& strip = start.strips[i];
    strip.maps.resize(strip.candidates.size());
    tbb::parallel_for(std::size_t{0}, strip.maps.size(), [&](std::size_t c) {
      strip.maps[c] = problem.match_costs.of({image, shape, axes, strip.candidates[c].place, first, second});
    });
  });
}

// For each position of an inside 0 where it would be in step, else infinity.
MatchCostMap costs_of_alignment(const PeriodAlignment& alignment, const Positions& positions, int scale) {
  MatchCostMap costs(positions.count());
  const int step = scale * positions.stride;
  for (std::size_t p = 0; p < costs.size(); ++p) {
    const SourceTexel at{static_cast<int>(p % static_cast<std::size_t>(positions.columns)) * step,
                         static_cast<int>(p / static_cast<std::size_t>(positions.columns)) * step};
    costs[p] = alignment.allows(at, step) ? 0.0f : std::numeric_limits<float>::infinity();
  }
  return costs;
}

// One start whose insides are compared, and the choice of one place for each strip.
class FrameChoice {
public:
  FrameChoice(const FrameProblem& frame_problem, FrameStart start, MatchCostMap costs_by_alignment)
      : problem(frame_problem), corners(std::move(start.corners)), strips(std::move(start.strips)),
        alignment_costs(std::move(costs_by_alignment)) {}

  // Returns what the frame costs in the end.
  double improve() {
    const SampleStatistics& statistics = problem.space.sample.statistics;
    tally = statistics.empty();
    for (std::size_t i = 0; i < strips.size(); ++i)
      statistics.add(tally, shown(i, strips[i].chosen), problem.uses[i]);
    mismatch_at_start = cost();
    double total = mismatch_at_start;
    for (int round = 0; round < problem.options.rounds; ++round) {
      bool changed = false;
      for (std::size_t i = 0; i < strips.size(); ++i) changed = choose(i) || changed;
      total = cost() + problem.options.statistics_weight * mismatch_at_start * statistics.distance(tally);
      if (!changed) break;
    }
    return total;
  }

  FrameSources sources() const {
    FrameSources result;
    result.alignment = corners.alignment;
    result.corners = corners.places;
    for (std::size_t i = 0; i < strips.size(); ++i)
      (problem.direction(i) == Direction::horizontal ? result.horizontal : result.vertical)
          .push_back(strips[i].candidates[strips[i].chosen].place);
    return result;
  }

private:
  const MatchCostMap& map_of(const TileSide& side) const {
    const StripChoices& strip = strips[side.strip];
    return strip.maps[strip.chosen][static_cast<std::size_t>(side.side)];
  }

  // What the tile's best inside would cost with each of the strip's candidates; none where the tile lacks it.
  std::vector<double> least_mismatches(std::size_t own, const TileSides& tile) const {
    const StripChoices& strip = strips[own];
    std::vector<std::size_t> parts;
    MatchCostMap rest = alignment_costs;
    for (const TileSide& side : tile) {
      if (side.strip == own) {
        parts.push_back(static_cast<std::size_t>(side.side));
        continue;
      }
      const MatchCostMap& map = map_of(side);
      for (std::size_t p = 0; p < rest.size(); ++p) rest[p] += map[p];
    }
    std::vector<double> costs;
    if (parts.empty()) return costs;
    for (const auto& maps : strip.maps) {
      const MatchCostMap& a = maps[parts.front()];
      const MatchCostMap& b = maps[parts.back()];
      costs.push_back(parts.size() == 1
                          ? least_of(rest.size(), [&](std::size_t p) { return rest[p] + a[p]; })
                          : least_of(rest.size(), [&](std::size_t p) { return rest[p] + a[p] + b[p]; }));
    }
    return costs;
  }

  // Puts the strip where it is best beside all others. Returns whether it moved.
  bool choose(std::size_t own) {
    const SampleStatistics& statistics = problem.space.sample.statistics;
    const double uses = problem.uses[own];
    StripChoices& strip = strips[own];
    std::vector<double> costs;
    for (const StripCandidate& c : strip.candidates) costs.push_back(uses * c.mismatch);
    std::vector<std::vector<double>> of_tile(problem.tiles.size());
    tbb::parallel_for(std::size_t{0}, of_tile.size(),
                      [&](std::size_t i) { of_tile[i] = least_mismatches(own, problem.tiles[i]); });
    for (const auto& least : of_tile)
      for (std::size_t c = 0; c < least.size(); ++c) costs[c] += least[c];
    const std::size_t before = strip.chosen;
    statistics.add(tally, shown(own, before), -uses);
    for (std::size_t c = 0; c < costs.size(); ++c)
      costs[c] += problem.options.statistics_weight * mismatch_at_start *
                  statistics.distance_with(tally, shown(own, c), uses);
    for (std::size_t c = 0; c < costs.size(); ++c)
      if (costs[c] < costs[strip.chosen]) strip.chosen = c;
    statistics.add(tally, shown(own, strip.chosen), uses);
    return strip.chosen != before;
  }

  Rect shown(std::size_t strip, std::size_t candidate) const {
    return shown_area(problem.axes(strip), strips[strip].candidates[candidate].place, problem.space.scale());
  }

  double cost() const {
    double total = 0.0;
    for (std::size_t i = 0; i < strips.size(); ++i)
      total += problem.uses[i] * strips[i].candidates[strips[i].chosen].mismatch;
    const MatchCostMap& own = alignment_costs;
    for (const TileSides& tile : problem.tiles) {
      const MatchCostMap &n = map_of(tile[0]), &e = map_of(tile[1]), &s = map_of(tile[2]),
                         &w = map_of(tile[3]);
      total += least_of(own.size(), [&](std::size_t p) { return own[p] + n[p] + e[p] + s[p] + w[p]; });
    }
    return total;
  }

  const FrameProblem& problem;
  CornerPatches corners;
  std::vector<StripChoices> strips;
  MatchCostMap alignment_costs;
  SampleStatistics::Tally tally; // of all strips as chosen
  double mismatch_at_start = 0.0;
};

struct FoundFrame {
  double cost = 0.0;
  FrameSources sources; // at the scale of the search
};

FoundFrame found_from(const FrameProblem& problem, FrameStart start) {
  compare_insides(problem, start);
  MatchCostMap costs =
      costs_of_alignment(start.corners.alignment, problem.match_costs.positions(), problem.space.scale());
  FrameChoice choice(problem, std::move(start), std::move(costs));
  const double cost = choice.improve();
  return {cost, choice.sources()};
}

} // namespace

FrameSources searched_frame(const SearchSpace& space, const FrameSearchOptions& options,
                            const FrameRefineOptions& refine, const Progress& progress) {
  report(progress, "frame search", 0.0);
  const FrameProblem problem = problem_of(space, options);
  std::vector<FrameStart> starts = screened_starts(problem);
  std::vector<FoundFrame> found(starts.size());
  each_side_by_side(found.size(),
                    [&](std::size_t i) { found[i] = found_from(problem, std::move(starts[i])); });
  FrameSources best =
      std::min_element(found.begin(), found.end(), [](const FoundFrame& a, const FoundFrame& b) {
        return a.cost < b.cost;
      })->sources;
  for (int level = space.levels() - 2; level >= 0; --level)
    refine_frame(space.pyramid[static_cast<std::size_t>(level)], halved(space.shape, level), 1 << level,
                 refine, best);
  report(progress, "frame search", 1.0);
  return best;
}

} // namespace tilepack
