#include "jobs.h"

#include <tbb/global_control.h>

namespace tilepack::cli {

void add_jobs_option(Options& options, int& jobs) {
  options.group("General");
  options.option("--jobs", jobs, "threads, 1 to 1024 (default 0: as many as the machine has)")
      .check(whole_number(0, 1024, " (0: as many as the machine has)"))
      .value("N");
}

struct JobLimit::Control {
  tbb::global_control threads;
};

JobLimit::JobLimit(int jobs) {
  if (jobs > 0)
    control.reset(
        new Control{{tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(jobs)}});
}

JobLimit::~JobLimit() = default;

} // namespace tilepack::cli
