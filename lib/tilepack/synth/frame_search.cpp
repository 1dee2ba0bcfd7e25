#include "tilepack/synth/frame_search.h"

#include "tilepack/numeric/random.h"
#include "tilepack/synth/border_match_costs.h"
#include "tilepack/synth/border_step.h"
#include "tilepack/synth/frame_refine.h"
#include "tilepack/synth/strip_axes.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace tilepack {
namespace {

struct Candidate {
  SourceTexel place;
  double misfit = 0.0; // of its ends, per texel of overlap depth
};

// The part of a strip's window that tiles show on average, in texels of a sample `scale` times as large.
Rect shown_area(const StripAxes& space, SourceTexel place, int scale) {
  const int shown = std::max(1, space.reach);
  const SourceTexel at = sum(place, space.at(0, space.reach - shown / 2));
  const SourceTexel extent = space.at(space.length, shown);
  return {at.x * scale, at.y * scale, extent.x * scale, extent.y * scale};
}

// The best places by misfit and evenness, no two within a few texels.
class CandidateList {
public:
  CandidateList(const FeatureImage& feature_image, const Saliency& saliency_of, int sample_scale,
                const FrameSearchOptions& search_options)
      : image(feature_image), deviations(saliency_of), scale(sample_scale), options(search_options),
        mean(channel_means({0, 0}, image.width, image.height)), usual_step{
                                                                    mean_step(image, Direction::horizontal),
                                                                    mean_step(image, Direction::vertical)} {}

  std::vector<Candidate> best(const PositionMap& map, const StripAxes& space, int depth) const {
    std::vector<std::size_t> order(map.values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const std::size_t looked_at = std::min(order.size(), static_cast<std::size_t>(60 * options.candidates));
    std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(looked_at), order.end(),
                      [&](std::size_t a, std::size_t b) {
                        return map.values[a] != map.values[b] ? map.values[a] < map.values[b] : a < b;
                      });
    std::vector<Candidate> apart;
    for (std::size_t i = 0; i < looked_at && apart.size() < 4 * static_cast<std::size_t>(options.candidates);
         ++i) {
      const SourceTexel at{static_cast<int>(order[i] % static_cast<std::size_t>(map.width)),
                           static_cast<int>(order[i] / static_cast<std::size_t>(map.width))};
      if (map.values[order[i]] == ruled_out) break;
      if (std::any_of(apart.begin(), apart.end(), [&](const Candidate& c) {
            return std::abs(c.place.x - at.x) < 3 && std::abs(c.place.y - at.y) < 3;
          }))
        continue;
      apart.push_back({at, static_cast<double>(map.values[order[i]]) / depth + unevenness(at, space)});
    }
    // Corner patches, the same for all candidates, are left out of it.
    const double usual = std::max(usual_step[space.direction == Direction::horizontal ? 0 : 1], 1e-3);
    for (Candidate& c : apart) {
      const double excess = step_across(image, space, c.place) / usual - 1.0;
      c.misfit *= 1.0 + options.calmness * excess * excess;
      c.misfit *= 1.0 + options.caution * excess_in(deviations, shown_area(space, c.place, scale));
    }
    std::stable_sort(apart.begin(), apart.end(),
                     [](const Candidate& a, const Candidate& b) { return a.misfit < b.misfit; });
    if (apart.size() > static_cast<std::size_t>(options.candidates))
      apart.resize(static_cast<std::size_t>(options.candidates));
    return apart;
  }

private:
  std::vector<double> channel_means(SourceTexel at, int width, int height) const {
    std::vector<std::int64_t> sums(static_cast<std::size_t>(image.channels));
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        for (int c = 0; c < image.channels; ++c)
          sums[static_cast<std::size_t>(c)] += image.texel(at.x + x, at.y + y)[c];
    std::vector<double> means;
    for (const std::int64_t s : sums)
      means.push_back(static_cast<double>(s) / (static_cast<double>(width) * height));
    return means;
  }

  double unevenness(SourceTexel at, const StripAxes& space) const {
    const auto own = channel_means(at, space.width(), space.height());
    double squared = 0.0;
    for (std::size_t c = 0; c < own.size(); ++c) squared += (own[c] - mean[c]) * (own[c] - mean[c]);
    return options.evenness * squared * space.length;
  }

