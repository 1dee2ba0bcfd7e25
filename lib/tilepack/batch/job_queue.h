#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <vector>

namespace tilepack {

/// One of the jobs that share a machine.
struct QueuedJob {
  std::vector<std::size_t> after; ///< jobs, by number, that must have ended well before this one begins

  /// Bytes it will hold at its peak, asked just before it would begin. May throw.
  std::function<std::int64_t()> memory;

  /// Does it, on as many threads as it is told. Throws if it fails.
  std::function<void(int threads)> run;
};

enum class JobEnd {
  done,
  failed,  ///< it threw
  skipped, ///< one that it comes after did not end well
};

struct QueueLimits {
  int threads = 0;         ///< of all jobs together; 0: as many as the machine has
  std::int64_t memory = 0; ///< bytes of all that run beside each other; 0: no limit. A job that says
                           ///< it needs more runs alone.
};

/// Runs all jobs, as many beside each other as threads and memory allow, in their order where there is a choice.
/// While more wait than there are threads, each gets one thread, which wastes the least; the last ones share what
/// is left. A job that fails keeps only those after it from running. `failed` is told each exception, in the thread
/// of the job, before the next begins; what it throws ends the queue: nothing more is begun, and it is thrown on
/// when all that run have ended. `failed` and `skipped` may be called by several threads at once. Whatever a job does
/// must allow for others at its side.
std::vector<JobEnd> run_all(const std::vector<QueuedJob>& jobs, const QueueLimits& limits,
                            const std::function<void(std::size_t job, std::exception_ptr fault)>& failed,
                            const std::function<void(std::size_t job)>& skipped);

} // namespace tilepack
