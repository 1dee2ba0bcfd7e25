#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

namespace tilepack {

/// The graph behind a choice between two labels for each of many texels: to keep what they show, or to take new
/// material [Kwatra03]. For those who lay patches (lay_patch, cut_of_window).
///
/// Costs are integers below 2^53, so that the cut is the same everywhere.
class CutGraph {
public:
  static constexpr int kept = -1;  ///< in place of a node: the texel keeps
  static constexpr int taken = -2; ///< it takes

  explicit CutGraph(std::size_t most_nodes);
  ~CutGraph();
  CutGraph(const CutGraph&) = delete;
  CutGraph& operator=(const CutGraph&) = delete;

  int add_node();
  int nodes() const { return count; }

  /// Paid if the node keeps.
  void add_bias(int node, std::int64_t bias);
  /// Paid if the node takes.
  void add_price(int node, std::int64_t price);

  /// What the seam between two neighbours costs where both keep, where only q takes, and where only p does; where
  /// both take there is none.
  ///
  /// Where the old seam costs more than the two ways to cut through it (squared differences are no metric), these
  /// two are priced up until the graph can hold them [Kwatra03, 3.1].
  void add_pair(int p, int q, double both_keep, double q_takes, double p_takes);

  void solve();
  bool takes(int node) const;

private:
  void unary(int node, double keep_cost, double take_cost);

  struct Graph;
  std::unique_ptr<Graph> graph;
  int count = 0;
  bool has_edges = false;
};

} // namespace tilepack
