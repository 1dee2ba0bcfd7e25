#pragma once

#include "tilepack/exemplar/feature_image.h"
#include "tilepack/exemplar/period.h"
#include "tilepack/tileset/material_map.h"

#include <span>
#include <vector>

namespace tilepack {

/// Along which axes a sample goes on at its opposite border, as one that was made to repeat does.
struct SampleWrap {
  bool x = false; ///< the last column lies beside the first
  bool y = false; ///< the last row lies above the first
  bool operator==(const SampleWrap&) const = default;
};

/// Finds that by the step across the border, of texels and of means of squares of 2 and 4 texels: it must lie near the
/// mean step inside, and far from the mean step between places that have nothing to do with each other. How far up the
/// way from the one to the other is allowed was set by 96 axes of samples that are made to repeat (renders of whole
/// periods of packs, photos whose borders were blended or whose phases are random, noise, cells and stones on a
/// torus), of which 91 are found, and by 560 axes of photos and crops of them: no whole photo is taken for one, and 4
/// crops are, two of which end at whole courses. tests/exemplar/sample_wrap_test.cpp has samples of all these kinds.
/// Noise, where neighbours have nothing to do with each other, wraps nowhere: nothing could tell. Samples under 16
/// texels a side don't wrap.
///
/// A sample that holds whole periods may end where they do, at a joint or a line: its step across the border may also
/// be that of the places inside which lie whole periods from it.
SampleWrap detect_wrap(const FeatureImage& image, const Periodicity& periods);

/// Maps of one size, continued to the east and south by themselves.
std::vector<SampleMap> continued(std::span<const SampleMap> samples, Size to);

} // namespace tilepack
