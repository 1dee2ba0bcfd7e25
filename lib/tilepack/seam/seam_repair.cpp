#include "tilepack/seam/seam_repair.h"

#include "tilepack/seam/graph_cut.h"

#include <algorithm>

namespace tilepack {
namespace {

// The square of side `side` with the greatest sum of costs, of those not ruled out.
struct Spot {
  Rect area;
  std::int64_t cost = 0;
};

class SpotFinder {
public:
  SpotFinder(const SourceCanvas& canvas, int square_side)
      : width(canvas.width), height(canvas.height),
        side(std::min({square_side, canvas.width, canvas.height})), barred(canvas.texels.size(), 0) {}

  Spot worst(const std::vector<std::int64_t>& costs) const {
    const std::size_t stride = static_cast<std::size_t>(width) + 1;
    std::vector<std::int64_t> sums(stride * (static_cast<std::size_t>(height) + 1));
    for (int y = 0; y < height; ++y) {
      std::int64_t run = 0;
      for (int x = 0; x < width; ++x) {
        const std::size_t i =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
        run += barred[i] ? 0 : costs[i];
        sums[static_cast<std::size_t>(y + 1) * stride + static_cast<std::size_t>(x + 1)] =
            sums[static_cast<std::size_t>(y) * stride + static_cast<std::size_t>(x + 1)] + run;
      }
    }
    Spot spot;
    for (int y = 0; y + side <= height; ++y)
      for (int x = 0; x + side <= width; ++x) {
        const auto at = [&](int i, int j) {
          return sums[static_cast<std::size_t>(j) * stride + static_cast<std::size_t>(i)];
        };
        const std::int64_t cost = at(x + side, y + side) - at(x, y + side) - at(x + side, y) + at(x, y);
        if (cost > spot.cost) spot = {{x, y, side, side}, cost};
      }
    return spot;
  }

  // The middle of the spot is not looked at again.
  void bar(Rect area) {
    for (int y = area.y; y < area.y + area.height; ++y)
      for (int x = area.x; x < area.x + area.width; ++x)
        barred[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)] =
            1;
  }

private:
  int width;
  int height;
  int side;
  std::vector<std::uint8_t> barred;
};

Rect around(Rect spot, int side, int width, int height) {
  const int w = std::min(side, width);
  const int h = std::min(side, height);
  return {std::clamp(spot.x + spot.width / 2 - w / 2, 0, width - w),
          std::clamp(spot.y + spot.height / 2 - h / 2, 0, height - h), w, h};
}

// What the canvas shows in `area`, at 1 / scale of its size.
Overlap shown_in(const FeatureImage& image, const SourceCanvas& canvas, Rect area, int scale) {
  Overlap overlap(area.width / scale, area.height / scale, image.channels);
  std::vector<std::uint8_t> texel(static_cast<std::size_t>(image.channels));
  for (int y = 0; y < overlap.height; ++y)
    for (int x = 0; x < overlap.width; ++x) {
      for (int c = 0; c < image.channels; ++c) {
        int sum = scale * scale / 2;
        for (int j = 0; j < scale; ++j)
          for (int i = 0; i < scale; ++i) {
            const SourceTexel s = canvas.at(area.x + x * scale + i, area.y + y * scale + j);
            sum += image.texel(s.x, s.y)[c];
          }
        texel[static_cast<std::size_t>(c)] = static_cast<std::uint8_t>(sum / (scale * scale));
      }
      overlap.add(x, y, texel.data());
    }
  return overlap;
}

// Rules out the positions of a map around a sample texel: what stems from there is no news.
void rule_out(PositionMap& map, SourceTexel origin, int scale) {
  constexpr int distance = 2;
  const int cx = origin.x / scale;
  const int cy = origin.y / scale;
  for (int y = std::max(0, cy - distance); y <= std::min(map.height - 1, cy + distance); ++y)
    for (int x = std::max(0, cx - distance); x <= std::min(map.width - 1, cx + distance); ++x)
      map.values[static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) +
                 static_cast<std::size_t>(x)] = ruled_out;
}

// Where the area's north-west texel would lie in the sample for each piece of material in the area.
void rule_out_material_of(PositionMap& map, const SourceCanvas& canvas, Rect area, int scale) {
  std::vector<SourceTexel> origins;
  for (int y = area.y; y < area.y + area.height; y += 2)
    for (int x = area.x; x < area.x + area.width; x += 2) {
      const SourceTexel s = canvas.at(x, y);
      const SourceTexel origin{s.x - (x - area.x), s.y - (y - area.y)};
      if (std::find(origins.rbegin(), origins.rend(), origin) != origins.rend()) continue;
      origins.push_back(origin);
      rule_out(map, origin, scale);
    }
}

void favour_fresh(PositionMap& map, const UseCounts& usage, Size window, double freshness) {
  const double average = usage.mean();
  if (average <= 0.0 || freshness <= 0.0) return;
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x) {
      std::int64_t& misfit = map.values[static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) +
                                        static_cast<std::size_t>(x)];
      if (misfit == ruled_out) continue;
      const double often = usage.mean({x, y, window.width, window.height}) / average;
      misfit = static_cast<std::int64_t>(static_cast<double>(misfit) * (1.0 + freshness * often));
    }
}

} // namespace

void replace_worst_patches(const FeaturePyramid& pyramid, const PatchSearch& search, const UseCounts& usage,
                           const PeriodAlignment& phase, const std::vector<std::uint8_t>& fixed,
                           const SeamRepairOptions& options, SourceCanvas& canvas) {
  if (options.spots == 0) return;
  const FeatureImage& image = pyramid.front();
  const int scale = 1 << (pyramid.size() - 1);
  SpotFinder finder(canvas, std::max(1, options.window / 2));
  std::vector<std::int64_t> costs = seams_at_texels(image, canvas);
  for (int n = 0; n < options.spots; ++n) {
    const Spot spot = finder.worst(costs);
    if (spot.cost == 0) return;
    const Rect area = around(spot.area, options.window / scale * scale, canvas.width, canvas.height);
    finder.bar(around(spot.area, options.window / 3, canvas.width, canvas.height));
    if (area.width < 2 * scale || area.height < 2 * scale || area.width > image.width ||
        area.height > image.height)
      return;
    PositionMap map = search.mismatches(shown_in(image, canvas, area, scale));
    rule_out_of_step(map, phase.seen_from({area.x, area.y}), scale);
    rule_out_material_of(map, canvas, area, scale);
    favour_fresh(map, usage, {area.width / scale, area.height / scale}, options.freshness);
    const Overlap full = shown_in(image, canvas, area, 1);
    LaidPatch move{area, {}, {}};
    for (int y = area.y; y < area.y + area.height; ++y)
      for (int x = area.x; x < area.x + area.width; ++x)
        move.freedom.push_back(fixed[canvas.index(x, y)] ? CutConstraint::keep : CutConstraint::free);
    bool changed = false;
    for (int attempt = 0; attempt < options.tries; ++attempt) {
      const auto least = std::min_element(map.values.begin(), map.values.end());
      if (*least == ruled_out) break;
      const int at = static_cast<int>(least - map.values.begin());
      const SourceTexel place =
          best_near(image, full, {at % map.width * scale, at / map.width * scale}, scale);
      rule_out(map, place, scale);
      move.origin = {place.x - area.x, place.y - area.y};
      changed = lay_patch(image, canvas, move) || changed;
    }
    if (changed) costs = seams_at_texels(image, canvas);
  }
}

} // namespace tilepack
