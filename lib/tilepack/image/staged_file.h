#pragma once

#include "tilepack/image/made_folders.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace tilepack {

/// A file that appears complete or not at all: written under a temporary name beside `target`, which it takes
/// over (replacing an older file) when committed, and removed when destroyed before that.
///
/// Failures are remembered, so that writing may go through code that drops them; commit() throws the first.
class StagedFile {
public:
  /// Folders missing on the way are made, and go again if nothing is committed. Throws Error (cannot_write) if
  /// that can't be, the folder is read-only, or `target` is a folder.
  explicit StagedFile(std::filesystem::path target);
  ~StagedFile();
  StagedFile(const StagedFile&) = delete;
  StagedFile& operator=(const StagedFile&) = delete;

  /// Writes at `offset` and says whether it worked.
  bool write(std::uint64_t offset, std::span<const std::byte> bytes);
  std::uint64_t size() const { return length; }

  /// Throws Error (cannot_write) if a write failed so far.
  void check() const;
  /// Gives the file its name. Throws Error (cannot_write).
  void commit();

private:
  std::filesystem::path target;
  MadeFolders folders;
  std::filesystem::path temporary; ///< empty once committed
  std::uint64_t length = 0;
  std::string failure;
  int descriptor = -1;
};

} // namespace tilepack
