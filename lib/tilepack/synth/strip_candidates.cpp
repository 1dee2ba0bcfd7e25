#include "tilepack/synth/strip_candidates.h"

#include "tilepack/synth/border_step.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <tuple>

namespace tilepack {
namespace {

std::vector<double> channel_means(const FeatureImage& image, Rect area) {
  std::vector<std::int64_t> sums(static_cast<std::size_t>(image.channels));
  for (int y = 0; y < area.height; ++y)
    for (int x = 0; x < area.width; ++x)
      for (int c = 0; c < image.channels; ++c)
        sums[static_cast<std::size_t>(c)] += image.texel(area.x + x, area.y + y)[c];
  std::vector<double> means;
  for (const std::int64_t s : sums)
    means.push_back(static_cast<double>(s) / (static_cast<double>(area.width) * area.height));
  return means;
}

struct Found {
  std::int64_t mismatch;
  SourceTexel place;
};

// The `count` least values, least first, of equal ones the first.
std::vector<Found> least_places(const PositionMap& map, std::size_t count) {
  std::vector<Found> order;
  for (std::uint32_t p = 0; p < map.parts.size(); ++p) {
    const std::vector<std::int64_t>& values = map.parts[p].values;
    for (std::uint32_t i = 0; i < values.size(); ++i)
      if (values[i] != ruled_out) order.push_back({values[i], map.parts[p].place(i)});
  }
  count = std::min(order.size(), count);
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count), order.end(),
                    [&](const Found& a, const Found& b) {
                      return std::tie(a.mismatch, a.place.y, a.place.x) <
                             std::tie(b.mismatch, b.place.y, b.place.x);
                    });
  order.resize(count);
  return order;
}

} // namespace

Rect shown_area(const StripAxes& axes, SourceTexel place, int scale) {
  const int shown = std::max(1, axes.reach);
  const SourceTexel at = sum(place, axes.at(0, axes.reach - shown / 2));
  const SourceTexel extent = axes.at(axes.length, shown);
  return {at.x * scale, at.y * scale, extent.x * scale, extent.y * scale};
}

StripRanking::StripRanking(const SearchSpace& space, const FrameSearchOptions& search_options)
    : image(space.small_image()), saliency(space.sample.saliency), scale(space.scale()),
      options(search_options), mean(channel_means(image, {0, 0, image.width, image.height})),
      usual_step{mean_step(image, Direction::horizontal), mean_step(image, Direction::vertical)} {}

std::vector<StripCandidate> StripRanking::best(const PositionMap& map, const StripAxes& axes,
                                               int depth) const {
  const auto wanted = static_cast<std::size_t>(options.candidates);
  const std::size_t spares = static_cast<std::size_t>(options.spares_per_candidate) * wanted;
  std::vector<StripCandidate> apart;
  for (const Found& found :
       least_places(map, static_cast<std::size_t>(options.places_per_candidate) * wanted)) {
    if (apart.size() >= spares) break;
    const SourceTexel at = found.place;
    if (std::any_of(apart.begin(), apart.end(), [&](const StripCandidate& c) {
          return std::abs(c.place.x - at.x) < options.apart && std::abs(c.place.y - at.y) < options.apart;
        }))
      continue;
    apart.push_back({at, static_cast<double>(found.mismatch) / depth + mean_color_cost(at, axes)});
  }
  // Corner patches, the same for all candidates, are left out of it.
  const double usual = std::max(usual_step[axes.direction == Direction::horizontal ? 0 : 1], 1e-3);
  for (StripCandidate& c : apart) {
    const double excess = step_across(image, axes, c.place) / usual - 1.0;
    c.mismatch *= 1.0 + options.step_weight * excess * excess;
    c.mismatch *= 1.0 + options.saliency_weight * excess_in(saliency, shown_area(axes, c.place, scale));
  }
  std::stable_sort(apart.begin(), apart.end(),
                   [](const StripCandidate& a, const StripCandidate& b) { return a.mismatch < b.mismatch; });
  if (apart.size() > wanted) apart.resize(wanted);
  return apart;
}

double StripRanking::mean_color_cost(SourceTexel at, const StripAxes& axes) const {
  const auto own = channel_means(image, {at.x, at.y, axes.width(), axes.height()});
  double squared = 0.0;
  for (std::size_t c = 0; c < own.size(); ++c) squared += (own[c] - mean[c]) * (own[c] - mean[c]);
  return options.mean_color_weight * squared * axes.length;
}

} // namespace tilepack
