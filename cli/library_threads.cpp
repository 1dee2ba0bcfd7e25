#include <array>
#include <cstring>
#include <sys/resource.h>
#include <unistd.h>

#ifndef TILEPACK_SANITIZED // sanitizers are not set up so early, and ask for more than any limit

namespace tilepack::cli {
namespace {

constexpr char one_thread[] = "OPENBLAS_NUM_THREADS=1";
constexpr std::size_t most_entries = 4096;
constexpr rlim_t many_processes = 4096;

bool is_limited(__rlimit_resource resource, rlim_t enough) {
  rlimit limit{};
  return ::getrlimit(resource, &limit) == 0 && limit.rlim_cur < enough;
}

// Where OpenCV brings OpenBLAS, that starts a thread a core when it is loaded. Each takes 128 MiB of address
// space, and where it gets none tries for ever; where a thread is refused, OpenBLAS sends the program a SIGINT.
// Nothing here multiplies matrices with it, but it can only be told by its environment, which is read before
// main: so under limits the program starts itself anew.
void start_without_library_threads(int, char** arguments, char** environment) {
  if (!is_limited(RLIMIT_AS, RLIM_INFINITY) && !is_limited(RLIMIT_NPROC, many_processes)) return;
  std::array<char*, most_entries + 2> entries{};
  std::size_t count = 0;
  for (; environment[count] != nullptr; ++count) {
    const bool known =
        std::strncmp(environment[count], one_thread, sizeof one_thread - 2) == 0; // up to the '='
    if (known || count == most_entries) return;
    entries[count] = environment[count];
  }
  entries[count] = const_cast<char*>(one_thread); // execve's interface; it only reads
  ::execve("/proc/self/exe", arguments, entries.data());
}

// Before the libraries set themselves up.
[[gnu::used, gnu::section(".preinit_array")]] void (*const at_start)(int, char**,
                                                                     char**) = start_without_library_threads;

} // namespace
} // namespace tilepack::cli

#endif
