#include "tilepack/synth/frame_refine.h"

#include "tilepack/match/patch_search.h"
#include "tilepack/synth/border_step.h"
#include "tilepack/synth/strip_axes.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdint>
#include <limits>

namespace tilepack {
namespace {

struct Place {
  SourceTexel at;
  double mismatch;
  double step; // across the edge, of the usual
};

bool fits_better(const Place& a, const Place& b) {
  return a.mismatch < b.mismatch;
}

// All places in step within `distance` texels of `start`, or the nearest one.
std::vector<Place> places_near(const FeatureImage& image, const Overlap& overlap,
                               const PeriodAlignment& alignment, int scale, SourceTexel start, int distance) {
  std::vector<Place> places;
  const auto add = [&](SourceTexel at) {
    places.push_back({at, static_cast<double>(mismatch_at(image, overlap, at)), 0.0});
  };
  for (int y = start.y - distance; y <= start.y + distance; ++y)
    for (int x = start.x - distance; x <= start.x + distance; ++x) {
      if (x < 0 || y < 0 || x + overlap.width > image.width || y + overlap.height > image.height) continue;
      if (alignment.allows({x * scale, y * scale}, scale)) add({x, y});
    }
  if (places.empty()) { // those near by lie beyond the sample: the next within it
    const SourceTexel most{image.width - overlap.width, image.height - overlap.height};
    const SourceTexel near =
        alignment.nearest({start.x * scale, start.y * scale}, {0, 0}, {most.x * scale, most.y * scale});
    add({std::clamp((near.x + scale / 2) / scale, 0, most.x),
         std::clamp((near.y + scale / 2) / scale, 0, most.y)});
  }
  return places;
}

// One place for each strip, by mismatch and by the mean of all steps.
std::vector<std::size_t> chosen_together(const std::vector<std::vector<Place>>& strips,
                                         const FrameRefineOptions& options) {
  std::vector<std::size_t> chosen(strips.size());
  std::vector<double> least(strips.size());
  double steps = 0.0;
  for (std::size_t i = 0; i < strips.size(); ++i) {
    const auto best = std::min_element(strips[i].begin(), strips[i].end(), fits_better);
    chosen[i] = static_cast<std::size_t>(best - strips[i].begin());
    least[i] = std::max(best->mismatch, 1.0);
    steps += best->step;
  }
  for (int round = 0; round < options.rounds; ++round)
    for (std::size_t i = 0; i < strips.size(); ++i) {
      const double others = steps - strips[i][chosen[i]].step;
      double lowest = std::numeric_limits<double>::max();
      for (std::size_t k = 0; k < strips[i].size(); ++k) {
        const Place& place = strips[i][k];
        const double off = (others + place.step) / static_cast<double>(strips.size()) - options.wanted_step;
        const double cost =
            place.mismatch / least[i] + options.step_weight * static_cast<double>(strips.size()) * off * off;
        if (cost < lowest) {
          lowest = cost;
          chosen[i] = k;
        }
      }
      steps = others + strips[i][chosen[i]].step;
    }
  return chosen;
}

} // namespace

void refine_frame(const FeatureImage& image, const FrameShape& shape, int scale,
                  const FrameRefineOptions& options, FrameSources& sources) {
  const bool full_size = scale == 1;
  const SourceTexel low{shape.corner_reach.x, shape.corner_reach.y};
  const SourceTexel high{std::max(low.x, image.width - low.x), std::max(low.y, image.height - low.y)};
  for (SourceTexel& c : sources.corners) {
    c = {2 * c.x, 2 * c.y};
    if (full_size) c = sources.alignment.nearest(c, low, high);
    c = {std::clamp(c.x, low.x, high.x), std::clamp(c.y, low.y, high.y)};
  }
  const int distance = full_size ? options.full_distance : options.distance;
  for (const Direction direction : {Direction::horizontal, Direction::vertical}) {
    const StripAxes axes = axes_of(shape, direction);
    const bool horizontal = direction == Direction::horizontal;
    auto& places = horizontal ? sources.horizontal : sources.vertical;
    const auto& ends = horizontal ? shape.horizontal : shape.vertical;
    const double usual = full_size ? mean_step(image, direction) : 0.0;
    const PeriodAlignment alignment = sources.alignment.seen_from(strip_place(axes, scale));
    std::vector<std::vector<Place>> near(places.size());
    tbb::parallel_for(std::size_t{0}, places.size(), [&](std::size_t i) {
      const SourceTexel first = sources.corners[static_cast<std::size_t>(ends[i].first)];
      const SourceTexel second = sources.corners[static_cast<std::size_t>(ends[i].second)];
      const Overlap overlap = end_overlap(image, shape, axes, first, second);
      near[i] = places_near(image, overlap, alignment, scale, {2 * places[i].x, 2 * places[i].y}, distance);
      if (usual <= 0.0) {
        places[i] = std::min_element(near[i].begin(), near[i].end(), fits_better)->at;
        return;
      }
      for (Place& place : near[i]) place.step = step_across(image, axes, place.at, first, second) / usual;
    });
    if (usual <= 0.0) continue;
    const auto chosen = chosen_together(near, options);
    for (std::size_t i = 0; i < places.size(); ++i) places[i] = near[i][chosen[i]].at;
  }
}

} // namespace tilepack
