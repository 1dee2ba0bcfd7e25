#pragma once

#include "tilepack/error/progress.h"
#include "tilepack/exemplar/sample_analysis.h"
#include "tilepack/synth/framed_set_settings.h"
#include "tilepack/synth/synth_options.h"
#include "tilepack/tileset/source_map.h"

namespace tilepack {

/// Construction::framed, the border-first construction of a set: what tiles share is made before any tile is.
///
///     1 the frame               2 framed tiles             3 insides                  4 joined, repaired
///     ●──strip──●──strip──●     ┌───┬─────────┬───┐        ┌───────────────┐          ┌───────────────┐
///     │         │         │     │ ● │  strip  │ ● │        │               │          │ ● ╱╲ strip ╲ ●│
///     s         s         s     ├───┘         └───┤        │  a window of  │          │ ╱  closed cut ╲│
///     │         │         │     │  s   (none)   s │   +    │  the sample   │    →     │ ╲   inside    ╱│
///     ●──strip──●──strip──●     ├───┐         ┌───┤        │  a tile       │          │ ● ╲ strip ╱  ●│
///     patches and strips        │ ● │  strip  │ ● │        └───────────────┘          └───────────────┘
///     of the sample             └───┴─────────┴───┘
///
///   1 For each color of lattice point a corner patch and for each color of edge a strip are taken from the
///     sample, all of them chosen together so that they fit one another and insides can be found for the tiles
///     (FrameShape, searched_frame). Strips are cut to their corner patches [Kwatra03] (joined_frame) and
///     repaired, so that what crosses an edge looks right on both sides of it.
///   2 A tile shows the half of each of its four strips that lies in it (framed_tiles). Neighbours therefore match
///     at their borders by construction, whatever their insides are.
///   3 For each tile an own window of the sample is chosen, all tiles together: by how it fits the strips, by how
///     often the set shows its parts already, and by what the set shows on the whole (chosen_interiors).
///   4 The window is joined to the strips by one closed minimum cut (join_interiors). What joins worst round lattice
///     points and across edges is replaced in all tiles at once (repair_set), the worst patches along the cuts of
///     each tile are replaced (replace_worst_patches [Kwatra03]), and the surroundings of what seams are left are
///     matched to the sample and voted on (match_and_vote [Barnes09, Wexler07, Kwatra05]). The guard, texels next
///     to an edge, stays the strip's throughout.
///
/// All texels are copies of the sample's. Both colorings. Where tiles hold whole periods of the sample, all parts
/// are kept in step with them (PeriodAlignment). `options` must be valid (see synthesize); the result depends on
/// sample, options and settings alone.
SourceMap framed_set(const SampleAnalysis& sample, const SynthOptions& options,
                     const FramedSetSettings& settings, const Progress& progress = {});

} // namespace tilepack
