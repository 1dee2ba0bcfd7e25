#pragma once

#include "value_check.h"

#include <CLI/CLI.hpp>
#include <tbb/global_control.h>

#include <optional>

namespace tilepack::cli {

/// Adds --jobs N, shared by the verbs that compute. Results never depend on it.
inline void add_jobs_option(CLI::App& app, int& jobs) {
  app.add_option("--jobs", jobs, "threads, 1 to 1024; 0: as many as the machine has")
      ->check(whole_number(0, 1024, " (0: as many as the machine has)"))
      ->type_name("N");
}

/// While it lives, no stage uses more than `jobs` threads; 0 leaves the number alone.
class JobLimit {
public:
  explicit JobLimit(int jobs) {
    if (jobs > 0)
      control.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(jobs));
  }

private:
  std::optional<tbb::global_control> control;
};

} // namespace tilepack::cli
