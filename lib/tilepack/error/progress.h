#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <utility>

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

/// The same of one of several jobs, by its name. Jobs may run side by side: then it is called from several
/// threads at a time. It may throw to cancel the job that it is called about.
using JobProgress = std::function<void(std::string_view job, std::string_view stage, double done)>;

/// What the stages of `job` are given for `onward` to hear of them. Empty if `onward` is.
inline Progress progress_of(std::string job, JobProgress onward) {
  if (!onward) return {};
  return [job = std::move(job), onward = std::move(onward)](std::string_view stage, double done) {
    onward(job, stage, done);
  };
}

} // namespace tilepack
