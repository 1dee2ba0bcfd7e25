#include "tilepack/numeric/random.h"
#include "tilepack/seam/label_cut.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>

using namespace tilepack;

namespace {

// Prices and borders by chance; a border costs what its two texels say, whatever the labels.
LabelProblem random_problem(Size size, int labels, std::uint64_t seed, int forced_one_in) {
  LabelProblem problem;
  problem.size = size;
  problem.labels = labels;
  problem.forced = Grid<std::int8_t>(size, free_label);
  const auto texels = problem.forced.values.size();
  for (std::size_t i = 0; i < texels * static_cast<std::size_t>(labels); ++i)
    problem.prices.push_back(random_below(seed, "price", i, 100));
  for (std::size_t i = 0; i < texels; ++i)
    if (random_below(seed, "forced", i, static_cast<std::uint32_t>(forced_one_in)) == 0)
      problem.forced.values[i] =
          static_cast<std::int8_t>(random_below(seed, "to", i, static_cast<std::uint32_t>(labels)));
  problem.border = [seed](int x, int y, int dx, int dy, int, int) {
    return static_cast<std::int64_t>(
        random_below(seed, "border", static_cast<std::uint64_t>(((y * 64 + x) * 4 + dx + 1) * 2 + dy), 60));
  };
  return problem;
}

std::int64_t least_of_all(const LabelProblem& problem) {
  Grid<std::uint8_t> labels(problem.size);
  std::int64_t least = std::numeric_limits<std::int64_t>::max();
  const std::size_t texels = labels.values.size();
  std::size_t ways = 1;
  for (std::size_t i = 0; i < texels; ++i) ways *= static_cast<std::size_t>(problem.labels);
  for (std::size_t way = 0; way < ways; ++way) {
    std::size_t rest = way;
    bool allowed = true;
    for (std::size_t i = 0; i < texels; ++i, rest /= static_cast<std::size_t>(problem.labels)) {
      labels.values[i] = static_cast<std::uint8_t>(rest % static_cast<std::size_t>(problem.labels));
      const std::int8_t forced = problem.forced.values[i];
      allowed = allowed && (forced == free_label || forced == labels.values[i]);
    }
    if (allowed) least = std::min(least, cost_of(problem, labels));
  }
  return least;
}

bool keeps_forced(const LabelProblem& problem, const Grid<std::uint8_t>& labels) {
  for (std::size_t i = 0; i < labels.values.size(); ++i)
    if (problem.forced.values[i] != free_label && problem.forced.values[i] != labels.values[i]) return false;
  return true;
}

} // namespace

TEST_CASE("of two labels the cheapest choice of all is found", "[seam]") {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const LabelProblem problem = random_problem({4, 3}, 2, seed, 5);
    const Grid<std::uint8_t> labels = least_labels(problem);
    CHECK(keeps_forced(problem, labels));
    CHECK(cost_of(problem, labels) == least_of_all(problem));
  }
}

TEST_CASE("of three labels the choice is the cheapest or near it, and never dearer than each texel's own",
          "[seam]") {
  int found = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const LabelProblem problem = random_problem({3, 3}, 3, seed, 6);
    const Grid<std::uint8_t> labels = least_labels(problem);
    CHECK(keeps_forced(problem, labels));
    const std::int64_t least = least_of_all(problem);
    found += cost_of(problem, labels) == least;
    CHECK(static_cast<double>(cost_of(problem, labels)) <= 1.25 * static_cast<double>(least));
  }
  CHECK(found >= 12);
}

TEST_CASE("one label is what is left, and dear borders make one area", "[seam]") {
  LabelProblem problem = random_problem({5, 5}, 1, 1, 1000);
  CHECK(least_labels(problem).values == std::vector<std::uint8_t>(25, 0));
  problem = random_problem({5, 5}, 2, 1, 1000);
  problem.border = [](int, int, int, int, int, int) { return std::int64_t{1} << 30; };
  const Grid<std::uint8_t> labels = least_labels(problem);
  CHECK(std::count(labels.values.begin(), labels.values.end(), labels.values[0]) == 25);
}
