#include "tilepack/seam/graph_cut.h"

#include <opencv2/core.hpp>
#include <opencv2/imgproc/detail/gcgraph.hpp>

namespace tilepack {
namespace {

// Doubles hold the integer costs exactly (sums stay far below 2^53), and the solver only adds, subtracts and
// compares, so the cut is the same everywhere.
using Graph = cv::detail::GCGraph<double>;

constexpr int kept = -1;  // in place of a node: the texel keeps
constexpr int taken = -2; // it takes

class PatchGraph {
public:
  PatchGraph(const FeatureImage& feature_image, const SourceCanvas& old_canvas, const LaidPatch& laid_patch)
      : image(feature_image), canvas(old_canvas), patch(laid_patch) {
    const auto count =
        static_cast<std::size_t>(patch.area.width) * static_cast<std::size_t>(patch.area.height);
    node.resize(count);
    unsigned free_count = 0;
    for (const CutConstraint c : patch.constraints)
      free_count += c == CutConstraint::free || c == CutConstraint::unbiased;
    graph.create(free_count, 2 * free_count + 1);
    for (std::size_t i = 0; i < count; ++i)
      node[i] = patch.constraints[i] == CutConstraint::take   ? taken
                : patch.constraints[i] == CutConstraint::keep ? kept
                                                              : graph.addVtx();
    nodes = static_cast<int>(free_count);
  }

  int nodes = 0;
  bool has_edges = false;

  int node_at(int x, int y) const {
    const Rect& a = patch.area;
    if (x < a.x || y < a.y || x >= a.x + a.width || y >= a.y + a.height) return kept;
    return node[static_cast<std::size_t>(y - a.y) * static_cast<std::size_t>(a.width) +
                static_cast<std::size_t>(x - a.x)];
  }

  void add_bias(std::int64_t bias) {
    for (std::size_t i = 0; i < node.size(); ++i)
      if (patch.constraints[i] == CutConstraint::free)
        graph.addTermWeights(node[i], 0.0, static_cast<double>(bias));
  }

  // The seam between texel p = (x, y) and its neighbour q at p + (dx, dy), for the four ways to keep or take.
  void add_pair(int x, int y, int dx, int dy) {
    const int p = node_at(x, y);
    const int q = node_at(x + dx, y + dy);
    if (p < 0 && q < 0) return;
    const SourceTexel p_old = canvas.at(x, y);
    const SourceTexel q_old = canvas.at(x + dx, y + dy);
    const SourceTexel p_new{patch.origin.x + x, patch.origin.y + y};
    const SourceTexel q_new{p_new.x + dx, p_new.y + dy};
    const auto cost = [&](SourceTexel a, SourceTexel b) {
      return static_cast<double>(seam_cost(image, a, b, dx, dy));
    };
    if (p < 0) { // only q is free; taking beside a taken texel costs nothing
      if (p == kept)
        unary(q, cost(p_old, q_old), cost(p_old, q_new));
      else
        unary(q, cost(p_new, q_old), 0.0);
      return;
    }
    if (q < 0) {
      if (q == kept)
        unary(p, cost(p_old, q_old), cost(p_new, q_old));
      else
        unary(p, cost(p_old, q_new), 0.0);
      return;
    }
    const double both_keep = cost(p_old, q_old);
    const double q_takes = cost(p_old, q_new);
    const double p_takes = cost(p_new, q_old);
    // cost = both_keep + (p_takes - both_keep) p - p_takes q + (q_takes + p_takes - both_keep)(1 - p) q, with
    // p, q = 1 where the texel takes; the last factor must not be negative.
    const double raise = std::max(0.0, both_keep - q_takes - p_takes);
    const double p_raised = p_takes + raise; // raising one of the two is enough
    unary(p, 0.0, p_raised - both_keep);
    unary(q, 0.0, -p_raised);
    graph.addEdges(p, q, q_takes + p_raised - both_keep, 0.0);
    has_edges = true;
  }

  void solve() {
    if (!has_edges) graph.addEdges(nodes > 1 ? 1 : graph.addVtx(), 0, 0.0, 0.0); // the solver wants an edge
    graph.maxFlow();
  }

  bool takes(int n) { return n == taken || (n >= 0 && !graph.inSourceSegment(n)); }

private:
  // The source side keeps. Only the difference of the two costs matters.
  void unary(int n, double keep_cost, double take_cost) {
    const double take_more = take_cost - keep_cost;
    if (take_more >= 0.0)
      graph.addTermWeights(n, take_more, 0.0);
    else
      graph.addTermWeights(n, 0.0, -take_more);
  }

  const FeatureImage& image;
  const SourceCanvas& canvas;
  const LaidPatch& patch;
  Graph graph;
  std::vector<int> node;
};

} // namespace

bool lay_patch(const FeatureImage& image, SourceCanvas& canvas, const LaidPatch& patch, std::int64_t bias) {
  PatchGraph graph(image, canvas, patch);
  const Rect& a = patch.area;
  if (graph.nodes > 0) {
    // Pairs within the area, and those that join it to the texels around it.
    for (int y = std::max(0, a.y - 1); y < a.y + a.height; ++y)
      for (int x = std::max(0, a.x - 1); x < a.x + a.width; ++x) {
        if (x + 1 < canvas.width) graph.add_pair(x, y, 1, 0);
        if (y + 1 < canvas.height) graph.add_pair(x, y, 0, 1);
      }
    if (bias > 0) graph.add_bias(bias);
    graph.solve();
  }
  bool changed = false;
  for (int y = a.y; y < a.y + a.height; ++y)
    for (int x = a.x; x < a.x + a.width; ++x) {
      if (!graph.takes(graph.node_at(x, y))) continue;
      const SourceTexel from{patch.origin.x + x, patch.origin.y + y};
      changed = changed || canvas.at(x, y) != from;
      canvas.at(x, y) = from;
    }
  return changed;
}

} // namespace tilepack
