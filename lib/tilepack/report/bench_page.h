#pragma once

#include "tilepack/bench/bench.h"

#include <string>

namespace tilepack {

/// One page with all figures and plots in it (SVG, no scripts, nothing fetched).
std::string bench_page(const Bench& bench);

} // namespace tilepack
