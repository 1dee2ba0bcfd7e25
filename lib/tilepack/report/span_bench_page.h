#pragma once

#include "tilepack/bench/span_bench.h"

#include <string>

namespace tilepack {

/// One page with all figures of the span methods and plots of them.
std::string span_bench_page(const SpanBench& bench);

} // namespace tilepack
