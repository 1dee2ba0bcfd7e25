#pragma once

#include "tilepack/image/file_swap.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tilepack {

/// What is about to be put in place, written down in `container` before the first step, so that whoever comes
/// after a killed process can undo it. Either the files of `folder` are moved one by one, or another folder
/// takes its place; files that lie elsewhere get their names before.
struct MoveJournal {
  std::filesystem::path folder;
  std::filesystem::path container;
  std::vector<std::string> old_files; ///< folder/NAME to container/retired/INDEX
  std::vector<std::string> new_files; ///< container/new/NAME to folder/NAME
  std::vector<FileSwap> beside = {};  ///< files of the same command that lie elsewhere
  std::optional<FileId> whole = {};   ///< the folder that takes the place of `folder`, with which all is done

  std::filesystem::path retired(std::size_t index) const {
    return container / "retired" / std::to_string(index);
  }
  std::filesystem::path staged(const std::string& name) const { return container / "new" / name; }

  /// Throws std::filesystem::filesystem_error.
  void write() const;

  /// The journal in `container`; empty if there is none.
  static MoveJournal read(const std::filesystem::path& folder, const std::filesystem::path& container);
  static bool is_there(const std::filesystem::path& container);

  /// Meanwhile `folder` may hold neither the old files nor the new ones.
  bool moves_one_by_one() const { return !old_files.empty() || !new_files.empty(); }

  /// Whether the last step was taken.
  bool is_complete() const { return whole && file_id(folder) == whole; }

  /// Undoes the steps that were taken, the last first. False if a file of `folder` can't be moved back.
  bool roll_back() const;

  /// Removes the temporary files beside the targets: the older ones when complete, else the new ones.
  void drop_parts() const;

  /// From now on there is nothing to undo.
  void remove() const;
};

} // namespace tilepack
