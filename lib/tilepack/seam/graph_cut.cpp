#include "tilepack/seam/graph_cut.h"

#include "tilepack/seam/cut_graph.h"

#include <algorithm>

namespace tilepack {
namespace {

class PatchGraph {
public:
  PatchGraph(const FeatureImage& feature_image, const SourceCanvas& old_canvas, const LaidPatch& laid_patch)
      : image(feature_image), canvas(old_canvas), patch(laid_patch),
        graph(static_cast<std::size_t>(
            std::count_if(patch.constraints.begin(), patch.constraints.end(), [](CutConstraint c) {
              return c == CutConstraint::free || c == CutConstraint::unbiased;
            }))) {
    for (const CutConstraint c : patch.constraints)
      node.push_back(c == CutConstraint::take   ? CutGraph::taken
                     : c == CutConstraint::keep ? CutGraph::kept
                                                : graph.add_node());
  }

  bool any_free() const { return graph.nodes() > 0; }

  int node_at(int x, int y) const {
    const Rect& a = patch.area;
    if (x < a.x || y < a.y || x >= a.x + a.width || y >= a.y + a.height) return CutGraph::kept;
    return node[static_cast<std::size_t>(y - a.y) * static_cast<std::size_t>(a.width) +
                static_cast<std::size_t>(x - a.x)];
  }

  void add_bias(std::int64_t bias) {
    for (std::size_t i = 0; i < node.size(); ++i)
      if (patch.constraints[i] == CutConstraint::free) graph.add_bias(node[i], bias);
  }

  // The seam between texel p = (x, y) and its neighbour q at p + (dx, dy), for the ways to keep or take.
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
    graph.add_pair(p, q, p == CutGraph::taken || q == CutGraph::taken ? 0.0 : cost(p_old, q_old),
                   p == CutGraph::taken || q == CutGraph::kept ? 0.0 : cost(p_old, q_new),
                   q == CutGraph::taken || p == CutGraph::kept ? 0.0 : cost(p_new, q_old));
  }

  void solve() { graph.solve(); }
  bool takes(int n) { return graph.takes(n); }

private:
  const FeatureImage& image;
  const SourceCanvas& canvas;
  const LaidPatch& patch;
  CutGraph graph;
  std::vector<int> node;
};

} // namespace

bool lay_patch(const FeatureImage& image, SourceCanvas& canvas, const LaidPatch& patch, std::int64_t bias) {
  PatchGraph graph(image, canvas, patch);
  const Rect& a = patch.area;
  if (graph.any_free()) {
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
