#pragma once

#include "tilepack/error/progress.h"

#include <chrono>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tilepack {

/// How the time of a job was spent: by stage, as shares of the whole.
struct StageShare {
  std::string stage;
  double share = 0; ///< 0..1
};

/// Where the time goes, told from the names of stages in calls of progress: from one name to the next, all
/// time is the first one's. What it says never reaches a pack.
class StageClock {
public:
  /// Passes everything on to `onward`. The clock must outlive it.
  Progress around(Progress onward);

  /// Ends the stage that runs, and begins or goes on with this one.
  void begin(std::string_view stage);

  /// The stages that took a hundredth or more, in the order in which they first came.
  std::vector<StageShare> shares();

private:
  std::vector<StageShare> stages; // share: seconds so far
  std::size_t current = 0;
  std::chrono::steady_clock::time_point since = std::chrono::steady_clock::now();
};

/// Seconds from one call of lap() to the next, and to the first from when it was made.
class Stopwatch {
public:
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double>(now - std::exchange(last, now)).count();
  }

private:
  std::chrono::steady_clock::time_point last = std::chrono::steady_clock::now();
};

} // namespace tilepack
