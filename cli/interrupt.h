#pragma once

namespace tilepack::cli {

/// Thrown where Ctrl-C takes effect; not an Error, since nothing went wrong.
struct Interrupted {};

/// From now on SIGINT, SIGTERM and SIGHUP are noted instead of ending the program.
void watch_interrupts();

/// True once one of them came.
bool interrupted();

/// Ends the program by the signal that came, so that a shell or make sees how it ended.
[[noreturn]] void end_by_signal();

} // namespace tilepack::cli
