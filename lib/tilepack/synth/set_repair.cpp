#include "tilepack/synth/set_repair.h"

#include "tilepack/seam/scaled_cut.h"
#include "tilepack/seam/window_lookup.h"
#include "tilepack/synth/shared_window.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>

namespace tilepack {
namespace {

constexpr std::size_t most_guises = 4; // of a window, that are looked up together: more are much the same (w)
constexpr std::size_t measured_guises = 16;
constexpr int least_cells = 3; // of the search, along a window's side

// A window and where it lies.
struct Site {
  SharedWindow window;
  SourceTexel corner; // its north-west texel, from the north-west texel of a tile
};

struct Candidate {
  std::int64_t gain = 0;
  SourceTexel place; // at the scale of the search
  std::size_t site = 0;
  Rect hole;
  WindowDecisions decisions;
};

// Windows on what does not meet in any tile may be laid side by side: each changes and reads only its own texels and
// those around them.
class SetRepair {
public:
  SetRepair(const SearchSpace& search_space, const PeriodAlignment& period_alignment,
            const UseTable& use_table, const SetRepairOptions& repair_options,
            std::vector<SourceCanvas>& set_tiles)
      : space(search_space), alignment(period_alignment), uses(use_table), options(repair_options),
        tiles(set_tiles), scale(space.scale()) {
    for (int level = space.levels() - 1; level > 0; --level) {
      if (level < space.levels() - 1 && (1 << level) < widest_step) break;
      add_scale(level);
    }
    if (scales.empty()) add_scale(0);
    // Windows at two sides of a tile must not touch: they are laid side by side.
    const int most = std::max(4 * scale, std::min(space.shape.tile.width, space.shape.tile.height) * 3 / 4);
    const int reach = std::max(space.shape.reach.x, space.shape.reach.y);
    for (const int wanted : {2 * reach, reach}) {
      const int side = std::clamp(wanted, 4 * scale, most) / (2 * scale) * (2 * scale);
      if (sides.empty() || side < sides.back()) sides.push_back(side);
    }
  }

  void repair_corners() {
    tbb::parallel_for(0, space.shape.corners, [&](int color) {
      std::vector<Site> sites;
      for (const int s : sides)
        sites.push_back({window_at_corner(space.shape, color, {-s / 2, -s / 2, s, s}), {-s / 2, -s / 2}});
      improve(sites, options.corner_tries);
    });
  }

  void repair_edges(Direction direction) {
    const bool horizontal = direction == Direction::horizontal;
    const std::size_t strips = horizontal ? space.shape.horizontal.size() : space.shape.vertical.size();
    tbb::parallel_for(std::size_t{0}, strips, [&](std::size_t strip) { repair_edge(direction, strip); });
  }

private:
  bool brings_enough(const WindowCut& cut) const {
    return cut.gain > 0 &&
           static_cast<double>(cut.gain) >= options.least_gain * static_cast<double>(cut.before);
  }

  // The tiles at a scale, one texel for `scale` x `scale`.
  struct Scaled {
    const FeatureImage& image;
    int scale;
    FrameShape shape;
    std::vector<SourceCanvas> tiles;
  };

  void add_scale(int level) {
    Scaled& s = scales.emplace_back(
        Scaled{space.pyramid[static_cast<std::size_t>(level)], 1 << level, halved(space.shape, level), {}});
    s.shape.guard = std::max(1, s.shape.guard);
    for (const SourceCanvas& tile : tiles) {
      s.tiles.emplace_back(tile.width / s.scale, tile.height / s.scale);
      shrink(s, s.tiles.size() - 1, {0, 0, tile.width, tile.height});
    }
  }

  void shrink(Scaled& to, std::size_t tile, Rect area) const {
    const int step = to.scale;
    for (int y = area.y / step; y < (area.y + area.height) / step; ++y)
      for (int x = area.x / step; x < (area.x + area.width) / step; ++x) {
        const SourceTexel s = tiles[tile].at(x * step + step / 2, y * step + step / 2);
        to.tiles[tile].at(x, y) = {std::min(s.x / step, to.image.width - 1),
                                   std::min(s.y / step, to.image.height - 1)};
      }
  }

  // What all seams across and along the edge cost at each place along it, to either side as far as windows reach.
  std::vector<std::int64_t> costs_along(Direction direction, std::size_t strip) const {
    const bool horizontal = direction == Direction::horizontal;
    const int length = axes_of(space.shape, direction).length;
    const int half = sides.back() / 2;
    const SharedWindow whole =
        window_on_edge(space.shape, direction, strip,
                       horizontal ? Rect{0, -half, length, 2 * half} : Rect{-half, 0, 2 * half, length});
    std::vector<std::int64_t> along(static_cast<std::size_t>(length));
    for (std::size_t n = 0; n < std::min(guises(whole), measured_guises); ++n) {
      const SourceCanvas canvas = shown_in_window(whole, tiles, n);
      const std::vector<std::int64_t> costs = seams_at_texels(space.image(), canvas);
      for (int y = 0; y < canvas.height; ++y)
        for (int x = 0; x < canvas.width; ++x)
          along[static_cast<std::size_t>(horizontal ? x : y)] += costs[canvas.index(x, y)];
    }
    return along;
  }

