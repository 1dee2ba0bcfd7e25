#pragma once

#include "tilepack/image/file_descriptor.h"
#include "tilepack/image/file_swap.h"
#include "tilepack/image/unfinished_outputs.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace tilepack {

/// Replaces a set of files in a folder: all of them or none, even if the process is killed between two steps.
///
///   StagedFolder staged(folder);          // locked against other writers
///   … write every file into staged.path() …
///   staged.commit(new_files, old_files);
///
/// Files are staged in a folder beside the target, `.NAME.tilepack-staging`, and the whole folder takes the
/// target's place in one step (renameat2, RENAME_EXCHANGE), with the files of others linked into it before.
/// So the target becomes another folder of the same name, owner and permissions.
///
/// Where that can't be (moved_one_by_one() says why), files are moved one by one instead, the last of
/// `new_files` last, after what is about to happen was noted in the staging folder; if the process is killed
/// meanwhile, the next StagedFolder of this target puts everything back, and so does the next PackFolder.
///
/// Destroyed without commit(), everything is as before, folders made for it included. All functions throw
/// Error (cannot_write).
class StagedFolder {
public:
  explicit StagedFolder(const std::filesystem::path& target);
  ~StagedFolder();
  StagedFolder(const StagedFolder&) = delete;
  StagedFolder& operator=(const StagedFolder&) = delete;

  const std::filesystem::path& path() const { return staging; }

  /// What the target means, absolute and without links.
  const std::filesystem::path& final_path() const { return folder; }

  /// Takes out `old_files` (those that are there) and puts in the staged `new_files`, and before that gives
  /// the files `beside` their names. Refuses to replace a file that is not among the old ones. Names are
  /// relative to the folder.
  void commit(const std::vector<std::string>& new_files, const std::vector<std::string>& old_files,
              std::span<const FileSwap> beside = {});

private:
  void make_folder(const std::filesystem::path& path);
  void make_parents();
  void choose_container();
  bool exchange(const std::vector<std::string>& old_files, std::span<const FileSwap> beside);
  void move_one_by_one(const std::vector<std::string>& new_files, const std::vector<std::string>& old_files,
                       std::span<const FileSwap> beside);
  void clean_up();

  std::filesystem::path target;                    // as given, for messages
  std::filesystem::path folder;                    // what it means, absolute
  std::filesystem::path container;                 // holds what follows; locked
  std::filesystem::path staging;                   // where new files are written
  std::vector<std::filesystem::path> made_folders; // outermost first
  std::vector<UnfinishedOutput> unfinished;        // these and the container
  bool committed = false;
  FileDescriptor lock;
};

/// Why the files of `folder` are moved one by one when they are replaced, as the end of a sentence ("is a mount
/// point"): it is one, or the current folder, has folders in it or an access list, or its owner can't be kept
/// or its parent not written to. Empty if another folder takes its place in one step.
std::string moved_one_by_one(const std::filesystem::path& folder);

} // namespace tilepack
