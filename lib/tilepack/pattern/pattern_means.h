#pragma once

#include "tilepack/pattern/share_pyramid.h"

#include <array>
#include <memory>
#include <mutex>
#include <vector>

namespace tilepack {

/// What a texture shows on average over a pixel that covers many cells: by the law of large numbers, its mean by the
/// probabilities of the place, which a map gives as they are.   [LN03, section 5.1, third solution]
///
/// Each pattern counts with the mean of its texels. Random numbers of different nodes are taken as independent. What is
/// left out: transition tiles (each material counts up to the border), heights in blends (materials count by coverage),
/// and sprites.
class PatternMeans {
public:
  PatternMeans(const PatternGraph& graph, const PatternValues& values, int map);
  ~PatternMeans();

  struct Mean {
    std::array<double, 4> value{}; ///< channels without alpha
    double cover = 0;
    std::array<double, 4> variance{}; ///< of what a single cell shows
  };
  /// Of a texture at a place, for a pixel of width_u x width_v units.
  Mean mean(NodeId texture, const PatternPlace& place, double width_u, double width_v) const;

  /// The probability of each index round a place: out[1 + index], index -1 first. They sum to 1.
  std::vector<double> shares(NodeId index, const PatternPlace& place, double width_u, double width_v) const;

  std::size_t bytes() const;

private:
  struct Region;
  struct Cache;
  struct SharesOf;
  struct MeanOf;

  const std::vector<double>& kept_shares(NodeId node) const;
  std::vector<double> sampled(NodeId node, const Region& region) const;
  std::vector<double> everywhere(NodeId node) const;
  const SharePyramid& pyramid(NodeId node, const StoredMap& map) const;
  Mean of_patterns(const PatternsTexture& block, NodeId node, const std::vector<double>& shares) const;
  double covered(const PatternsTexture& block, NodeId node, double cover) const;

  const PatternGraph& graph;
  const PatternValues& values;
  int map;
  int channels;
  std::unique_ptr<Cache[]> caches; // by node
};

} // namespace tilepack
