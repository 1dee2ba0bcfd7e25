#include "tilepack/pack/staged_folder.h"

#include "tilepack/error/error.h"

#include <fmt/format.h>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace tilepack {

namespace fs = std::filesystem;

namespace {

Error refused(const fs::path& where, const std::error_code& reason) {
  return Error(ErrorKind::cannot_write, where.string(),
               reason.message() + "; check the path, its permissions and the free space");
}

} // namespace

StagedFolder::StagedFolder(const fs::path& target) : folder(target), staging(target / ".tilepack-staging") {
  retired = staging / "retired";
  std::error_code fault;
  const fs::file_status status = fs::status(folder, fault);
  if (fs::exists(status) && !fs::is_directory(status))
    throw Error(ErrorKind::cannot_write, folder.string(), "is no folder; name another one");
  try {
    std::vector<fs::path> missing;
    for (fs::path f = fs::absolute(folder).lexically_normal(); !f.empty() && !fs::exists(f, fault);
         f = f.parent_path())
      missing.push_back(f);
    for (auto f = missing.rbegin(); f != missing.rend(); ++f)
      if (fs::create_directory(*f)) made_folders.push_back(*f);
    // The lock goes with the process, so what lies in the staging folder once it is ours was left by one
    // that was killed. File systems without locks are used without.
    lock = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (lock >= 0 && flock(lock, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
      close(lock);
      lock = -1;
      throw Error(ErrorKind::cannot_write, folder.string(),
                  "another process is writing a pack here; wait for it");
    }
    fs::remove_all(staging);
    fs::create_directory(staging);
    fs::create_directory(retired);
  } catch (const fs::filesystem_error& error) {
    undo();
    throw refused(folder, error.code());
  }
}

void StagedFolder::commit(const std::vector<std::string>& new_files,
                          const std::vector<std::string>& old_files) {
  const auto move = [this](const fs::path& from, const fs::path& to) {
    fs::rename(from, to);
    moves.emplace_back(from, to);
  };
  try {
    for (std::size_t i = 0; i < old_files.size(); ++i) {
      const fs::path old_file = folder / old_files[i];
      if (fs::is_regular_file(fs::symlink_status(old_file))) move(old_file, retired / std::to_string(i));
    }
    for (const std::string& name : new_files) {
      const fs::path target = folder / name;
      if (fs::exists(fs::symlink_status(target)))
        throw Error(ErrorKind::cannot_write, target.string(),
                    "is in the way and no part of the pack here; move it or choose another folder");
      move(staging / name, target);
    }
  } catch (const fs::filesystem_error& error) {
    throw refused(folder, error.code());
  }
  committed = true;
}

StagedFolder::~StagedFolder() {
  undo();
}

// Runs on every way out, so nothing here may throw; what can't be undone is left in the staging folder.
void StagedFolder::undo() {
  std::error_code unused;
  if (!committed) {
    bool all_back = true;
    for (auto m = moves.rbegin(); m != moves.rend(); ++m) {
      fs::rename(m->second, m->first, unused);
      if (unused) all_back = false;
    }
    moves.clear();
    if (!all_back) return;
  }
  fs::remove_all(staging, unused);
  if (!committed)
    for (auto f = made_folders.rbegin(); f != made_folders.rend(); ++f) fs::remove(*f, unused);
  made_folders.clear();
  if (lock >= 0) close(lock);
  lock = -1;
}

} // namespace tilepack
