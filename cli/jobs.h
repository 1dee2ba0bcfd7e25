#pragma once

#include "options.h"

#include <memory>

namespace tilepack::cli {

/// Adds --jobs N to the general options, whose heading stays the current one; shared by the verbs that compute. Results never depend on it.
void add_jobs_option(Options& options, int& jobs);

/// While it lives, no stage uses more than `jobs` threads; 0 leaves the number alone.
class JobLimit {
public:
  explicit JobLimit(int jobs);
  ~JobLimit();
  JobLimit(const JobLimit&) = delete;
  JobLimit& operator=(const JobLimit&) = delete;

private:
  struct Control;
  std::unique_ptr<Control> control;
};

} // namespace tilepack::cli
