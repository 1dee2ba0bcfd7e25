#include "tilepack/pattern/placed_patterns.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tilepack {
namespace {

constexpr float below_one = 1.0f - 0x1p-24f;

// A fraction of a tile as the sampler takes it: rounded to 1 it would be the next tile's.
float fraction_in_tile(double fraction) {
  return std::clamp(static_cast<float>(fraction), 0.0f, below_one);
}

void add_sample(SourceSamples& samples, std::int32_t pattern, double x, double y, double level) {
  samples.tile_x[samples.count] = pattern;
  samples.tile_y[samples.count] = 0;
  samples.x[samples.count] = fraction_in_tile(x);
  samples.y[samples.count] = fraction_in_tile(y);
  samples.level[samples.count] = static_cast<float>(level);
  ++samples.count;
}

// The texels on both sides of a border that a bilinear filter reads along an axis: in the tile itself at `at`, and with
// `weight` in the neighbour `step` cells on, at `beyond`.
struct BorderTaps {
  int step = 0;
  double at = 0, beyond = 0, weight = 0;
};
BorderTaps taps_at_border(double fraction, int side) {
  const double texel = fraction * side - 0.5, half = 0.5 / side;
  if (texel < 0) return {-1, half, 1 - half, -texel};
  if (texel > side - 1) return {1, 1 - half, half, texel - (side - 1)};
  return {0, fraction, 0, 0};
}

// The places of pixels first..end-1, which lie in one cell, in its pattern.
void add_stretch(SourceSamples& samples, std::int32_t pattern, const GridWalk& walk,
                 const GridWalk::Spot& spot, std::size_t first, std::size_t end, double level) {
  const std::size_t count = end - first, at = samples.count;
  std::fill_n(samples.tile_x + at, count, pattern);
  std::fill_n(samples.tile_y + at, count, 0);
  std::fill_n(samples.level + at, count, static_cast<float>(level));
  walk.places(first, count, static_cast<double>(spot.x), static_cast<double>(spot.y), samples.x + at,
              samples.y + at);
  for (std::size_t k = 0; k < count; ++k)
    samples.x[at + k] = std::min(std::max(samples.x[at + k], 0.0f), below_one);
  for (std::size_t k = 0; k < count; ++k)
    samples.y[at + k] = std::min(std::max(samples.y[at + k], 0.0f), below_one);
  samples.count += count;
}

void clear_pixel(const RunValues& out, int channels, std::size_t i) {
  for (std::size_t c = 0; c < static_cast<std::size_t>(channels); ++c) out.value[c][i] = 0;
  out.cover[i] = 0;
}

} // namespace

void PatternDrawing::fill(std::int32_t pattern, const GridWalk& walk, std::size_t i, std::size_t end,
                          const RunValues& out) const {
  const RunValues to = out.from(i);
  if (pattern < 0) {
    for (int c = 0; c < lookup.channels; ++c)
      std::fill_n(to.value[static_cast<std::size_t>(c)], end - i, 0.0f);
    std::fill_n(to.cover, end - i, 0.0f);
    return;
  }
  SourceSamples samples;
  const GridWalk::Spot spot = walk.spot(i);
  for (std::size_t k = i; k < end; ++k)
    add_sample(samples, pattern, walk.x(k) - static_cast<double>(spot.x),
               walk.y(k) - static_cast<double>(spot.y), level);
  lookup.sample(samples, level, to);
}

void PatternDrawing::tile(const GridWalk& walk, std::size_t count,
                          const std::function<std::int32_t(PatternCell)>& pattern_of, bool seamless,
                          const RunValues& out) const {
  SourceSamples samples;
  bool blank[longest_run];
  bool any_blank = false, all_blank = true;
  for (std::size_t i = 0; i < count;) {
    const GridWalk::Spot spot = walk.spot(i);
    const std::size_t end = walk.stretch_end(i);
    const std::int32_t pattern = pattern_of(walk.cell(spot));
    any_blank = any_blank || pattern < 0;
    all_blank = all_blank && pattern < 0;
    std::fill(blank + i, blank + end, pattern < 0);
    add_stretch(samples, std::max(pattern, 0), walk, spot, i, end, level);
    i = end;
  }
  const bool mended = seamless && lookup.filter != Filter::nearest;
  if (all_blank) fill(-1, walk, 0, count, out);
  if (all_blank && !mended) return;
  if (!all_blank) lookup.sample(samples, level, out);
  for (std::size_t i = 0; any_blank && i < count; ++i)
    if (blank[i]) clear_pixel(out, lookup.channels, i);
  if (mended) mend_seams(walk, count, pattern_of, out);
}

