#pragma once

#include <filesystem>
#include <vector>

namespace tilepack {

/// The folders missing on the way to an output, made when it is begun. Those that are still empty go again with
/// this, so that a failed command leaves no trace, unless keep() was called.
///
/// What can't be made stays missing: creating the output then says why.
class MadeFolders {
public:
  /// `folder`: made with all above it that is missing; empty: the current one.
  explicit MadeFolders(const std::filesystem::path& folder);
  ~MadeFolders();
  MadeFolders(const MadeFolders&) = delete;
  MadeFolders& operator=(const MadeFolders&) = delete;

  void keep() { made.clear(); }

private:
  std::vector<std::filesystem::path> made; // outermost first
};

} // namespace tilepack
