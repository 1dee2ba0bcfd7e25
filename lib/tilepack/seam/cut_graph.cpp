#include "tilepack/seam/cut_graph.h"

#include <climits>
#include <opencv2/core/hal/interface.h> // uchar

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <vector>

// The solver is a template that asks of OpenCV no more than these two words, so nothing needs to be linked.
#define CV_Assert(condition)                                                                                 \
  static_cast<void>((condition) ? 0 : throw std::logic_error("a cut of a graph: " #condition))
#define MIN(a, b) std::min(a, b)
#include <opencv2/imgproc/detail/gcgraph.hpp>
#undef CV_Assert
#undef MIN

namespace tilepack {

// Doubles hold the integer costs exactly, and the solver only adds, subtracts and compares.
struct CutGraph::Graph : cv::detail::GCGraph<double> {};

CutGraph::CutGraph(std::size_t most_nodes) : graph(std::make_unique<Graph>()) {
  graph->create(static_cast<unsigned>(most_nodes), static_cast<unsigned>(2 * most_nodes + 1));
}

CutGraph::~CutGraph() = default;

int CutGraph::add_node() {
  ++count;
  return graph->addVtx();
}

void CutGraph::add_bias(int node, std::int64_t bias) {
  graph->addTermWeights(node, 0.0, static_cast<double>(bias));
}

void CutGraph::add_price(int node, std::int64_t price) {
  graph->addTermWeights(node, static_cast<double>(price), 0.0);
}

void CutGraph::add_pair(int p, int q, double both_keep, double q_takes, double p_takes) {
  if (p < 0 && q < 0) return;
  if (p < 0) {
    if (p == kept)
      unary(q, both_keep, q_takes);
    else
      unary(q, p_takes, 0.0);
    return;
  }
  if (q < 0) {
    if (q == kept)
      unary(p, both_keep, p_takes);
    else
      unary(p, q_takes, 0.0);
    return;
  }
  // cost = both_keep + (p_takes - both_keep) p - p_takes q + (q_takes + p_takes - both_keep)(1 - p) q, with
  // p, q = 1 where the texel takes; the last factor must not be negative.
  const double raise = std::max(0.0, both_keep - q_takes - p_takes);
  const double p_raised = p_takes + raise; // raising one of the two is enough
  unary(p, 0.0, p_raised - both_keep);
  unary(q, 0.0, -p_raised);
  graph->addEdges(p, q, q_takes + p_raised - both_keep, 0.0);
  has_edges = true;
}

void CutGraph::solve() {
  if (count == 0) return;
  if (!has_edges) graph->addEdges(count > 1 ? 1 : graph->addVtx(), 0, 0.0, 0.0); // the solver wants an edge
  graph->maxFlow();
}

bool CutGraph::takes(int node) const {
  return node == taken || (node >= 0 && !graph->inSourceSegment(node));
}

// The source side keeps. Only the difference of the two costs matters.
void CutGraph::unary(int node, double keep_cost, double take_cost) {
  const double take_more = take_cost - keep_cost;
  if (take_more >= 0.0)
    graph->addTermWeights(node, take_more, 0.0);
  else
    graph->addTermWeights(node, 0.0, -take_more);
}

} // namespace tilepack
