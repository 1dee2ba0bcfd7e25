#include "tilepack/seam/seam_repair.h"

#include "tilepack/seam/scaled_cut.h"
#include "tilepack/seam/window_lookup.h"

#include <algorithm>

namespace tilepack {
namespace {

struct WorstPatch {
  Rect area;
  std::int64_t cost = 0;
};

// Finds the square of side `side` with the greatest sum of seam costs, texels ruled out left aside.
class WorstPatchFinder {
public:
  WorstPatchFinder(const SourceCanvas& canvas, int square_side)
      : width(canvas.width), height(canvas.height),
        side(std::min({square_side, canvas.width, canvas.height})), ruled(canvas.texels.size(), 0) {}

  WorstPatch worst(const std::vector<std::int64_t>& costs) const {
    const std::size_t stride = static_cast<std::size_t>(width) + 1;
    std::vector<std::int64_t> sums(stride * (static_cast<std::size_t>(height) + 1));
    for (int y = 0; y < height; ++y) {
      std::int64_t run = 0;
      for (int x = 0; x < width; ++x) {
        const std::size_t i =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
        run += ruled[i] ? 0 : costs[i];
        sums[static_cast<std::size_t>(y + 1) * stride + static_cast<std::size_t>(x + 1)] =
            sums[static_cast<std::size_t>(y) * stride + static_cast<std::size_t>(x + 1)] + run;
      }
    }
    WorstPatch worst;
    for (int y = 0; y + side <= height; ++y)
      for (int x = 0; x + side <= width; ++x) {
        const auto at = [&](int i, int j) {
          return sums[static_cast<std::size_t>(j) * stride + static_cast<std::size_t>(i)];
        };
        const std::int64_t cost = at(x + side, y + side) - at(x, y + side) - at(x + side, y) + at(x, y);
        if (cost > worst.cost) worst = {{x, y, side, side}, cost};
      }
    return worst;
  }

  // Its texels are not looked at again.
  void rule_out(Rect area) {
    for (int y = area.y; y < area.y + area.height; ++y)
      for (int x = area.x; x < area.x + area.width; ++x)
        ruled[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)] =
            1;
  }

private:
  int width;
  int height;
  int side;
  std::vector<std::uint8_t> ruled;
};

Rect around(Rect patch, int side, int width, int height) {
  const int w = std::min(side, width);
  const int h = std::min(side, height);
  return {std::clamp(patch.x + patch.width / 2 - w / 2, 0, width - w),
          std::clamp(patch.y + patch.height / 2 - h / 2, 0, height - h), w, h};
}

// What the canvas shows in `area`, at 1 / scale of its size.
Overlap shown_in(const FeatureImage& image, const SourceCanvas& canvas, Rect area, int scale) {
  Overlap overlap(area.width / scale, area.height / scale, image.channels);
  add_shown(image, canvas, {area.x, area.y}, scale, {}, overlap);
  return overlap;
}

// For each place of the area's north-west texel how unlike what the area shows now the sample is there.
PositionMap mismatches_of(const SeamRepairInput& input, const SourceCanvas& canvas, Rect area, int scale,
                          double reuse_weight) {
  PositionMap map = input.search.mismatches(shown_in(input.pyramid.front(), canvas, area, scale));
  rule_out_of_step(map, input.alignment.seen_from({area.x, area.y}), scale);
  rule_out_material_of(map, canvas, area, scale, 2, 2);
  add_reuse_weight(map, input.uses, {area.width / scale, area.height / scale}, reuse_weight);
  return map;
}

// Lays the patch unless seams cost more then, as they may where cuts come down scale by scale. Of cuts at full size, too, one in
// a few was seen to cost half a hundredth more in drawn bricks (see lay_patch).
bool improved(const FeaturePyramid& pyramid, SourceCanvas& canvas, const LaidPatch& patch) {
  const Rect& a = patch.area;
  const int x0 = std::max(0, a.x - 1), y0 = std::max(0, a.y - 1);
  const int x1 = std::min(canvas.width, a.x + a.width + 1), y1 = std::min(canvas.height, a.y + a.height + 1);
  const auto copied = [&] {
    SourceCanvas part(x1 - x0, y1 - y0);
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x) part.at(x - x0, y - y0) = canvas.at(x, y);
    return part;
  };
  const SourceCanvas before = copied();
  if (!lay_patch_by_scales(pyramid, canvas, patch)) return false;
  if (seam_energy(pyramid.front(), copied()) <= seam_energy(pyramid.front(), before)) return true;
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x) canvas.at(x, y) = before.at(x - x0, y - y0);
  return false;
}