void PatternDrawing::mend_seams(const GridWalk& walk, std::size_t count,
                                const std::function<std::int32_t(PatternCell)>& pattern_of,
                                const RunValues& out) const {
  const PackFacts& facts = lookup.source.facts();
  const LevelBlend levels = level_blend(level, facts.levels, lookup.filter);
  SourceLookup bilinear = lookup;
  bilinear.filter = Filter::bilinear;
  SourceSamples samples;
  std::array<std::size_t, longest_run> pixel{};
  std::array<double, longest_run> weight{};
  RunBuffer found;
  // The samples of a pixel stand together.
  const auto flush = [&] {
    if (samples.count == 0) return;
    bilinear.sample(samples, levels.fine, found.view());
    for (std::size_t k = 0; k < samples.count;) {
      const std::size_t to = pixel[k];
      double cover = 0;
      std::array<double, 4> value{};
      for (; k < samples.count && pixel[k] == to; ++k) {
        const double share = weight[k] * static_cast<double>(found.cover[k]);
        cover += share;
        for (std::size_t c = 0; c < static_cast<std::size_t>(lookup.channels); ++c)
          value[c] += share * static_cast<double>(found.value[c][k]);
      }
      out.cover[to] = static_cast<float>(cover);
      for (std::size_t c = 0; c < static_cast<std::size_t>(lookup.channels); ++c)
        out.value[c][to] = cover > 0 ? static_cast<float>(value[c] / cover) : 0.0f;
    }
    samples.count = 0;
  };
  // The neighbourhood of the cell at hand, each pattern asked for at most once.
  constexpr std::int32_t unknown = -2;
  GridWalk::Spot held{};
  std::array<std::int32_t, 9> around{};
  around.fill(unknown);
  const auto pattern_at = [&](const GridWalk::Spot& spot, int dx, int dy) {
    if (spot.x != held.x || spot.y != held.y) {
      held = spot;
      around.fill(unknown);
    }
    std::int32_t& pattern = around[static_cast<std::size_t>((dy + 1) * 3 + dx + 1)];
    if (pattern == unknown) pattern = pattern_of(walk.cell(spot, dx, dy));
    return pattern;
  };
  const int read = levels.coarse_weight > 0 ? 2 : 1;
  const auto mend = [&](std::size_t i, const GridWalk::Spot& spot) {
    std::array<BorderTaps, 2> across{}, down{};
    bool crosses = false;
    for (int l = 0; l < read; ++l) {
      const auto at = static_cast<std::size_t>(l);
      across[at] = taps_at_border(spot.in_x, facts.tile_size.width >> (levels.fine + l));
      down[at] = taps_at_border(spot.in_y, facts.tile_size.height >> (levels.fine + l));
      crosses = crosses || across[at].step != 0 || down[at].step != 0;
    }
    if (!crosses) return;
    if (samples.count + 8 > longest_run) flush();
    const std::size_t before = samples.count;
    for (int l = 0; l < read; ++l) {
      const BorderTaps &x = across[static_cast<std::size_t>(l)], &y = down[static_cast<std::size_t>(l)];
      const double share = read == 1 ? 1 : l == 0 ? 1 - levels.coarse_weight : levels.coarse_weight;
      for (int tap = 0; tap < 4; ++tap) {
        const bool beyond_x = (tap & 1) != 0, beyond_y = (tap & 2) != 0;
        const double w = share * (beyond_x ? x.weight : 1 - x.weight) * (beyond_y ? y.weight : 1 - y.weight);
        if (!(w > 0)) continue;
        const std::int32_t pattern = pattern_at(spot, beyond_x ? x.step : 0, beyond_y ? y.step : 0);
        if (pattern < 0) continue; // clear
        pixel[samples.count] = i;
        weight[samples.count] = w;
        add_sample(samples, pattern, beyond_x ? x.beyond : x.at, beyond_y ? y.beyond : y.at, levels.fine + l);
      }
    }
    if (samples.count == before) clear_pixel(out, lookup.channels, i);
  };
  // Pixels between the outermost texels' centres of the coarsest level read are as they should be; of a row that stays in
  // the middle of its cells, those are all but a few at both ends of each stretch.
  const auto outermost = [&](int side) { return 0.5 / (side >> (levels.fine + read - 1)); };
  const double half_x = outermost(facts.tile_size.width), half_y = outermost(facts.tile_size.height);
  for (std::size_t i = 0; i < count;) {
    GridWalk::Spot spot = walk.spot(i);
    const std::size_t end = walk.stretch_end(i);
    const auto whole_x = static_cast<double>(spot.x), whole_y = static_cast<double>(spot.y);
    const auto visit = [&](std::size_t k) {
      spot.in_x = walk.x(k) - whole_x;
      spot.in_y = walk.y(k) - whole_y;
      const bool inner =
          spot.in_x >= half_x && spot.in_x <= 1 - half_x && spot.in_y >= half_y && spot.in_y <= 1 - half_y;
      if (!inner) mend(k, spot);
      return inner;
    };
    // What lies in the middle of a convex cell is one piece of the stretch.
    std::size_t first = i, last = end;
    while (first < end && !visit(first)) ++first;
    while (last > first && !visit(last - 1)) --last;
    i = end;
  }
  flush();
}

