#include "tilepack/image/staged_file.h"

#include "tilepack/error/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace tilepack {
namespace {

// Of one target, for what killed processes left.
constexpr int parts_looked_at = 16;

std::filesystem::path part_of(const std::filesystem::path& folder, const std::filesystem::path& target,
                              int number) {
  return folder / part_name(target.filename().string(), number);
}

bool is_still(const FileDescriptor& file, const std::filesystem::path& name) {
  struct stat status {};
  return ::fstat(file.get(), &status) == 0 && file_id(name) == FileId{status.st_dev, status.st_ino};
}

// Removes `part` if nobody holds its lock; on file systems without locks nothing is known to be dead.
void remove_if_dead(const std::filesystem::path& part) {
  const FileDescriptor left(::open(part.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
  if (left && ::flock(left.get(), LOCK_EX | LOCK_NB) == 0 && is_still(left, part)) ::unlink(part.c_str());
}

} // namespace

// Creates `part` and locks it. False if another process was faster, to create it or to take it for dead.
bool StagedFile::take(const std::filesystem::path& part) {
  const StepOnDisk step;
  file = FileDescriptor(::open(part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
  if (!file) return false;
  const bool busy = ::flock(file.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  if (!busy && is_still(file, part)) {
    temporary = UnfinishedOutput(part);
    return true;
  }
  file.close();
  errno = EEXIST;
  return false;
}

StagedFile::StagedFile(std::filesystem::path final_name, std::string called)
    : target(std::move(final_name)), folders(target.parent_path()),
      shown(called.empty() ? target.string() : std::move(called)) {
  const auto fails = [&](const std::string& what) { throw Error(ErrorKind::cannot_write, shown, what); };
  std::error_code ignored;
  if (std::filesystem::is_directory(target, ignored)) fails("is a folder; name a file in it");
  // What its name can't be is said now, and not after the work: a temporary one may be shorter.
  struct stat there {};
  if (::lstat(target.c_str(), &there) != 0 && errno != ENOENT)
    fails(fmt::format("cannot be created: {}", std::strerror(errno)));
  // A device or a pipe, /dev/null or /dev/stdout, would be gone, with a file in its place.
  if (::stat(target.c_str(), &there) == 0 && !S_ISREG(there.st_mode))
    fails("is a device or a pipe, which a file would replace; name a file");
  const std::filesystem::path folder = target.has_parent_path() ? target.parent_path() : ".";
  for (int number = 0; number < parts_looked_at; ++number) remove_if_dead(part_of(folder, target, number));
  // The name is taken by creating it, so two processes that write the same target do not meet.
  for (int number = 0; !file; ++number) {
    const std::filesystem::path part = part_of(folder, target, number);
    if (take(part) || (errno == EEXIST && number < most_parts)) continue;
    const int reason = errno;
    if (reason == ENOENT && target.is_relative() && current_folder_was_removed())
      fails("the current folder was removed; go to one that is there");
    fails(reason == ENOENT
              ? fmt::format("the folder {} does not exist and can't be made", folder.string())
              : fmt::format("cannot be created in {}: {}", folder.string(), std::strerror(reason)));
  }
}

StagedFile::~StagedFile() {
  std::error_code ignored;
  if (!temporary.path().empty()) std::filesystem::remove(temporary.path(), ignored); // before its lock goes
}

bool StagedFile::write(std::uint64_t offset, std::span<const std::byte> bytes) {
  length = std::max(length, offset + bytes.size());
  while (!bytes.empty() && failure.empty()) {
    const ssize_t n = ::pwrite(file.get(), bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) {
      failure = n < 0 ? std::strerror(errno) : "the device takes no more";
      break;
    }
    offset += static_cast<std::uint64_t>(n);
    bytes = bytes.subspan(static_cast<std::size_t>(n));
  }
  return failure.empty();
}

void StagedFile::check() const {
  if (!failure.empty())
    throw Error(ErrorKind::cannot_write, shown,
                fmt::format("writing failed: {}; {}", failure,
                            failure == std::strerror(EFBIG)
                                ? "raise the largest size of files (ulimit -f), or choose a folder on a "
                                  "file system that takes larger ones"
                                : "free some space or choose another folder"));
}

FileSwap StagedFile::finished() {
  // Some file systems report a full disk only on closing. The lock goes with the last descriptor alone.
  const int copy = ::dup(file.get());
  if (copy >= 0 && ::close(copy) != 0 && failure.empty()) failure = std::strerror(errno);
  check();
  const auto absolute = [&](const std::filesystem::path& path) {
    std::error_code fault;
    std::filesystem::path result = std::filesystem::absolute(path, fault);
    return fault ? path : result;
  };
  const std::optional<FileId> id = file_id(temporary.path());
  if (!id)
    throw Error(ErrorKind::cannot_write, shown, "its temporary file was removed by someone else; try again");
  return {absolute(target), absolute(temporary.path()), *id, file_id(target).has_value()};
}

void StagedFile::commit() {
  finished();
  StepOnDisk step;
  std::error_code error;
  std::filesystem::rename(temporary.path(), target, error);
  if (error)
    throw Error(ErrorKind::cannot_write, shown,
                fmt::format("the finished file cannot get this name: {}", error.message()));
  temporary.forget();
  step.puts_in_place();
  folders.keep();
}

} // namespace tilepack
