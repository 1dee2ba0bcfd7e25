#pragma once

#include "tilepack/error/progress.h"
#include "tilepack/exemplar/feature_image.h"
#include "tilepack/synth/synth_options.h"
#include "tilepack/tileset/source_map.h"

#include <vector>

namespace tilepack {

/// The patches of a quilted edge set: for each color the north-west texel of a window of one tile's size,
/// through whose middle the edge runs.   [Cohen03]
///
///      window of a horizontal edge              what a tile shows of its four windows
///      ┌───────────┐                            ┌───────────┐
///      │  ╱─────╲  │  south part of the         │ ╲   N   ╱ │
///      │ ╱       ╲ │  tile above                │   ╲   ╱   │
///      ├───edge────┤                            │ W   ╳   E │   the four cuts run from the
///      │ ╲       ╱ │  north part of the         │   ╱   ╲   │   corners to the centre
///      │  ╲─────╱  │  tile below                │ ╱   S   ╲ │
///      └───────────┘                            └───────────┘
struct EdgePatches {
  std::vector<SourceTexel> horizontal;
  std::vector<SourceTexel> vertical;
};

/// Chooses the patches: several random starts, each improved by moving one patch after another to where it
/// fits all patches it ever meets best, and the start with the cheapest cuts wins. The image must hold a
/// tile.
EdgePatches chosen_edge_patches(const FeatureImage& image, const SynthOptions& options,
                                const Progress& progress = {});

/// The complete edge-colored set made of `patches`, with minimum-error cuts. Texels within max(1, guard) of
/// an edge, but for the squares of that side at the corners, are those of the edge's own patch.
SourceMap quilted(const FeatureImage& image, const SynthOptions& options, const EdgePatches& patches);

/// The sum of the costs of all cuts of the complete set.
std::int64_t quilting_cost(const FeatureImage& image, const SynthOptions& options,
                           const EdgePatches& patches);

} // namespace tilepack
