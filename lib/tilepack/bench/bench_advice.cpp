#include "tilepack/bench/bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tilepack {
namespace {

constexpr double same_error = 0.1;       // 8-bit units: nobody sees less
constexpr double same_error_share = 0.1; // and of an error
constexpr double same_time = 0.2;        // of a time: ratios of one run and the next differ by so much
constexpr double wrong_float = 0.5;      // 8-bit units by which a coordinate held in a float may be off

bool as_good(double error, double best) {
  return error <= best + std::max(same_error, same_error_share * best);
}

const MipSummary& least_by(const std::vector<MipSummary>& mips, double MipSummary::*figure) {
  return *std::min_element(mips.begin() + 1, mips.end(),
                           [&](const auto& a, const auto& b) { return a.*figure < b.*figure; });
}

void advise_mips(const Bench& bench, std::vector<std::string>& lines) {
  const std::vector<MipSummary> mips = mip_summaries(bench);
  if (mips.size() < 2) return; // the pack as it is, alone
  const MipSummary& best = least_by(mips, &MipSummary::together);
  const auto standard =
      std::find_if(mips.begin(), mips.end(), [](const MipSummary& m) { return m.mode == MipOptions{}.mode; });
  const bool tie = standard != mips.end() && as_good(standard->together, best.together);
  const MipSummary& chosen = tie ? *standard : best;
  lines.push_back(
      fmt::format("Mips: {}. From afar tiles are {:.2f} grey levels (of 255) off the true picture inside and "
                  "{:.2f} at their "
                  "borders; the line between them is a step of {:.2f}.",
                  tie ? fmt::format("keep '{}', the default: nothing is clearly better", chosen.mips)
                      : fmt::format("choose '{}', clearly the best of all", chosen.mips),
                  chosen.interior, chosen.border, chosen.jump));
  const MipSummary& nearest = least_by(mips, &MipSummary::border);
  const MipSummary& smoothest = least_by(mips, &MipSummary::jump);
  lines.push_back(
      fmt::format("Mips, if you look for one thing: '{}' is nearest to the true picture at borders "
                  "({:.2f} grey levels), '{}' has the faintest lines between tiles ({:.2f}).",
                  nearest.mips, nearest.border, smoothest.mips, smoothest.jump));
}

// As the pack is: its mapping, its corner pack if it has one, weights of full precision.
bool is_own(const Bench& bench, const LookupCost& cost) {
  const auto& costs = bench.lookups.costs;
  const bool has_corners =
      std::any_of(costs.begin(), costs.end(), [](const LookupCost& c) { return c.corner_pack; });
  return cost.mapping == bench.mapping && !cost.cells && cost.weights == BenchWeights::single &&
         cost.corner_pack == has_corners;
}

bool clearly_faster(const LookupCost& cost, const LookupCost& than) {
  return cost.nanoseconds < than.nanoseconds * (1 - std::max(same_time, cost.noise + than.noise));
}

std::string way(const LookupCost& cost) {
  return fmt::format("'{}' mapping with {} weights{}", name_of(cost.mapping), name_of(cost.weights),
                     cost.cells ? ", each tap from its tile" : "");
}

// The fastest of those that are as exact as the most exact of their filter.
void advise_lookups(const Bench& bench, BenchFilter filter, std::vector<std::string>& lines) {
  std::vector<const LookupCost*> costs;
  for (const LookupCost& cost : bench.lookups.costs)
    if (cost.filter == filter && cost.sampler == BenchSampler::fast) costs.push_back(&cost);
  double least = INFINITY;
  for (const LookupCost* cost : costs) least = std::min(least, cost->rms_truth);
  const LookupCost* fastest = nullptr;
  const LookupCost* own = nullptr;
  for (const LookupCost* cost : costs) {
    if (cost->rms_truth > least + same_error) continue;
    if (!fastest || cost->nanoseconds < fastest->nanoseconds) fastest = cost;
    if (is_own(bench, *cost)) own = cost;
  }
  if (!fastest) return;
  if (own && !clearly_faster(*fastest, *own))
    lines.push_back(
        fmt::format("Speed, {} filter: keep the pack's {}, {:.1f} ns a sample and {:.2f} grey levels off; "
                    "nothing as exact is clearly faster.",
                    name_of(filter), way(*own), own->nanoseconds, own->rms_truth));
  else
    lines.push_back(fmt::format(
        "Speed, {} filter: {} is the fastest of the most exact, {:.1f} ns a sample{}, {:.2f} grey levels "
        "off.",
        name_of(filter), way(*fastest), fastest->nanoseconds,
        own ? fmt::format(" against the {:.1f} of the pack as it is", own->nanoseconds) : "",
        fastest->rms_truth));
}

void advise_coordinates(const Bench& bench, std::vector<std::string>& lines) {
  for (const CoordinateError& error : bench.coordinates)
    if (error.as_float > wrong_float) {
      lines.push_back(fmt::format("Large worlds: a texture coordinate kept as one float is more than half a "
                                  "grey level off from 2^{} texels "
                                  "on; kept as a whole tile and a fraction it never is.",
                                  error.log2_texels));
      return;
    }
}

} // namespace

std::vector<std::string> advice(const Bench& bench) {
  std::vector<std::string> lines;
  advise_mips(bench, lines);
  advise_lookups(bench, BenchFilter::bilinear, lines);
  advise_lookups(bench, BenchFilter::trilinear, lines);
  advise_coordinates(bench, lines);
  return lines;
}

} // namespace tilepack
