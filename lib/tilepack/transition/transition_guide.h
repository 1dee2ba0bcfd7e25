#pragma once

#include "tilepack/exemplar/sample_analysis.h"
#include "tilepack/numeric/grid.h"
#include "tilepack/seam/label_cut.h"
#include "tilepack/seam/source_canvas.h"
#include "tilepack/transition/joined_samples.h"

#include <cstdint>
#include <span>
#include <vector>

namespace tilepack {

/// What a border between two materials costs, and how readily each texel of them gives way to another material.
///
/// A border costs what the eye makes of it. It is no fault that two materials differ where they meet, so it costs little
/// that they do: what is to be avoided is that a border runs through a thing, a stone or a leaf, which then looks cut.
/// So it costs by how flat its material is there, smoothed and by rank: outlines are where it is steep.
///
/// What stands gives way later than what lies low, so that sand fills the joints between stones before it covers them. Where
/// there is a height map, it says what stands; else brightness does, as it goes with the inside of things.
struct TransitionGuide {
  FeatureImage features;      ///< of the joined sample
  Grid<std::uint8_t> inside;  ///< of it: 0 on outlines; 255 far from them where things are largest, else less
  Grid<std::int8_t> standing; ///< of it: -127 gives way first, 127 last; about 0 in the mean of each material
  std::int64_t usual_difference =
      1;            ///< of texels of different materials: mean squared difference of features
  double thing = 8; ///< texels: about how wide the things are that the materials show

  /// In units of border_unit: about what a border costs, a texel, where it runs through things.
  static constexpr std::int64_t border_unit = 1024;

  /// Of neighbours of which one shows texel p and the other, at + (dx, dy), shows texel q of another material; where p's
  /// layer shows p_beyond at the other, and q's layer q_beyond at the one.
  std::int64_t border_cost(SourceTexel p, SourceTexel p_beyond, SourceTexel q, SourceTexel q_beyond) const;
};

/// `materials`: each one's analysis, in the order of the joined sample's places.
TransitionGuide transition_guide(const JoinedSamples& joined,
                                 std::span<const SampleAnalysis* const> materials);

} // namespace tilepack
