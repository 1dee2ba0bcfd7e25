#pragma once

#include "tilepack/sampler/fast_tables.h"
#include "tilepack/sampler/filter.h"

#include <vector>

namespace tilepack {

/// Looks up a whole batch with one instruction set.
struct FastKernel {
  const char* target = "";
  void (*look_up)(const FastTables& tables, const SampleBatch& batch, Filter filter, Weights weights,
                  float* const* out) = nullptr;
};

/// The kernels this machine can run, best first; never empty.
std::vector<FastKernel> fast_kernels();

} // namespace tilepack
