#include "interrupt.h"

#include <csignal>
#include <cstdlib>
#include <initializer_list>

namespace tilepack::cli {
namespace {

// A signal handler has nowhere else to leave word: the one mutable variable of the program outside functions.
volatile std::sig_atomic_t signal_received = 0;

void note_signal(int signal) {
  signal_received = signal;
}

void watch_interrupts() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    // A program started with the signal ignored (nohup, a background job) keeps ignoring it.
    if (std::signal(signal, note_signal) == SIG_IGN) std::signal(signal, SIG_IGN);
  }
  // A file past the limit of `ulimit -f` is then a failed write like any other, with its message.
  std::signal(SIGXFSZ, SIG_IGN);
}

// Before main and before the libraries set themselves up, which takes longer than loading them: so that a
// Ctrl-C as early as that is answered too.
[[gnu::used, gnu::section(".preinit_array")]] void (*const at_start)() = watch_interrupts;

} // namespace

bool interrupted() {
  return signal_received != 0;
}

void end_by_signal() {
  const int signal = signal_received;
  std::signal(signal, SIG_DFL);
  std::raise(signal);
  std::exit(128 + signal);
}

} // namespace tilepack::cli
