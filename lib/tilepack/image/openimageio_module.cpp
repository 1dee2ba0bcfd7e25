#include "tilepack/image/openimageio_module.h"

#include "tilepack/error/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <dlfcn.h>
#include <fcntl.h>
#include <latch>
#include <string>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <system_error>
#include <thread>
#include <unistd.h>
#include <vector>

namespace tilepack {
namespace {

bool memory_is_limited() {
  rlimit space{};
  return ::getrlimit(RLIMIT_AS, &space) == 0 && space.rlim_cur != RLIM_INFINITY;
}

[[noreturn]] void cant_start(const std::string& why) {
  throw Error(
      ErrorKind::internal, openimageio_module_name,
      fmt::format("{}can't start under the limits of this process ({}); raise them, or use PNG, which does "
                  "without",
                  memory_is_limited() ? "out of memory: " : "", why));
}

void* open_module() {
  return ::dlopen(openimageio_module_name, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
}

// Some of the libraries start threads while they are loaded or first used, and neither return nor fail in good
// order where that is refused: one waits for ever, others end the program. So it is tried before, with as many
// at a time as their pools have together.
void check_threads() {
  const unsigned count = 3 * std::max(2u, std::thread::hardware_concurrency()) + 4;
  std::latch all_tried(1);
  std::vector<std::thread> threads;
  threads.reserve(count);
  std::string fault;
  try {
    for (unsigned i = 0; i < count; ++i) threads.emplace_back([&] { all_tried.wait(); });
  } catch (const std::system_error& refused) {
    fault = refused.what();
  }
  all_tried.count_down();
  for (std::thread& thread : threads) thread.join();
  if (!fault.empty()) cant_start(fmt::format("a thread was refused: {}", fault));
}

// The same of memory, where it is limited: the module is loaded by a child first, which may end as it likes,
// but not take longer than this.
constexpr int most_seconds = 20;
// What must be left beside it, in bytes of address space: rows on their way, stacks of threads.
constexpr std::size_t reserve = std::size_t{192} << 20;

// Libraries throw while they are loaded, too: noexcept ends the child then.
[[noreturn]] void try_in_child() noexcept {
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere >= 0) ::dup2(nowhere, STDERR_FILENO);
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  for (const int signal : {SIGINT, SIGTERM, SIGABRT, SIGSEGV}) std::signal(signal, SIG_DFL);
  ::alarm(most_seconds);
  void* const module = open_module();
  if (module && ::mmap(nullptr, reserve, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0) == MAP_FAILED)
    ::_exit(1);
  using WarmUp = int (*)();
  const auto warm_up = module ? reinterpret_cast<WarmUp>(::dlsym(module, "tilepack_warm_up")) : nullptr;
  // A module that isn't found is nobody's lack of memory, and is said better later.
  ::_exit(!module ? 0 : warm_up ? warm_up() : 0);
}

void check_memory() {
  rlimit space{};
  if (::getrlimit(RLIMIT_AS, &space) != 0 || space.rlim_cur == RLIM_INFINITY) return;
  const pid_t child = ::fork();
  if (child < 0) cant_start(fmt::format("a process was refused: {}", std::strerror(errno)));
  if (child == 0) try_in_child();
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    cant_start(fmt::format("{} MiB of address space are allowed", space.rlim_cur >> 20));
}

void* loaded_module() {
  check_threads();
  check_memory();
  // Never unloaded: OpenImageIO keeps threads. Its symbols are nobody else's business.
  void* module = open_module();
  const std::string fault = module ? "" : ::dlerror();
  if (fault.find("failed to map") != std::string::npos || fault.find("annot allocate") != std::string::npos)
    cant_start(fault);
  if (!module)
    throw Error(ErrorKind::internal, openimageio_module_name,
                fmt::format("reads and writes image files other than PNG and cannot be loaded ({}); install "
                            "tilepack again, name the library's folder in LD_LIBRARY_PATH, or use PNG",
                            fault));
  const auto* version = static_cast<const char*>(::dlsym(module, "tilepack_module_version"));
  if (!version || std::strcmp(version, TILEPACK_VERSION) != 0)
    throw Error(ErrorKind::internal, openimageio_module_name,
                fmt::format("is of version {}, the program of {}; install tilepack again",
                            version ? version : "unknown", TILEPACK_VERSION));
  return module;
}

} // namespace

const void* openimageio_symbol(const char* name) {
  static void* const module = loaded_module();
  const void* symbol = ::dlsym(module, name);
  if (!symbol)
    throw Error(ErrorKind::internal, openimageio_module_name,
                fmt::format("lacks {}; install tilepack again", name));
  return symbol;
}

} // namespace tilepack
