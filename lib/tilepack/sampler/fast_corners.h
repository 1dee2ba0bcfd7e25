#pragma once

#include "tilepack/sampler/corner_blend.h"
#include "tilepack/sampler/reference_sampler.h"
#include "tilepack/sampler/sample_batch.h"

#include <memory>

namespace tilepack {

/// The blend of the corner pack for FastSampler: few places of a tile are near enough to a corner of it, so
/// the kernels look all of a batch up in the tiles, and here the reference sampler does those few again.
class FastCorners {
public:
  /// Copies what it needs of pack.maps[map] and the corner pack's, which there must be.
  FastCorners(const Pack& pack, int map);

  void blend_in(const SampleBatch& batch, Filter filter, std::span<float* const> out) const;

private:
  std::unique_ptr<const Pack> pack; // of one map; stays where the sampler finds it
  ReferenceSampler sampler;
  CornerTexels corners; // for its weight
};

} // namespace tilepack
