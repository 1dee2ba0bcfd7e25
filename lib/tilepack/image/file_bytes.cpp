#include "tilepack/image/file_bytes.h"

#include "tilepack/error/error.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace tilepack {

namespace {

// Of what the process may have, and no fault of the file.
bool is_lack(int reason) {
  return reason == EMFILE || reason == ENFILE || reason == ENOMEM;
}

} // namespace

FileBytes::FileBytes(const std::filesystem::path& file) : name(file.string()) {
  // Not blocking: opening a pipe must not wait for a writer.
  descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0)
    throw Error(is_lack(errno) ? ErrorKind::internal : ErrorKind::cannot_read, name,
                fmt::format("cannot be opened: {}", std::strerror(errno)));
  struct stat status {};
  if (::fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode)) {
    ::close(descriptor);
    throw Error(ErrorKind::cannot_read, name,
                S_ISDIR(status.st_mode) ? "is a folder; name an image file in it"
                                        : "is not a regular file; copy the image to one");
  }
  length = static_cast<std::uint64_t>(status.st_size);
}

FileBytes::~FileBytes() {
  ::close(descriptor);
}

void FileBytes::read(std::uint64_t offset, std::span<unsigned char> bytes) const {
  while (!bytes.empty()) {
    const ssize_t n = ::pread(descriptor, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0)
      throw Error(ErrorKind::cannot_read, name, fmt::format("cannot be read: {}", std::strerror(errno)));
    if (n == 0) truncated();
    offset += static_cast<std::uint64_t>(n);
    bytes = bytes.subspan(static_cast<std::size_t>(n));
  }
}

void FileBytes::truncated() const {
  throw Error(
      ErrorKind::cannot_read, name,
      fmt::format("is truncated: its content goes on after the {} bytes that are there; copy or export "
                  "it again",
                  length));
}

void FileBytes::damaged(const std::string& what) const {
  throw Error(ErrorKind::cannot_read, name, fmt::format("is damaged: {}; copy or export it again", what));
}

std::uint64_t big_endian(std::span<const unsigned char> bytes) {
  std::uint64_t value = 0;
  for (const unsigned char b : bytes) value = value << 8 | b;
  return value;
}

std::uint64_t little_endian(std::span<const unsigned char> bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = bytes.size(); i > 0; --i) value = value << 8 | bytes[i - 1];
  return value;
}

} // namespace tilepack
