#include "tilepack/error/error.h"

namespace tilepack {

int exit_code(ErrorKind kind) {
  return static_cast<int>(kind) + 1;
}

Error::Error(ErrorKind error_kind, const std::string& where, const std::string& what_happened)
    : std::runtime_error(where.empty() ? what_happened : where + ": " + what_happened),
      kind_of_error(error_kind) {}

} // namespace tilepack
