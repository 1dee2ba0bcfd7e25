#pragma once

#include "tilepack/sampler/fast_tables.h"
#include "tilepack/sampler/filter.h"

#include <span>

namespace tilepack {

/// Exact filtering for FastSampler: where a filter crosses a border of the tile that holds a place, in a level that
/// it reads, each tap is read from the tile that it lies in.   [Wei04, section 4.3]
///
/// The kernels look all of a batch up as if all lay within their tiles; here those few that don't are done again,
/// scalar, in floats, and the rest left as they are. `tables.lookup` must be set. `out`: a pointer a channel.
void mend_borders(const FastTables& tables, const SampleBatch& batch, Filter filter, Weights weights,
                  std::span<float* const> out);

} // namespace tilepack
