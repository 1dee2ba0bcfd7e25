#pragma once

#include "tilepack/pattern/animation.h"
#include "tilepack/pattern/grid_walk.h"
#include "tilepack/pattern/pattern_graph.h"

#include <atomic>
#include <memory>
#include <vector>

namespace tilepack {

/// The indices and numbers of a graph at one time: what its nodes give at a place, found by asking their inputs.
/// Many threads may ask at once.
class PatternValues {
public:
  /// `graph` has been checked and must outlive this.
  PatternValues(const PatternGraph& graph, double time);

  std::int64_t index(NodeId node, const PatternPlace& place) const;
  double number(NodeId node, const PatternPlace& place) const;
  double number_or(NodeId node, const PatternPlace& place, double otherwise) const {
    return node == no_node ? otherwise : number(node, place);
  }

  /// The index at pixel i of a run, and the end of the stretch of pixels that surely have it too.
  struct Stretch {
    std::int64_t value = 0;
    std::size_t end = 0;
  };
  Stretch stretch(NodeId node, const PatternRun& run, std::size_t i) const;

  /// The grid of a node that has one.
  const TileMapping& mapping(NodeId node) const { return states[static_cast<std::size_t>(node)].mapping; }
  bool has_grid(NodeId node) const { return states[static_cast<std::size_t>(node)].gridded; }
  /// Whether a number or index is the same everywhere.
  bool same_everywhere(NodeId node) const {
    return node == no_node || states[static_cast<std::size_t>(node)].constant;
  }
  /// Whether what a node gives is as likely everywhere: it follows from random numbers alone.
  bool stationary(NodeId node) const {
    return node == no_node || states[static_cast<std::size_t>(node)].even;
  }
  /// The hash of a node's cells: of its index or number, or of the variants of its tiles.
  const CellHash& hash(NodeId node) const { return states[static_cast<std::size_t>(node)].hashes[0]; }
  /// Of a transition, the hash of corners: which of its material's colors.
  const CellHash& corner_hash(NodeId node) const { return states[static_cast<std::size_t>(node)].hashes[1]; }

  /// Notes that a node was evaluated.
  void note(NodeId node) const {
    std::atomic<bool>& flag = used[static_cast<std::size_t>(node)];
    if (!flag.load(std::memory_order_relaxed)) flag.store(true, std::memory_order_relaxed);
  }
  std::vector<bool> used_nodes() const;

  const PatternBlock& block(NodeId node) const { return graph.nodes[static_cast<std::size_t>(node)].block; }

private:
  struct State {
    TileMapping mapping, coarse;
    bool gridded = false;
    bool constant = false;
    bool even = false;
    CellHash hashes[2];
  };
  struct IndexInCell;
  struct IndexAtPlace;
  struct NumberAtPlace;

  void prepare(NodeId node);
  std::int64_t index_in_cell(NodeId node, PatternCell cell) const;
  double smooth_number(const StoredNumber& block, const State& state, const PatternPlace& place) const;
  AnimationCycle cycle(const AnimationIndex& block, const PatternPlace& place, NodeId rest,
                       NodeId density) const;

  const PatternGraph& graph;
  double now;
  std::vector<State> states;
  std::unique_ptr<std::atomic<bool>[]> used;
};

} // namespace tilepack
