#include "tilepack/layout/layout_search.h"

#include "tilepack/error/error.h"
#include "tilepack/layout/rotated_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <tuple>

namespace tilepack {
namespace {

std::vector<RotatedScheme> wanted_schemes(const LayoutRequest& request) {
  const std::vector<RotatedScheme> schemes = rotated_schemes(request.tiles);
  if (schemes.empty()) {
    const ReachableCounts next = reachable_counts(request.tiles);
    throw Error(
        ErrorKind::usage, "layout rotated",
        fmt::format(
            "no scheme packs {} tiles without waste; the next counts that have one are {} and {}, and "
            "{} holds any",
            request.tiles, next.below, next.above, field("layout", "array")));
  }
  if (!request.scheme) return schemes;
  if (std::find(schemes.begin(), schemes.end(), *request.scheme) == schemes.end()) {
    std::string known;
    for (const RotatedScheme& scheme : schemes) known += (known.empty() ? "" : ", ") + formula(scheme);
    throw Error(ErrorKind::usage, field("scheme"),
                fmt::format("{} does not hold {} tiles; these do: {}", formula(*request.scheme),
                            request.tiles, known));
  }
  return {*request.scheme};
}

LayoutCandidate plan_for(const RotatedScheme& scheme, const LayoutRequest& request,
                         const TileColors* colors) {
  LayoutCandidate plan;
  plan.scheme = scheme;
  if (colors) {
    Arrangement arrangement = matching_arrangement(*colors, scheme);
    plan.matching = arrangement.matching;
    plan.arrangement = std::move(arrangement.tiles);
  }
  if (plan.matching != Matching::found) {
    plan.arrangement.resize(static_cast<std::size_t>(request.tiles));
    std::iota(plan.arrangement.begin(), plan.arrangement.end(), 0);
  }
  plan.gutter = request.gutter.value_or(plan.matching == Matching::found ? 0 : default_gutter);
  plan.size = rotated_texture_size(scheme, {request.tile_side, plan.gutter, request.power_of_two});
  const std::int64_t needed = std::int64_t{request.tiles} * request.tile_side * request.tile_side;
  plan.wasted = std::int64_t{plan.size.width} * plan.size.height - needed;
  plan.copied = scheme.k == 0 && plan.size.height == scheme.n * (request.tile_side + 2 * plan.gutter);
  return plan;
}

} // namespace

std::vector<LayoutCandidate> layout_plans(const LayoutRequest& request, const TileColors* colors) {
  std::vector<LayoutCandidate> plans;
  for (const RotatedScheme& scheme : wanted_schemes(request))
    plans.push_back(plan_for(scheme, request, colors));
  // At equal waste stored tiles are equally large, but for the gutter's share.
  std::stable_sort(plans.begin(), plans.end(), [](const LayoutCandidate& a, const LayoutCandidate& b) {
    return std::tuple(a.wasted, !a.copied, a.gutter) < std::tuple(b.wasted, !b.copied, b.gutter);
  });
  return plans;
}

Layout planned_layout(const LayoutCandidate& plan, int tile_side) {
  Layout layout = rotated_layout(plan.scheme, {tile_side, plan.gutter, false}, plan.arrangement);
  layout.rotated.size = plan.size;
  layout.rotated.matching = plan.matching;
  return layout;
}

std::int64_t padded_texels(int tiles, int tile_side) {
  std::int64_t side = 1;
  while (side < tile_side) side *= 2;
  std::int64_t cells = 1;
  while (cells < tiles) cells *= 2;
  return cells * side * side;
}

} // namespace tilepack