  const FeatureImage& image;
  const Saliency& deviations; // of the sample, which is `scale` times as large as the image
  int scale;
  const FrameSearchOptions& options;
  std::vector<double> mean;
  std::array<double, 2> usual_step; // across horizontal edges, across vertical ones
};

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

struct StripChoices {
  std::vector<Candidate> candidates;
  std::vector<std::array<MisfitMap, 2>> maps; // per candidate: side before, side after
  std::size_t chosen = 0;
};

// One start: its corner patches, and for every strip (horizontal ones first) the places to choose from.
class FrameChoice {
public:
  FrameChoice(const FeatureImage& feature_image, const BorderMatchCosts& misfits,
              const SampleAnalysis& studied_sample, int sample_scale, const FrameShape& frame_shape,
              const PatchSearch& search, const FrameSearchOptions& search_options, std::uint64_t start)
      : image(feature_image), sample(studied_sample), statistics(sample.statistics), scale(sample_scale),
        shape(frame_shape), options(search_options), positions(misfits.positions()) {
    place_corners(start);
    const CandidateList list(image, sample.deviations, scale, options);
    strips.resize(shape.horizontal.size() + shape.vertical.size());
    tbb::parallel_for(std::size_t{0}, strips.size(), [&](std::size_t i) {
      const StripAxes space = space_of(shape, direction(i));
      const SourceTexel first = corners[static_cast<std::size_t>(ends(i).first)];
      const SourceTexel second = corners[static_cast<std::size_t>(ends(i).second)];
      PositionMap map = search.mismatches(end_overlap(image, shape, space, first, second));
      rule_out_of_step(map, phase.seen_from(strip_place(space, scale)), scale);
      StripChoices& strip = strips[i];
      strip.candidates = list.best(map, space, shape.corner_reach);
      strip.maps.resize(strip.candidates.size());
      tbb::parallel_for(std::size_t{0}, strip.maps.size(), [&](std::size_t c) {
        strip.maps[c] = misfits.of({image, shape, space, strip.candidates[c].place, first, second});
      });
    });
    list_tiles();
    fits.resize(positions.count());
    for (std::size_t p = 0; p < fits.size(); ++p) {
      const int step = scale * positions.stride;
      const SourceTexel at{static_cast<int>(p % static_cast<std::size_t>(positions.columns)) * step,
                           static_cast<int>(p / static_cast<std::size_t>(positions.columns)) * step};
      fits[p] = phase.allows(at, step) ? 0.0f : std::numeric_limits<float>::infinity();
    }
  }

  double improve() {
    tally = statistics.empty();
    for (std::size_t i = 0; i < strips.size(); ++i)
      statistics.add(tally, shown_area(i, strips[i].chosen), uses[i]);
    misfit_at_start = cost();
    double total = misfit_at_start;
    for (int round = 0; round < options.rounds; ++round) {
      bool changed = false;
      for (std::size_t i = 0; i < strips.size(); ++i) changed = choose(i) || changed;
      total = cost() + options.likeness * misfit_at_start * statistics.distance(tally);
      if (!changed) break;
    }
    return total;
  }

  FrameSources plan() const {
    FrameSources result;
    result.phase = phase;
    result.corners = corners;
    for (std::size_t i = 0; i < strips.size(); ++i)
      (direction(i) == Direction::horizontal ? result.horizontal : result.vertical)
          .push_back(strips[i].candidates[strips[i].chosen].place);
    return result;
  }

private:
  static constexpr int sides = 4;
  struct Side {
    std::size_t strip;
    std::size_t part; // 0: the tile lies before the strip, 1: after
  };

  Direction direction(std::size_t strip) const {
    return strip < shape.horizontal.size() ? Direction::horizontal : Direction::vertical;
  }
  const FrameShape::Strip& ends(std::size_t strip) const {
    return strip < shape.horizontal.size() ? shape.horizontal[strip]
                                           : shape.vertical[strip - shape.horizontal.size()];
  }

