#pragma once

#include "tilepack/bake/bake_job.h"
#include "tilepack/batch/content_hash.h"

namespace tilepack {

/// What the pack of a job is made from, by name and content of each file that it reads; another value while one
/// can't be read. For telling whether to bake again, and no key of a cache: options are not in it.
ContentHash content_of(const BakeJob& job);

} // namespace tilepack
