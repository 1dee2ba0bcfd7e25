#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tilepack {

/// Replaces a set of files in a folder, all of them or none.
///
///   StagedFolder staged(folder);          // made if missing; locked against other writers
///   … write every file into staged.path() …
///   staged.commit(new_files, old_files);  // old ones out, new ones in, the last of new_files last
///
/// The staging folder `.tilepack-staging` lies inside `folder`, so that moving a file into place is a rename
/// within one file system even where `folder` is a mount point. A failing commit puts back what it moved.
/// Destroyed without commit(), everything is as before, folders made for it included.
/// All functions throw Error (cannot_write).
class StagedFolder {
public:
  explicit StagedFolder(const std::filesystem::path& folder);
  ~StagedFolder();
  StagedFolder(const StagedFolder&) = delete;
  StagedFolder& operator=(const StagedFolder&) = delete;

  const std::filesystem::path& path() const { return staging; }

  /// Moves the staged `new_files` into the folder in their order, after moving `old_files` out (those that
  /// are there). Refuses to replace a file that is not among the old ones. Names are relative to the folder.
  void commit(const std::vector<std::string>& new_files, const std::vector<std::string>& old_files);

private:
  void undo();

  std::filesystem::path folder;
  std::filesystem::path staging;
  std::filesystem::path retired;                   // where old files wait until the commit is complete
  std::vector<std::filesystem::path> made_folders; // outermost first
  std::vector<std::pair<std::filesystem::path, std::filesystem::path>> moves; // from, to
  bool committed = false;
  int lock = -1;
};

} // namespace tilepack
