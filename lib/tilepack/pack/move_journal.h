#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tilepack {

/// What is about to be moved within and into `folder`, written down in `container` before the first move, so
/// that whoever comes after a killed process can undo it.
struct MoveJournal {
  std::filesystem::path folder;
  std::filesystem::path container;
  std::vector<std::string> old_files; ///< folder/NAME to container/retired/INDEX
  std::vector<std::string> new_files; ///< container/new/NAME to folder/NAME

  std::filesystem::path retired(std::size_t index) const {
    return container / "retired" / std::to_string(index);
  }
  std::filesystem::path staged(const std::string& name) const { return container / "new" / name; }

  /// Throws std::filesystem::filesystem_error.
  void write() const;

  /// The journal in `container`; empty if there is none.
  static MoveJournal read(const std::filesystem::path& folder, const std::filesystem::path& container);

  /// Undoes the moves that were made, the last first. False if one can't be undone.
  bool roll_back() const;

  /// From now on there is nothing to undo.
  void remove() const;
};

} // namespace tilepack
