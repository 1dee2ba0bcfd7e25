#pragma once

#include <functional>
#include <string_view>

namespace tilepack {

/// How a long stage tells its caller where it is: a short stage name ("patch search") and the share done, 0
/// to 1.
///
/// May be empty. It is called from one thread at a time, and may throw to cancel the stage.
using Progress = std::function<void(std::string_view stage, double done)>;

/// Calls `progress` unless it is empty.
inline void report(const Progress& progress, std::string_view stage, double done) {
  if (progress) progress(stage, done);
}

} // namespace tilepack
