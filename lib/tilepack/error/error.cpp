#include "tilepack/error/error.h"

namespace tilepack {
namespace {

std::string joined(const std::string& where, const std::string& what) {
  return where.empty() ? what : where + ": " + what;
}

} // namespace

int exit_code(ErrorKind kind) {
  return static_cast<int>(kind) + 1;
}

Error::Error(ErrorKind error_kind, const std::string& where, const std::string& what_happened)
    : std::runtime_error(
          joined(spelled(where, FieldSpelling::plain), spelled(what_happened, FieldSpelling::plain))),
      kind_of_error(error_kind), marked_where(where), marked_what(what_happened) {}

std::string Error::message(FieldSpelling spelling) const {
  return joined(spelled(marked_where, spelling), spelled(marked_what, spelling));
}

} // namespace tilepack
