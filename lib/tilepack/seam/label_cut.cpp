#include "tilepack/seam/label_cut.h"

#include "tilepack/seam/cut_graph.h"

#include <algorithm>
#include <utility>

namespace tilepack {
namespace {

constexpr int most_label_rounds = 4;

// With diagonals, or borders would run in steps along the axes.
constexpr std::pair<int, int> steps_to_neighbours[] = {{1, 0}, {0, 1}, {1, 1}, {-1, 1}};

Grid<std::uint8_t> cheapest_each(const LabelProblem& problem) {
  Grid<std::uint8_t> labels(problem.size);
  for (std::size_t p = 0; p < labels.values.size(); ++p) {
    if (problem.forced.values[p] != free_label) {
      labels.values[p] = static_cast<std::uint8_t>(problem.forced.values[p]);
      continue;
    }
    for (int label = 1; label < problem.labels; ++label)
      if (problem.price(label, p) < problem.price(labels.values[p], p))
        labels.values[p] = static_cast<std::uint8_t>(label);
  }
  return labels;
}

// The best way to give any set of texels the label.
class Expansion {
public:
  Expansion(const LabelProblem& label_problem, const Grid<std::uint8_t>& now, int to)
      : problem(label_problem), labels(now), label(to), graph(2 * now.values.size()),
        nodes(now.width, now.height, CutGraph::kept) {
    for (std::size_t p = 0; p < labels.values.size(); ++p) {
      if (labels.values[p] == label) nodes.values[p] = CutGraph::taken;
      if (problem.forced.values[p] != free_label || labels.values[p] == label) continue;
      const int node = nodes.values[p] = graph.add_node();
      graph.add_bias(node, problem.price(labels.values[p], p));
      graph.add_price(node, problem.price(label, p));
    }
    for (int y = 0; y < labels.height; ++y)
      for (int x = 0; x < labels.width; ++x) {
        for (const auto& [dx, dy] : steps_to_neighbours)
          if (labels.inside(x + dx, y + dy)) add_pair(x, y, dx, dy);
      }
  }

  Grid<std::uint8_t> solved() {
    graph.solve();
    Grid<std::uint8_t> result = labels;
    for (std::size_t p = 0; p < result.values.size(); ++p)
      if (nodes.values[p] >= 0 && graph.takes(nodes.values[p]))
        result.values[p] = static_cast<std::uint8_t>(label);
    return result;
  }

private:
  void add_pair(int x, int y, int dx, int dy) {
    const int p = nodes.at(x, y);
    const int q = nodes.at(x + dx, y + dy);
    if (p < 0 && q < 0) return;
    const int at_p = labels.at(x, y);
    const int at_q = labels.at(x + dx, y + dy);
    const auto cost = [&](int a, int b) {
      return a == b ? 0.0 : static_cast<double>(problem.border(x, y, dx, dy, a, b));
    };
    graph.add_pair(p, q, cost(at_p, at_q), cost(at_p, label), cost(label, at_q));
  }

  const LabelProblem& problem;
  const Grid<std::uint8_t>& labels;
  int label;
  CutGraph graph;
  Grid<int> nodes;
};

} // namespace

std::int64_t cost_of(const LabelProblem& problem, const Grid<std::uint8_t>& labels) {
  std::int64_t sum = 0;
  for (int y = 0; y < labels.height; ++y)
    for (int x = 0; x < labels.width; ++x) {
      const int here = labels.at(x, y);
      sum += problem.price(here, labels.index(x, y));
      for (const auto& [dx, dy] : steps_to_neighbours) {
        if (!labels.inside(x + dx, y + dy)) continue;
        const int there = labels.at(x + dx, y + dy);
        if (there != here) sum += problem.border(x, y, dx, dy, here, there);
      }
    }
  return sum;
}

Grid<std::uint8_t> least_labels(const LabelProblem& problem) {
  Grid<std::uint8_t> labels = cheapest_each(problem);
  if (problem.labels < 2) return labels;
  if (problem.labels == 2) { // from one label everywhere a single move reaches all choices
    for (std::size_t p = 0; p < labels.values.size(); ++p)
      if (problem.forced.values[p] == free_label) labels.values[p] = 0;
    return Expansion(problem, labels, 1).solved();
  }
  std::int64_t cost = cost_of(problem, labels);
  for (int round = 0; round < most_label_rounds; ++round) {
    const std::int64_t before = cost;
    for (int label = 0; label < problem.labels; ++label) {
      Grid<std::uint8_t> moved = Expansion(problem, labels, label).solved();
      const std::int64_t moved_cost = cost_of(problem, moved);
      if (moved_cost >= cost) continue; // borders may be priced so that a cut can't hold them
      labels = std::move(moved);
      cost = moved_cost;
    }
    if (cost == before) break;
  }
  return labels;
}

} // namespace tilepack