  void place_corners(std::uint64_t start) {
    const int margin = std::max(shape.reach, shape.corner_reach);
    const auto range_x = static_cast<std::uint32_t>(std::max(1, image.width - 2 * margin + 1));
    const auto range_y = static_cast<std::uint32_t>(std::max(1, image.height - 2 * margin + 1));
    for (int corner = 0; corner < shape.corners; ++corner) {
      // Of a few that which shows least of what the eye finds again, and of these the farthest from those
      // placed already: half of all lattice points show a patch, if there are two.
      SourceTexel best{};
      double least_excess = std::numeric_limits<double>::max();
      int best_distance = -1;
      for (std::uint64_t attempt = 0; attempt < 4; ++attempt) {
        const std::uint64_t index = (start * 16 + static_cast<std::uint64_t>(corner)) * 16 + attempt;
        SourceTexel at{margin + static_cast<int>(random_below(options.seed, "corner x", index, range_x)),
                       margin + static_cast<int>(random_below(options.seed, "corner y", index, range_y))};
        if (!corners.empty()) at = in_step(at, margin);
        int distance = std::numeric_limits<int>::max();
        for (const SourceTexel& other : corners)
          distance = std::min(distance, std::abs(at.x - other.x) + std::abs(at.y - other.y));
        const int half = shape.corner_reach / 2;
        const double excess =
            options.caution > 0 ? excess_in(sample.deviations, {(at.x - half) * scale, (at.y - half) * scale,
                                                                2 * half * scale, 2 * half * scale})
                                : 0.0;
        if (excess < least_excess || (excess == least_excess && distance > best_distance)) {
          least_excess = excess;
          best_distance = distance;
          best = at;
        }
      }
      corners.push_back(best);
      if (corner == 0) phase = shape.phase.through({best.x * scale, best.y * scale});
    }
  }

  // The place of a corner patch nearest to this one that is in step with the first.
  SourceTexel in_step(SourceTexel at, int margin) const {
    const SourceTexel texel =
        phase.nearest({at.x * scale, at.y * scale}, {margin * scale, margin * scale},
                      {(image.width - margin) * scale, (image.height - margin) * scale});
    return {std::clamp((texel.x + scale / 2) / scale, margin, std::max(margin, image.width - margin)),
            std::clamp((texel.y + scale / 2) / scale, margin, std::max(margin, image.height - margin))};
  }

  // Sets of more tiles than this are judged by a part of them, evenly spread over the ids.
  static constexpr std::size_t most_tiles = 128;

  void list_tiles() {
    const std::size_t step = (shape.tiles.size() + most_tiles - 1) / most_tiles;
    const std::size_t h = shape.horizontal.size();
    // An odd step meets all colors in turn.
    for (std::size_t id = 0; id < shape.tiles.size(); id += step | 1) {
      const FrameShape::Tile& t = shape.tiles[id];
      tiles.push_back(
          {Side{static_cast<std::size_t>(t.north), 1}, Side{h + static_cast<std::size_t>(t.east), 0},
           Side{static_cast<std::size_t>(t.south), 0}, Side{h + static_cast<std::size_t>(t.west), 1}});
    }
    uses.assign(strips.size(), 0.0);
    for (const auto& tile : tiles)
      for (const Side& side : tile) uses[side.strip] += 0.5;
  }

  const MisfitMap& map_of(const Side& side) const {
    const StripChoices& strip = strips[side.strip];
    return strip.maps[strip.chosen][side.part];
  }

  // What the tile's best inside would cost with each of the strip's candidates.
  std::vector<double> least_misfits(std::size_t own, const std::array<Side, sides>& tile) const {
    const StripChoices& strip = strips[own];
    std::vector<std::size_t> parts;
    MisfitMap rest = fits;
    for (const Side& side : tile) {
      if (side.strip == own) {
        parts.push_back(side.part);
        continue;
      }
      const MisfitMap& map = map_of(side);
      for (std::size_t p = 0; p < rest.size(); ++p) rest[p] += map[p];
    }
    std::vector<double> costs;
    if (parts.empty()) return costs;
    for (const auto& maps : strip.maps) {
      const MisfitMap& a = maps[parts.front()];
      const MisfitMap& b = maps[parts.back()];
      costs.push_back(parts.size() == 1
                          ? least_of(rest.size(), [&](std::size_t p) { return rest[p] + a[p]; })
                          : least_of(rest.size(), [&](std::size_t p) { return rest[p] + a[p] + b[p]; }));
    }
    return costs;
  }

