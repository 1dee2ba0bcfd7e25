// What has to be done before the libraries set themselves up; there is no header, for nobody calls it.

#include <cstdlib>
#include <cstring>
#include <sys/resource.h>
#include <unistd.h>
#include <vector>

namespace {

// OpenCV brings OpenBLAS, which nothing here uses. It starts threads as soon as it is loaded, and where memory or
// processes are short it tries for ever, then and when it is to end them. It doesn't if it is told to have one
// thread, in the environment with which the program starts: so the program starts again with that.
constexpr const char* one_thread = "OPENBLAS_NUM_THREADS=1";
constexpr rlim_t usual_processes = 4096; // systems allow tens of thousands where nobody set less

bool is_limited() {
  rlimit space{}, processes{};
  return (::getrlimit(RLIMIT_AS, &space) == 0 && space.rlim_cur != RLIM_INFINITY) ||
         (::getrlimit(RLIMIT_NPROC, &processes) == 0 && processes.rlim_cur < usual_processes);
}

void start_again_if_limited(int, char** arguments, char** environment) {
#ifndef TILEPACK_SANITIZED
  if (!is_limited()) return;
  constexpr std::size_t most_variables = 4096;
  static const char* variables[most_variables];
  std::size_t count = 0;
  for (char** variable = environment; *variable != nullptr; ++variable) {
    if (std::strncmp(*variable, one_thread, std::strlen(one_thread) - 1) == 0 || count + 2 == most_variables)
      return; // it is told how many, or there is no room to tell
    variables[count++] = *variable;
  }
  variables[count++] = one_thread;
  variables[count] = nullptr;
  ::execve("/proc/self/exe", arguments, const_cast<char* const*>(variables));
  // Where that can't be, it goes on as it is.
#else
  static_cast<void>(arguments);
  static_cast<void>(environment);
#endif
}

[[gnu::used, gnu::section(".preinit_array")]] void (*const at_start)(int, char**,
                                                                     char**) = start_again_if_limited;

} // namespace
