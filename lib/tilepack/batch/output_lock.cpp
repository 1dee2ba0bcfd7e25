#include "tilepack/batch/output_lock.h"

#include "tilepack/batch/content_hash.h"
#include "tilepack/error/error.h"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <sys/file.h>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>

namespace tilepack {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::milliseconds between_tries{20};

// A folder that is this user's alone; empty if there is none.
std::string folder_of_locks() {
  const char* runtime = std::getenv("XDG_RUNTIME_DIR");
  std::error_code fault;
  const fs::path around = runtime != nullptr && fs::is_directory(runtime, fault)
                              ? fs::path(runtime)
                              : fs::temp_directory_path(fault);
  const fs::path folder = around / fmt::format("tilepack-locks-{}", ::getuid());
  ::mkdir(folder.c_str(), 0700);
  struct stat status {};
  const bool ours =
      ::lstat(folder.c_str(), &status) == 0 && S_ISDIR(status.st_mode) && status.st_uid == ::getuid();
  return ours ? folder.string() : "";
}

std::string lock_file_of(const std::string& output) {
  const std::string folder = folder_of_locks();
  if (folder.empty()) return "";
  std::error_code fault;
  fs::path path = fs::weakly_canonical(fs::absolute(output), fault);
  if (fault) path = fs::absolute(output).lexically_normal();
  if (path.filename().empty()) path = path.parent_path(); // "pack/"
  return folder + "/" + hex(hash_of(path.string()));
}

std::string owner_in(int descriptor) {
  std::array<char, 32> text{};
  const ssize_t length = ::pread(descriptor, text.data(), text.size() - 1, 0);
  return length > 0 ? fmt::format("process {}", std::string(text.data(), static_cast<std::size_t>(length)))
                    : std::string("another process");
}

bool is_named(int descriptor, const std::string& file) {
  struct stat opened {
  }, named{};
  return ::fstat(descriptor, &opened) == 0 && ::lstat(file.c_str(), &named) == 0 &&
         opened.st_ino == named.st_ino && opened.st_dev == named.st_dev;
}

} // namespace

OutputLock::OutputLock(const std::string& output, WhenBusy when,
                       const std::function<void(const std::string& who)>& waiting)
    : file(lock_file_of(output)) {
  while (!file.empty()) {
    descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600);
    if (descriptor < 0) return;
    if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) {
      if (is_named(descriptor, file)) break;
    } else if (errno != EWOULDBLOCK) {
      ::close(descriptor);
      descriptor = -1;
      return; // a file system without locks
    } else {
      const std::string who = owner_in(descriptor);
      if (when == WhenBusy::refuse) {
        ::close(descriptor);
        descriptor = -1;
        throw Error(
            ErrorKind::cannot_write, output,
            fmt::format("{} is writing it; wait for it, or let {} do so", who, tilepack::field("wait")));
      }
      waited = true;
      try {
        if (waiting) waiting(who);
      } catch (...) {
        ::close(descriptor);
        descriptor = -1;
        throw;
      }
      std::this_thread::sleep_for(between_tries);
    }
    ::close(descriptor); // who had the lock removes the file
    descriptor = -1;
  }
  const std::string owner = fmt::format("{}", ::getpid());
  if (descriptor >= 0 &&
      (::ftruncate(descriptor, 0) != 0 ||
       ::pwrite(descriptor, owner.data(), owner.size(), 0) != static_cast<ssize_t>(owner.size())))
    return; // held all the same, by nobody in particular
}

OutputLock::~OutputLock() {
  if (descriptor < 0) return;
  ::unlink(file.c_str());
  ::close(descriptor);
}

} // namespace tilepack
