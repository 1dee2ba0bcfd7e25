#include "tilepack/scene/scene_fault.h"

#include <fmt/format.h>

namespace tilepack {

Error error_of(const SceneProblem& problem, std::string_view file) {
  const ErrorKind kind =
      problem.fault == SceneFault::file ? ErrorKind::cannot_read : ErrorKind::invalid_content;
  const std::string where =
      problem.place.empty() ? std::string(file) : fmt::format("{}:{}: {}", file, problem.line, problem.place);
  return {kind, where, problem.what};
}

} // namespace tilepack
