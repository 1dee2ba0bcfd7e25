#pragma once

#include "console.h"
#include "options.h"

#include <functional>
#include <span>
#include <string>

namespace tilepack::cli {

/// What a verb does once its arguments are parsed; returns the exit code, or throws Error.
using Action = std::function<int(Console& console)>;

/// One verb of the command line. Dispatch, the help listing and the suggestions for mistyped verbs all read
/// verb_table(), so a new verb is one file `verb_NAME.cpp` that defines `NAME_verb()`, its declaration below,
/// and a line in verb_table.cpp.
struct Verb {
  std::string name;
  std::string summary; ///< one line, no full stop
  std::string example; ///< command lines that work, shown below --help

  /// Declares positionals and options on `options`, and returns what runs after parsing. Values live in state
  /// that the returned action owns (a shared_ptr captured by both). --help and --quiet are there already.
  Action (*declare)(Options& options);

  std::string more = {}; ///< the way out when there are more arguments than positionals
};

Verb bake_verb();
Verb pack_verb();
Verb inspect_verb();
Verb validate_verb();
Verb render_verb();
Verb compose_verb();
Verb compare_verb();
Verb layouts_verb();
Verb bench_verb();
Verb shader_verb();
Verb batch_verb();
Verb view_verb();

/// All verbs, in the order of the help listing.
std::span<const Verb> verb_table();

} // namespace tilepack::cli
