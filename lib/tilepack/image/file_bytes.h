#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace tilepack {

/// A file opened for reading at any offset. Every function throws Error (cannot_read).
class FileBytes {
public:
  /// A regular file; anything else is refused without waiting for it.
  explicit FileBytes(const std::filesystem::path& file);
  ~FileBytes();
  FileBytes(const FileBytes&) = delete;
  FileBytes& operator=(const FileBytes&) = delete;

  std::uint64_t size() const { return length; }

  bool holds(std::uint64_t offset, std::uint64_t count) const {
    return offset <= length && count <= length - offset;
  }

  /// Fills `bytes` from `offset`; an end of file before that is a truncation.
  void read(std::uint64_t offset, std::span<unsigned char> bytes) const;

  [[noreturn]] void truncated() const;
  [[noreturn]] void damaged(const std::string& what) const;

private:
  std::string name;
  int descriptor = -1;
  std::uint64_t length = 0;
};

/// The number that `bytes` spell, the most significant first; the least significant first.
std::uint64_t big_endian(std::span<const unsigned char> bytes);
std::uint64_t little_endian(std::span<const unsigned char> bytes);

} // namespace tilepack
