#pragma once

#include "tilepack/match/row_correlation.h"
#include "tilepack/synth/frame.h"
#include "tilepack/synth/strip_axes.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tilepack {

/// Places in the sample that are tried for the inside of a tile: every stride-th along both axes, so that their
/// number is bounded.
struct Positions {
  int stride = 1;
  int columns = 0;
  int rows = 0;
  std::size_t count() const { return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows); }
};

/// One cost a position, row by row.
using MatchCostMap = std::vector<float>;

/// A strip and its two corner patches, each from somewhere in the sample, before they are cut together.
struct StripAt {
  const FeatureImage& image;
  const FrameShape& shape;
  StripAxes axes;
  SourceTexel place, first, second; ///< as in FrameSources

  /// What is shown: of the corner patches within half their reach, else of the strip.
  const std::uint8_t* shown(int along, int across) const;
};

/// The two sides of an edge: the tile above or to the left of it, and the one below or to the right.
enum class EdgeSide { before, after };

/// How well insides of tiles fit what a strip shows on the two sides of its edge, for one strip after another
/// and all positions at once.
class BorderMatchCosts {
public:
  /// `image` and `shape` at the scale of the search, `shape` to outlive this. The stride of the positions is the
  /// least with which there are no more than `most_positions`.
  BorderMatchCosts(const FeatureImage& image, const FrameShape& shape, std::size_t most_positions);

  const Positions& positions() const { return places; }

  /// For each position the sum of squared differences between what the strip shows in a tile and what the
  /// tile's inside would show there, divided by `reach`: by EdgeSide, for the tile before the edge and the one
  /// after.
  std::array<MatchCostMap, 2> of(const StripAt& strip) const;

private:
  // For vertical strips x and y are swapped throughout: `along` is along the rows.
  struct View {
    FeatureImage image;
    PairPlanes pairs;
    int lines = 0;
    int places = 0; ///< in a line
    /// By EdgeSide: for each position the sum of the squares of what an inside shows there.
    std::array<std::vector<std::int64_t>, 2> squares;
  };
  View view_of(FeatureImage image, const StripAxes& axes) const;
  MatchCostMap of_side(const StripAt& strip, EdgeSide side) const;

  const FrameShape& shape;
  Positions places;
  std::array<View, 2> views; ///< by Direction
};

} // namespace tilepack