  bool choose(std::size_t own) {
    StripChoices& strip = strips[own];
    std::vector<double> costs;
    for (const Candidate& c : strip.candidates) costs.push_back(uses[own] * c.misfit);
    std::vector<std::vector<double>> of_tile(tiles.size()); // by candidate; none where the strip is not met
    tbb::parallel_for(std::size_t{0}, tiles.size(),
                      [&](std::size_t i) { of_tile[i] = least_misfits(own, tiles[i]); });
    for (const auto& least : of_tile)
      for (std::size_t c = 0; c < least.size(); ++c) costs[c] += least[c];
    const std::size_t before = strip.chosen;
    statistics.add(tally, shown_area(own, before), -uses[own]);
    for (std::size_t c = 0; c < costs.size(); ++c)
      costs[c] +=
          options.likeness * misfit_at_start * statistics.distance_with(tally, shown_area(own, c), uses[own]);
    for (std::size_t c = 0; c < costs.size(); ++c)
      if (costs[c] < costs[strip.chosen]) strip.chosen = c;
    statistics.add(tally, shown_area(own, strip.chosen), uses[own]);
    return strip.chosen != before;
  }

  Rect shown_area(std::size_t strip, std::size_t candidate) const {
    return tilepack::shown_area(space_of(shape, direction(strip)), strips[strip].candidates[candidate].place,
                                scale);
  }

  double cost() const {
    double total = 0.0;
    for (std::size_t i = 0; i < strips.size(); ++i)
      total += uses[i] * strips[i].candidates[strips[i].chosen].misfit;
    for (const auto& tile : tiles) {
      const MisfitMap &n = map_of(tile[0]), &e = map_of(tile[1]), &s = map_of(tile[2]), &w = map_of(tile[3]);
      total += least_of(fits.size(), [&](std::size_t p) { return fits[p] + n[p] + e[p] + s[p] + w[p]; });
    }
    return total;
  }

  const FeatureImage& image;
  const SampleAnalysis& sample;
  const SampleStatistics& statistics;
  int scale; // texels of the sample to one of the image
  const FrameShape& shape;
  const FrameSearchOptions& options;
  Positions positions;
  PeriodAlignment phase;
  MisfitMap fits; // 0 where an inside would be in step, else infinity
  std::vector<SourceTexel> corners;
  std::vector<StripChoices> strips;
  std::vector<std::array<Side, sides>> tiles;
  SampleStatistics::Tally tally; // of all strips as chosen
  double misfit_at_start = 0.0;
  std::vector<double> uses; // tiles per strip, as the north or west of one
};

} // namespace

FrameSources searched_frame(const FeaturePyramid& pyramid, const PatchSearch& search,
                            const SampleAnalysis& sample, const FrameShape& shape,
                            const FrameSearchOptions& options, const Progress& progress) {
  const int levels = static_cast<int>(pyramid.size());
  const FrameShape small = halved(shape, levels - 1);
  report(progress, "frame search", 0.0);
  const BorderMatchCosts misfits(pyramid.back(), small);
  std::vector<FrameSources> plans(static_cast<std::size_t>(options.starts));
  std::vector<double> costs(plans.size());
  tbb::parallel_for(std::size_t{0}, plans.size(), [&](std::size_t start) {
    FrameChoice choice(pyramid.back(), misfits, sample, 1 << (levels - 1), small, search, options, start);
    costs[start] = choice.improve();
    plans[start] = choice.plan();
  });
  FrameSources best =
      plans[static_cast<std::size_t>(std::min_element(costs.begin(), costs.end()) - costs.begin())];
  for (int level = levels - 2; level >= 0; --level)
    refine_frame(pyramid[static_cast<std::size_t>(level)], halved(shape, level), 1 << level, best);
  report(progress, "frame search", 1.0);
  return best;
}

} // namespace tilepack
