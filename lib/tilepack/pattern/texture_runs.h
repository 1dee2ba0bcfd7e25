#pragma once

#include "tilepack/pattern/pattern_values.h"
#include "tilepack/pattern/run_values.h"
#include "tilepack/sampler/filter.h"

#include <vector>

namespace tilepack {

/// How a run is looked up: `level` is the binary logarithm of a pixel's size in texels of the scene
/// (PatternGraph::unit), any number.
struct RunLookup {
  int map = 0;
  double level = 0;
  Filter filter = Filter::trilinear;
};

/// Evaluates the texture nodes of a graph for runs of pixels. A run lies within the scene: it may begin anywhere in it
/// and ends before its border.
class TextureRuns {
public:
  TextureRuns(const PatternGraph& graph, const PatternValues& values);

  /// At most longest_run pixels.
  void evaluate(NodeId node, const PatternRun& run, const RunLookup& lookup, const RunValues& out) const;

  /// Channels of a map without alpha.
  int value_channels(int map) const { return channels[static_cast<std::size_t>(map)]; }
  /// By how much the level of a node's tiles is above that of the scene: log2 of tile texels a texel of the scene.
  double level_offset(NodeId node) const { return offsets[static_cast<std::size_t>(node)]; }

private:
  friend struct TextureRun;
  const PatternGraph& graph;
  const PatternValues& values;
  std::vector<int> channels;
  std::vector<double> offsets; // by node
};

} // namespace tilepack
