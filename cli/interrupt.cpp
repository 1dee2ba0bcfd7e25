#include "interrupt.h"

#include "tilepack/image/unfinished_outputs.h"

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdlib>
#include <ctime>
#include <initializer_list>
#include <pthread.h>
#include <semaphore.h>
#include <utility>

namespace tilepack::cli {
namespace {

// A signal handler has nowhere else to leave word: the mutable variables of the program outside functions.
volatile std::sig_atomic_t signal_received = 0;
sem_t word; // one up for each signal, and for the end of the watch; takes no file descriptor

void note_signal(int signal) {
  const int before = errno;
  signal_received = signal;
  ::sem_post(&word);
  errno = before;
}

// How long the work may take to end by itself, in milliseconds.
constexpr long patience = 350;

void watch_interrupts() {
  ::sem_init(&word, 0, 0);
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

struct InterruptWatch::State {
  std::function<void(bool)> say;
  pthread_t thread{};
  bool runs = false;
  std::atomic<bool> ended = false;

  // False if none came in time.
  static bool word_comes(long milliseconds) {
    timespec end{};
    ::clock_gettime(CLOCK_MONOTONIC, &end);
    end.tv_nsec += milliseconds * 1000000;
    end.tv_sec += end.tv_nsec / 1000000000;
    end.tv_nsec %= 1000000000;
    int result = 0;
    do result = ::sem_clockwait(&word, CLOCK_MONOTONIC, &end);
    while (result != 0 && errno == EINTR);
    return result == 0;
  }

  void watch() const {
    while (::sem_wait(&word) != 0 && errno == EINTR) {
    }
    if (ended || (word_comes(patience) && ended)) return;
    say(abandon_unfinished_outputs());
    end_by_signal();
  }
};

InterruptWatch::InterruptWatch(std::function<void(bool)> say) : state(std::make_unique<State>()) {
  state->say = std::move(say);
  pthread_attr_t attributes;
  if (::pthread_attr_init(&attributes) != 0) return;
  ::pthread_attr_setstacksize(&attributes, std::size_t{512} << 10); // not to take what little memory there is
  const auto run = [](void* of) -> void* {
    static_cast<const State*>(of)->watch();
    return nullptr;
  };
  // Where no thread can be had, the work must see to it alone.
  state->runs = ::pthread_create(&state->thread, &attributes, run, state.get()) == 0;
  ::pthread_attr_destroy(&attributes);
}

InterruptWatch::~InterruptWatch() {
  state->ended = true;
  ::sem_post(&word);
  if (state->runs) ::pthread_join(state->thread, nullptr);
}

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
