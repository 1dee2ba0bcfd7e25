#pragma once

#include "tilepack/bake/stage_clock.h"
#include "tilepack/report/bake_verdict.h"

#include <span>
#include <string>
#include <utility>
#include <vector>

namespace tilepack {

/// Everything that the page shows besides the pack and its sample.
struct BakeSummary {
  std::string sample; ///< as the page is to name it
  BakeFacts facts;
  std::vector<StageShare> stages; ///< may be empty
};

/// One page with all pictures and figures in it (PNG and HTML, no scripts, nothing fetched): what the set is
/// like, why, and which option to turn. But for the shares of time it is the same for any thread count.
std::string bake_page(const BakeSummary& story, const BakedPack& made, std::span<const SampleMap> samples);

} // namespace tilepack
