#pragma once

#include "tilepack/image/file_descriptor.h"
#include "tilepack/image/file_swap.h"
#include "tilepack/image/made_folders.h"
#include "tilepack/image/unfinished_outputs.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace tilepack {

/// A file that appears complete or not at all: written under a temporary name beside `target`, which it takes
/// over (replacing an older file) when committed, and removed when destroyed before that.
///
/// The temporary file, `.NAME.N.part`, is locked while it is written. One that can be locked was left by a
/// process that was killed, and the next StagedFile of this target removes it.
///
/// Failures are remembered, so that writing may go through code that drops them; commit() throws the first.
class StagedFile {
public:
  /// Folders missing on the way are made, and go again if nothing comes to lie in them. Throws Error
  /// (cannot_write) if that can't be, the folder is read-only, or `target` is a folder. Messages call the file
  /// `shown`, if that is given.
  explicit StagedFile(std::filesystem::path target, std::string shown = {});
  ~StagedFile();
  StagedFile(const StagedFile&) = delete;
  StagedFile& operator=(const StagedFile&) = delete;

  /// Writes at `offset` and says whether it worked.
  bool write(std::uint64_t offset, std::span<const std::byte> bytes);
  /// Writes a whole text.
  bool write(std::string_view text) { return write(0, std::as_bytes(std::span(text))); }
  std::uint64_t size() const { return length; }
  const std::string& name() const { return shown; }

  /// Throws Error (cannot_write) if a write failed so far.
  void check() const;

  /// Gives the file its name. Throws Error (cannot_write).
  void commit();

  /// In place of commit(), for several files that get their names together: makes sure that all was written,
  /// and says what is to be done. What then lies under the temporary name is removed when this is destroyed.
  FileSwap finished();

private:
  bool take(const std::filesystem::path& part);

  std::filesystem::path target;
  MadeFolders folders; ///< after the file below is gone
  std::string shown;
  UnfinishedOutput temporary; ///< none once committed
  std::uint64_t length = 0;
  std::string failure;
  FileDescriptor file; ///< locked
};

} // namespace tilepack