// What a pattern of some scale is read at: the level, how many texels it has there (between two levels a mean of both),
// and how far a filter reaches beyond it, in these texels.
struct PatternDrawing::Sharpness {
  double level = 0, wide = 1, high = 1, margin = 0;
};
PatternDrawing::Sharpness PatternDrawing::sharpness(double scale) const {
  const PackFacts& facts = lookup.source.facts();
  const double own_level = level - std::log2(scale);
  const LevelBlend levels = level_blend(own_level, facts.levels, lookup.filter);
  const auto texels = [&](int side) {
    const double fine = side >> levels.fine, coarse = side >> levels.coarse;
    return fine + levels.coarse_weight * (coarse - fine);
  };
  return {own_level, texels(facts.tile_size.width), texels(facts.tile_size.height),
          lookup.filter == Filter::nearest ? 0 : 0.5};
}

namespace {

// How far from its centre a pattern of these texels shows, turned anyhow, in cells.
double reach_of(double scale, double margin, double texels) {
  return scale * std::sqrt(0.5) * (1 + 2 * margin / texels);
}

} // namespace

PixelBox pixel_box(const GridWalk& walk, std::size_t first, std::size_t end) {
  const double x0 = walk.x(first), x1 = walk.x(end - 1), y0 = walk.y(first), y1 = walk.y(end - 1);
  return {std::min(x0, x1), std::max(x0, x1), std::min(y0, y1), std::max(y0, y1)};
}

std::int64_t PatternDrawing::cells_reached(double scale) const {
  const Sharpness sharp = sharpness(scale);
  return reach_of(scale, sharp.margin, std::min(sharp.wide, sharp.high)) <= 1 ? 1 : 2;
}

bool PatternDrawing::may_reach(double scale, CellOffset cell, const PixelBox& pixels) const {
  const Sharpness sharp = sharpness(scale);
  const double reach = reach_of(scale, sharp.margin, std::min(sharp.wide, sharp.high));
  const auto x = static_cast<double>(cell.x), y = static_cast<double>(cell.y);
  return pixels.east >= x - reach && pixels.west <= x + 1 + reach && pixels.south >= y - reach &&
         pixels.north <= y + 1 + reach;
}

bool PatternDrawing::may_show(const TileTransform& t, CellOffset cell, const PixelBox& pixels) const {
  const Sharpness sharp = sharpness(t.scale);
  const double reach = t.half_box() * (1 + 2 * sharp.margin / std::min(sharp.wide, sharp.high));
  const double x = static_cast<double>(cell.x) + t.x, y = static_cast<double>(cell.y) + t.y;
  return pixels.east >= x - reach && pixels.west <= x + reach && pixels.south >= y - reach &&
         pixels.north <= y + reach;
}

void PatternDrawing::draw(const PatternInstance& instance, const GridWalk& walk, CellOffset cell,
                          std::size_t i, std::size_t end, bool clipped, const RunValues& out) const {
  const TileTransform& t = instance.transform;
  const auto [own_level, wide, high, margin_found] = sharpness(t.scale);
  const double margin = margin_found; // a name that a lambda may take
  if (!may_show(t, cell, pixel_box(walk, i, end))) return;
  SourceSamples samples;
  std::array<std::size_t, longest_run> pixel{};
  std::array<float, longest_run> shown{};
  for (std::size_t k = i; k < end; ++k) {
    const double x = walk.x(k) - static_cast<double>(cell.x), y = walk.y(k) - static_cast<double>(cell.y);
    if (clipped && (x < 0 || y < 0 || x >= 1 || y >= 1)) continue;
    const TileTransform::Inside at = t.overflowed(x, y);
    double share = at.shown() ? 1 : 0;
    if (margin > 0) { // as bilinear filtering with clear texels round it
      const auto along = [&](double u, double side) {
        return std::clamp(std::min(u * side, (1 - u) * side) + margin, 0.0, 1.0);
      };
      share = along(at.u, wide) * along(at.v, high);
    }
    if (!(share > 0)) continue;
    pixel[samples.count] = k;
    shown[samples.count] = static_cast<float>(share);
    add_sample(samples, instance.pattern, at.u, at.v, own_level);
  }
  if (samples.count == 0) return;
  RunBuffer found;
  lookup.sample(samples, own_level, found.view());
  for (std::size_t k = 0; k < samples.count; ++k) {
    const std::size_t p = pixel[k];
    const float above = found.cover[k] * shown[k], below = out.cover[p] * (1 - above), both = above + below;
    out.cover[p] = both;
    if (!(both > 0)) continue;
    for (std::size_t c = 0; c < static_cast<std::size_t>(lookup.channels); ++c)
      out.value[c][p] = (found.value[c][k] * above + out.value[c][p] * below) / both;
  }
}

} // namespace tilepack
