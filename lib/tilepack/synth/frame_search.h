#pragma once

#include "tilepack/error/progress.h"
#include "tilepack/synth/framed_set_settings.h"
#include "tilepack/synth/search_space.h"

namespace tilepack {

/// Chooses the whole frame together.
///
/// The choice is made in the last level of the space's pyramid and brought to the first. For each random choice
/// of corner patches the strips' best places by their fit to these are listed, and the choices whose strips can
/// be cut to the patches best are pursued; then one strip after another takes the place that makes the sum over
/// all tiles least of
///   the mismatch of its ends, and
///   the mismatch of the best inside that a tile with these four strips could get.
/// The second is a sum of four maps, one a side, over positions of the inside, so that trying another place
/// for a strip costs two maps and a few additions.
FrameSources searched_frame(const SearchSpace& space, const FrameSearchOptions& options,
                            const FrameRefineOptions& refine, const Progress& progress = {});

} // namespace tilepack
