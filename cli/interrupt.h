#pragma once

namespace tilepack::cli {

/// Thrown where Ctrl-C takes effect; not an Error, since nothing went wrong.
struct Interrupted {
  const char* left = "nothing was written"; ///< what follows "interrupted; "
};

/// True once SIGINT, SIGTERM or SIGHUP came. From its start, the program notes them instead of being ended.
bool interrupted();

/// Ends the program by the signal that came, so that a shell or make sees how it ended.
[[noreturn]] void end_by_signal();

} // namespace tilepack::cli