  // At the worst places, one after the other; no place is worst twice.
  void repair_edge(Direction direction, std::size_t strip) {
    const bool horizontal = direction == Direction::horizontal;
    const int length = axes_of(space.shape, direction).length;
    const int run = std::max(1, sides.back() / 2);
    std::vector<std::uint8_t> done(static_cast<std::size_t>(length));
    for (int spot = 0; spot < options.edge_spots; ++spot) {
      const std::vector<std::int64_t> along = costs_along(direction, strip);
      std::int64_t most = 0;
      int worst = -1;
      for (int start = 0; start + run <= length; start += 2) {
        std::int64_t sum = 0;
        for (int i = start; i < start + run; ++i)
          if (!done[static_cast<std::size_t>(i)]) sum += along[static_cast<std::size_t>(i)];
        if (sum > most) {
          most = sum;
          worst = start;
        }
      }
      if (worst < 0) return;
      std::fill_n(done.begin() + worst + run / 4, run - run / 4 * 2, std::uint8_t{1});
      std::vector<Site> sites;
      for (const int s : sides) {
        const int first = std::clamp(worst + run / 2 - s / 2, 0, length - s) / scale * scale;
        const Rect area = horizontal ? Rect{first, -s / 2, s, s} : Rect{-s / 2, first, s, s};
        sites.push_back({window_on_edge(space.shape, direction, strip, area), {area.x, area.y}});
      }
      improve(sites, 1);
    }
  }

  void add_candidates(const std::vector<Site>& sites, std::size_t site,
                      std::vector<Candidate>& candidates) const {
    const FeatureImage& image = space.image();
    const SharedWindow& window = sites[site].window;
    const int w = window.size.width, h = window.size.height;
    if (std::min(w, h) / scale < least_cells || w > image.width || h > image.height) return;
    std::vector<SourceCanvas> shown;
    for (std::size_t n = 0; n < std::min(most_guises, guises(window)); ++n)
      shown.push_back(shown_in_window(window, tiles, n));
    const SharedWindow small_window = shrunk(window, scale);
    for (const Rect hole : {Rect{}, Rect{w / 4, h / 4, w / 2, h / 2}}) {
      Overlap overlap(w / scale, h / scale, image.channels);
      for (const SourceCanvas& canvas : shown) add_shown(image, canvas, {0, 0}, scale, hole, overlap);
      PositionMap map = space.search.mismatches(overlap);
      rule_out_of_step(map, alignment.seen_from(sites[site].corner), scale);
      for (const SourceCanvas& canvas : shown) rule_out_material_of(map, canvas, {0, 0, w, h}, scale, 4, 1);
      add_reuse_weight(map, uses, {w / scale, h / scale}, options.reuse_weight);
      SourceTexel place;
      for (int n = 0; n < options.screened && take_best(map, 1, place); ++n) {
        const Scaled& small = scales.front();
        WindowCut cut = cut_of_window(small.image, small.shape, {small_window, place, options.price * scale},
                                      small.tiles);
        if (brings_enough(cut)) candidates.push_back({cut.gain, place, site, hole, std::move(cut.decisions)});
      }
    }
  }

  // Lays the `tries` windows that bring most over the sites.
  void improve(const std::vector<Site>& sites, int tries) {
    const FeatureImage& image = space.image();
    std::vector<Candidate> candidates;
    for (std::size_t site = 0; site < sites.size(); ++site) add_candidates(sites, site, candidates);
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.gain > b.gain; });
    candidates.resize(std::min(candidates.size(), static_cast<std::size_t>(tries)));
    for (const Candidate& c : candidates) {
      const SharedWindow& window = sites[c.site].window;
      const SourceCanvas shown = shown_in_window(window, tiles, 0);
      // The place and the cut, at one scale after the other.
      SourceTexel place = c.place;
      WindowDecisions decisions = c.decisions;
      int from = scale;
      for (std::size_t i = 1; i < scales.size(); ++i) {
        const Scaled& s = scales[i];
        const int step = from / s.scale;
        place = place_near(s.image, shown, c.hole, s.scale, {place.x * step, place.y * step}, step);
        const SharedWindow small = shrunk(window, s.scale);
        decisions = cut_of_window(s.image, s.shape, {small, place, options.price * s.scale}, s.tiles,
                                  enlarged(decisions, small, step))
                        .decisions;
        from = s.scale;
      }
      place = place_near(image, shown, c.hole, 1, {place.x * from, place.y * from}, from / 2);
      const LaidWindow laid{window, place, options.price};
      const WindowCut cut = cut_of_window(image, space.shape, laid, tiles, enlarged(decisions, window, from));
      if (!brings_enough(cut) || !apply(laid, cut.decisions, tiles)) continue;
      for (const WindowPart& part : window.parts)
        for (Scaled& s : scales) shrink(s, part.tile, part.area);
    }
  }

  // Of the places at this scale within `distance`, that most like what is shown.
  SourceTexel place_near(const FeatureImage& level, const SourceCanvas& shown, Rect hole, int at_scale,
                         SourceTexel start, int distance) const {
    Overlap overlap(shown.width / at_scale, shown.height / at_scale, level.channels);
    add_shown(space.image(), shown, {0, 0}, at_scale, hole, overlap);
    return best_near(level, overlap, start, distance);
  }

  const SearchSpace& space;
  const PeriodAlignment& alignment;
  const UseTable& uses;
  const SetRepairOptions& options;
  std::vector<SourceCanvas>& tiles;
  int scale;
  std::vector<Scaled> scales; // that of the search first, then those that lead to full size
  std::vector<int> sides;     // of windows, the largest first
};

} // namespace

void repair_set(const SearchSpace& space, const PeriodAlignment& alignment, const UseTable& uses,
                const SetRepairOptions& options, std::vector<SourceCanvas>& tiles) {
  if (options.corner_tries == 0 && options.edge_spots == 0) return;
  SetRepair repair(space, alignment, uses, options, tiles);
  for (int round = 0; round < options.rounds; ++round) {
    repair.repair_corners();
    repair.repair_edges(Direction::horizontal);
    repair.repair_edges(Direction::vertical);
  }
}

} // namespace tilepack
