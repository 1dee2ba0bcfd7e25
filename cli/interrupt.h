#pragma once

#include <functional>
#include <memory>

namespace tilepack::cli {

/// Thrown where Ctrl-C takes effect; not an Error, since nothing went wrong.
struct Interrupted {
  const char* left = "nothing was written"; ///< what follows "interrupted; "
};

/// True once SIGINT, SIGTERM or SIGHUP came. From its start, the program notes them instead of being ended.
bool interrupted();

/// Answers a signal where the work is not asked often enough whether one came: if the program has not ended by
/// itself soon after it, unfinished outputs are removed and the program is ended, whatever its threads are at. A
/// second signal is answered at once. One such watch a program.
class InterruptWatch {
public:
  /// `say` tells the user before the program ends; `something_is_in_place` as abandon_unfinished_outputs() has it.
  explicit InterruptWatch(std::function<void(bool something_is_in_place)> say);
  ~InterruptWatch();
  InterruptWatch(const InterruptWatch&) = delete;
  InterruptWatch& operator=(const InterruptWatch&) = delete;

private:
  struct State;
  std::unique_ptr<State> state;
};

/// Ends the program by the signal that came, so that a shell or make sees how it ended.
[[noreturn]] void end_by_signal();

} // namespace tilepack::cli
