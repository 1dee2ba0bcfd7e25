#pragma once

#include "tilepack/bake/bake_job.h"
#include "tilepack/report/bake_facts.h"

#include <functional>
#include <string_view>

namespace tilepack::cli {

/// Who wants to know how a bake that is judged gets on. Both may be empty.
struct JudgingWatch {
  std::function<void(std::string_view line)> note =
      {}; ///< what was tried, a line a further bake, fields marked
  std::function<void(const BakeFacts& facts)> refused = {}; ///< before the set is refused
};

/// Makes the run of a job that `watch` goes to keep what the job says of its verdict: `apply_advice` bakes again with
/// what the verdict names, twice at most, and `require` refuses what is worse with Error (check_failed) before
/// anything is written. `facts`, which must outlive the run, gets those of the pack; where neither is asked for,
/// they are worked out while files are written, and only if `always`. Throws what check_advice() does.
void judge(const BakeJob& job, JobWatch& watch, BakeFacts& facts, bool always, const JudgingWatch& judging);

} // namespace tilepack::cli