// Brings a place of the last level to the first: one level after the other, and through the last at once.
SourceTexel at_full_size(const SeamRepairInput& input, const SourceCanvas& canvas, Rect area,
                         const Overlap& full, SourceTexel place) {
  constexpr int distance = 2; // the rounding of the level before, and one
  int level = static_cast<int>(input.pyramid.size()) - 1;
  for (; level > levels_at_once; --level) {
    const FeatureImage& next = input.pyramid[static_cast<std::size_t>(level - 1)];
    place = best_near(next, shown_in(input.pyramid.front(), canvas, area, 1 << (level - 1)),
                      {2 * place.x, 2 * place.y}, distance);
  }
  const int scale = 1 << level;
  return best_near(input.pyramid.front(), full, {place.x * scale, place.y * scale}, scale);
}

// Lays the `tries` windows of the sample most like the area over it. Returns whether any texel changed.
bool replaced(const SeamRepairInput& input, const SeamRepairOptions& options, Rect area,
              SourceCanvas& canvas) {
  const FeatureImage& image = input.pyramid.front();
  const int scale = 1 << (input.pyramid.size() - 1);
  PositionMap map = mismatches_of(input, canvas, area, scale, options.reuse_weight);
  const Overlap full = shown_in(image, canvas, area, 1);
  LaidPatch patch{area, {}, {}};
  for (int y = area.y; y < area.y + area.height; ++y)
    for (int x = area.x; x < area.x + area.width; ++x)
      patch.constraints.push_back(input.fixed[canvas.index(x, y)] ? CutConstraint::keep
                                                                  : CutConstraint::free);
  bool changed = false;
  for (int attempt = 0; attempt < options.tries; ++attempt) {
    SourceTexel found;
    if (!take_best(map, 0, found)) break;
    const SourceTexel place = at_full_size(input, canvas, area, full, found);
    rule_out(map, place, scale, 2);
    patch.origin = {place.x - area.x, place.y - area.y};
    changed = improved(input.pyramid, canvas, patch) || changed;
  }
  return changed;
}

} // namespace

void replace_worst_patches(const SeamRepairInput& input, const SeamRepairOptions& options,
                           SourceCanvas& canvas) {
  if (options.patches == 0) return;
  const FeatureImage& image = input.pyramid.front();
  const int scale = 1 << (input.pyramid.size() - 1);
  const int window = options.window * std::max(1, scale >> levels_at_once);
  const int side = window / scale * scale;
  if (std::min({side, canvas.width, canvas.height}) < 2 * scale ||
      std::min(side, canvas.width) > image.width || std::min(side, canvas.height) > image.height)
    return;
  WorstPatchFinder finder(canvas, std::max(1, window / 2));
  std::vector<std::int64_t> costs = seams_at_texels(image, canvas);
  for (int n = 0; n < options.patches; ++n) {
    const WorstPatch worst = finder.worst(costs);
    if (worst.cost == 0) return;
    const Rect area = around(worst.area, side, canvas.width, canvas.height);
    finder.rule_out(around(worst.area, window / 3, canvas.width, canvas.height));
    if (replaced(input, options, area, canvas)) costs = seams_at_texels(image, canvas);
  }
}

} // namespace tilepack
