#pragma once

#include "tilepack/error/progress.h"
#include "tilepack/exemplar/sample_analysis.h"
#include "tilepack/synth/synth_options.h"
#include "tilepack/tileset/source_map.h"
#include "tilepack/transition/joined_samples.h"

#include <span>
#include <vector>

namespace tilepack {

/// How a transition looks, in numbers: for reports.
struct TransitionFigures {
  double border_length = 0;  ///< texels of border in a tile of several materials, on average
  double through_things = 0; ///< share of it that runs through the inside of things, far from all outlines
  double expected = 0;       ///< the same share of straight borders through the middle of the same tiles
  std::vector<double> shown; ///< share of the texels of all tiles that show each material
};

/// The tiles of a transition and what they were made of.
struct TransitionSet {
  SourceMap sources; ///< of the joined sample
  std::vector<SourceMap>
      layers; ///< of each material by itself: corner color 0 where another is shown, then its own
  TransitionFigures figures;
};

/// The complete corner-colored set whose corner colors are materials: a map of materials, any at all, is tiled by it
/// without seams.
///
///   1 Each material gets a corner-colored set of its own (framed_set), with a color more: for where it is not
///     shown. So what it shows along an edge, and where its cuts run, is the same in all tiles that meet there,
///     whatever the other corners are. Its tiles of its own colors are the pure tiles.
///   2 A tile of several materials lies on those tiles of theirs like sheets on one another. Which sheet is seen at a
///     texel is chosen so that borders run round things and not through them (TransitionGuide, least_labels), about
///     where the corners would have them (TransitionField).
///   3 That is done for the edges first, in a window that lies across each kind of edge with what tiles show on both sides
///     of it. Next to the edge all tiles keep what comes out. Round a lattice point of a color, and along edges between equal
///     ones, only that material is seen.
///
/// All texels are copies. `materials`: 2 to 4, in the order of the joined sample's places; `options` as for
/// corner coloring (see synthesize), colors.corner the number of materials or, where each has as many, a multiple: those
/// of the first material come first. Deterministic for any number of threads.
TransitionSet transition_set(const JoinedSamples& joined, std::span<const SampleAnalysis* const> materials,
                             const SynthOptions& options, const Progress& progress = {});

} // namespace tilepack
