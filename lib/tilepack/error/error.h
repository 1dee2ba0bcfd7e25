#pragma once

#include "tilepack/error/field.h"

#include <stdexcept>
#include <string>

namespace tilepack {

/// What went wrong, as a user must know it. The kind alone decides the exit code of the command line.
enum class ErrorKind {
  usage,           ///< exit 1: an option or argument is unknown, missing or out of range
  cannot_read,     ///< exit 2: a file is missing, unreadable, truncated or no image
  invalid_content, ///< exit 3: a file was read, but what it holds breaks a rule
  cannot_write,    ///< exit 4: an output can't be created, or would harm what is there
  check_failed,    ///< exit 5: a check found faults, or two images differ
  internal,        ///< exit 6: a fault of tilepack itself
};

/// The exit code that stands for `kind`: 1 to 6 in the order of the enumeration.
int exit_code(ErrorKind kind);

/// The one exception type of the library.
///
/// `where` names the file, or the option as field("layout"), and may be empty; `what_happened` gives the
/// offending value, the allowed range and the way out, in one sentence or two. Both may hold marked fields
/// (error/field.h). what() joins them as "where: what happened", fields spelled plainly.
class Error : public std::runtime_error {
public:
  Error(ErrorKind error_kind, const std::string& where, const std::string& what_happened);
  ErrorKind kind() const { return kind_of_error; }

  /// The option that is to blame, such as "layout"; empty if `where` is no field.
  std::string field() const { return field_name(marked_where); }

  const std::string& where() const { return marked_where; }        ///< fields marked
  const std::string& what_happened() const { return marked_what; } ///< fields marked

  /// what() with fields spelled for the reader.
  std::string message(FieldSpelling spelling) const;

private:
  ErrorKind kind_of_error;
  std::string marked_where;
  std::string marked_what;
};

} // namespace tilepack
