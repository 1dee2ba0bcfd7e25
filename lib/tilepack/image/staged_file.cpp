#include "tilepack/image/staged_file.h"

#include "tilepack/error/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace tilepack {

StagedFile::StagedFile(std::filesystem::path final_name)
    : target(std::move(final_name)), folders(target.parent_path()) {
  const auto fails = [&](const std::string& what) {
    throw Error(ErrorKind::cannot_write, target.string(), what);
  };
  std::error_code ignored;
  if (std::filesystem::is_directory(target, ignored)) fails("is a folder; name a file in it");
  const std::filesystem::path folder = target.has_parent_path() ? target.parent_path() : ".";
  // The name is taken by creating it, so two processes that write the same target do not meet.
  for (int attempt = 0; descriptor < 0; ++attempt) {
    temporary = folder / fmt::format(".{}.{}-{}.part", target.filename().string(), ::getpid(), attempt);
    descriptor = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor < 0 && (errno != EEXIST || attempt == 1000)) {
      const int reason = errno;
      temporary.clear();
      fails(reason == ENOENT
                ? fmt::format("the folder {} does not exist and can't be made", folder.string())
                : fmt::format("cannot be created in {}: {}", folder.string(), std::strerror(reason)));
    }
  }
}

StagedFile::~StagedFile() {
  if (descriptor >= 0) ::close(descriptor);
  std::error_code ignored;
  if (!temporary.empty()) std::filesystem::remove(temporary, ignored);
}

bool StagedFile::write(std::uint64_t offset, std::span<const std::byte> bytes) {
  length = std::max(length, offset + bytes.size());
  while (!bytes.empty() && failure.empty()) {
    const ssize_t n = ::pwrite(descriptor, bytes.data(), bytes.size(), static_cast<off_t>(offset));
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
    throw Error(ErrorKind::cannot_write, target.string(),
                fmt::format("writing failed: {}; free some space or choose another folder", failure));
}

void StagedFile::commit() {
  const int closed = ::close(std::exchange(descriptor, -1));
  // Some file systems report a full disk only now.
  if (closed != 0 && failure.empty()) failure = std::strerror(errno);
  check();
  std::error_code error;
  std::filesystem::rename(temporary, target, error);
  if (error)
    throw Error(ErrorKind::cannot_write, target.string(),
                fmt::format("the finished file cannot get this name: {}", error.message()));
  temporary.clear();
  folders.keep();
}

} // namespace tilepack
