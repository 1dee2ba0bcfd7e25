#pragma once

#include "tilepack/error/progress.h"
#include "tilepack/pack/pack_json.h"
#include "tilepack/report/bake_page.h"

#include <chrono>
#include <string>
#include <vector>

namespace tilepack::cli {

/// What bake and pack print on stdout when they are done: what was made, where, and of a synthesized set how
/// good it is. No times, so that it repeats. Text leaves out what is good.
std::string bake_report_text(const PackDescription& made, const std::string& folder,
                             const BakeFacts* facts = nullptr);

/// Where the time goes, told from the names of stages in calls of progress: from one name to the next, all
/// time is the first one's.
class StageClock {
public:
  /// Passes everything on to `onward`. The clock must outlive it.
  Progress around(Progress onward);
  void begin(std::string_view stage);
  /// The stages that took a hundredth or more, in the order in which they first came.
  std::vector<StageShare> shares();

private:
  std::vector<StageShare> stages; // share: seconds so far
  std::size_t current = 0;
  std::chrono::steady_clock::time_point since = std::chrono::steady_clock::now();
};

/// A rule for make and ninja: `target` depends on `inputs`. Blanks, '#', '$' and ':' are escaped as both
/// read them. An empty rule for each input follows, so that make does not fail once an input is gone.
std::string depfile_text(const std::string& target, const std::vector<std::string>& inputs);

} // namespace tilepack::cli
