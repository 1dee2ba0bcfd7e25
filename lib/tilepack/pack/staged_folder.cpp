#include "tilepack/pack/staged_folder.h"

#include "tilepack/error/error.h"
#include "tilepack/pack/move_journal.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/xattr.h>
#include <unistd.h>

namespace tilepack {

namespace fs = std::filesystem;

namespace {

Error refused(const fs::path& where, const std::error_code& reason) {
  return Error(ErrorKind::cannot_write, where.string(),
               reason.message() + "; check the path, its permissions and the free space");
}

std::error_code last_error() {
  return {errno, std::system_category()};
}

/// A lock on the folder `container`, which exists then; -1 if it went away meanwhile. The lock goes with the
/// process, so what lies in a container that can be locked was left by one that was killed.
int locked(const fs::path& container) {
  const int descriptor = ::open(container.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC | O_NOFOLLOW);
  if (descriptor < 0) {
    if (errno == ENOENT) return -1;
    throw fs::filesystem_error("open", container, last_error());
  }
  const bool busy = ::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  // File systems without locks are used without. Who had the lock may have removed the folder since.
  struct stat opened {
  }, named{};
  const bool same = ::fstat(descriptor, &opened) == 0 && ::lstat(container.c_str(), &named) == 0 &&
                    opened.st_ino == named.st_ino && opened.st_dev == named.st_dev;
  if (!busy && same) return descriptor;
  ::close(descriptor);
  if (busy) throw Error(ErrorKind::cannot_write, "", "another process is writing a pack here; wait for it");
  return -1;
}

/// Undoes what a killed process left half done in `container`, and empties it. Its lock is held.
void recover(const fs::path& folder, const fs::path& container) {
  const MoveJournal journal = MoveJournal::read(folder, container);
  if (!journal.roll_back())
    throw Error(
        ErrorKind::cannot_write, "",
        fmt::format("a writer was killed here, and the files it moved to {} can't be moved back; do so "
                    "by hand",
                    container.string()));
  journal.remove();
  for (const auto& entry : fs::directory_iterator(container)) fs::remove_all(entry.path());
}

/// Recovers what another process left, if any.
void recover_left_over(const fs::path& folder, const fs::path& container) {
  if (!fs::exists(fs::symlink_status(container))) return;
  const int lock = locked(container);
  if (lock < 0) return;
  try {
    recover(folder, container);
    fs::remove(container);
  } catch (...) {
    ::close(lock);
    throw;
  }
  ::close(lock);
}

fs::path sibling_container(const fs::path& folder) {
  return folder.parent_path() / fmt::format(".{}.tilepack-staging", folder.filename().string());
}

fs::path inner_container(const fs::path& folder) {
  return folder / ".tilepack-staging";
}

/// Whether another folder can take the place of this one: it is no mount point, and no shell sits in it.
bool is_replaceable(const fs::path& folder) {
  if (!folder.has_parent_path() || folder == folder.parent_path()) return false;
  if (!fs::exists(folder)) return true;
  struct statx status {
  }, parent{};
  if (::statx(AT_FDCWD, folder.c_str(), 0, STATX_BASIC_STATS, &status) != 0 ||
      ::statx(AT_FDCWD, folder.parent_path().c_str(), 0, STATX_BASIC_STATS, &parent) != 0)
    return false;
  if ((status.stx_attributes & STATX_ATTR_MOUNT_ROOT) != 0 || status.stx_dev_major != parent.stx_dev_major ||
      status.stx_dev_minor != parent.stx_dev_minor)
    return false;
  std::error_code fault;
  const fs::path here = fs::current_path(fault);
  return fault || std::mismatch(folder.begin(), folder.end(), here.begin(), here.end()).first != folder.end();
}

/// Gives `to` the owner and permissions of `from`. False if that can't be, or if there is more than that.
bool take_over_access(const fs::path& from, const fs::path& to) {
  struct stat old {
  }, made{};
  if (::stat(from.c_str(), &old) != 0 || ::stat(to.c_str(), &made) != 0) return false;
  for (const char* list : {"system.posix_acl_access", "system.posix_acl_default"})
    if (::getxattr(from.c_str(), list, nullptr, 0) > 0) return false;
  if ((old.st_uid != made.st_uid || old.st_gid != made.st_gid) &&
      ::chown(to.c_str(), old.st_uid, old.st_gid) != 0)
    return false;
  return ::chmod(to.c_str(), old.st_mode & 07777) == 0;
}

bool is_among(const std::vector<std::string>& names, const fs::path& name) {
  return std::find(names.begin(), names.end(), name.string()) != names.end();
}

} // namespace

StagedFolder::StagedFolder(const fs::path& given) : target(given) {
  try {
    folder = fs::weakly_canonical(fs::absolute(target));
    if (folder.filename().empty()) folder = folder.parent_path(); // "pack/"
    const fs::file_status status = fs::status(folder);
    if (fs::exists(status) && !fs::is_directory(status))
      throw Error(ErrorKind::cannot_write, "", "is no folder; name another one");
    if (fs::is_symlink(fs::symlink_status(folder)))
      throw Error(ErrorKind::cannot_write, "", "is a link to nothing; remove it or name another folder");
    recover_left_over(folder, sibling_container(folder));
    recover_left_over(folder, inner_container(folder));
    make_parents();
    choose_container();
    recover(folder, container); // in case another process was faster, and killed
    staging = container / "new";
    fs::create_directory(staging);
  } catch (const fs::filesystem_error& error) {
    clean_up();
    throw refused(target, error.code());
  } catch (const Error& error) {
    clean_up();
    throw Error(error.kind(), target.string(), error.what());
  }
}

void StagedFolder::make_parents() {
  std::vector<fs::path> missing;
  for (fs::path f = folder.parent_path(); !f.empty() && !fs::exists(f); f = f.parent_path())
    missing.push_back(f);
  for (auto f = missing.rbegin(); f != missing.rend(); ++f)
    if (fs::create_directory(*f)) made_folders.push_back(*f);
}

void StagedFolder::choose_container() {
  const bool exists = fs::exists(folder);
  // A folder may forbid changes to what is in it and yet be replaced as a whole; that is not what was meant.
  if (exists && ::access(folder.c_str(), W_OK | X_OK) != 0)
    throw fs::filesystem_error("access", folder, last_error());
  const auto try_to_lock = [this](const fs::path& where) {
    for (int attempt = 0; attempt < 100 && lock < 0; ++attempt) {
      fs::create_directory(where);
      lock = locked(where);
    }
    if (lock < 0) throw fs::filesystem_error("lock", where, std::error_code(EBUSY, std::system_category()));
    container = where;
  };
  std::error_code fault;
  if (is_replaceable(folder)) {
    fs::create_directory(sibling_container(folder), fault);
    if (!fault) return try_to_lock(sibling_container(folder));
  }
  if (!exists && fs::create_directory(folder)) made_folders.push_back(folder);
  try_to_lock(inner_container(folder));
}

void StagedFolder::commit(const std::vector<std::string>& new_files,
                          const std::vector<std::string>& old_files) {
  for (const std::string& name : new_files)
    if (!is_among(old_files, name) && fs::exists(fs::symlink_status(folder / name)))
      throw Error(ErrorKind::cannot_write, (target / name).string(),
                  "is in the way and no part of the pack here; move it or choose another folder");
  try {
    if (container == inner_container(folder) || !exchange(old_files)) move_one_by_one(new_files, old_files);
  } catch (const fs::filesystem_error& error) {
    throw refused(target, error.code());
  }
  committed = true;
}

// False if the folder as a whole can't be replaced; nothing has happened then.
bool StagedFolder::exchange(const std::vector<std::string>& old_files) {
  if (!fs::exists(folder))
    return ::rename(staging.c_str(), folder.c_str()) == 0; // not over anything but an empty folder
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.is_directory() && !entry.is_symlink()) return false;
    const fs::path name = entry.path().filename();
    if (!is_among(old_files, name) &&
        ::linkat(AT_FDCWD, entry.path().c_str(), AT_FDCWD, (staging / name).c_str(), 0) != 0)
      return false;
  }
  if (!take_over_access(folder, staging) ||
      ::renameat2(AT_FDCWD, staging.c_str(), AT_FDCWD, folder.c_str(), RENAME_EXCHANGE) != 0)
    return false;
  // What came into the old folder since it was read.
  std::error_code unused;
  for (const auto& entry : fs::directory_iterator(staging, unused)) {
    const fs::path name = entry.path().filename();
    if (!is_among(old_files, name))
      ::renameat2(AT_FDCWD, entry.path().c_str(), AT_FDCWD, (folder / name).c_str(), RENAME_NOREPLACE);
  }
  return true;
}

void StagedFolder::move_one_by_one(const std::vector<std::string>& new_files,
                                   const std::vector<std::string>& old_files) {
  MoveJournal journal{folder, container, {}, new_files};
  for (const std::string& name : old_files)
    if (fs::is_regular_file(fs::symlink_status(folder / name))) journal.old_files.push_back(name);
  fs::create_directory(folder); // if missing
  fs::create_directory(container / "retired");
  journal.write();
  // pack.json, the last of both, goes first and comes last: meanwhile nothing looks like a pack.
  for (std::size_t i = journal.old_files.size(); i-- > 0;)
    fs::rename(folder / journal.old_files[i], journal.retired(i));
  for (const std::string& name : new_files) fs::rename(staging / name, folder / name);
  journal.remove();
}

StagedFolder::~StagedFolder() {
  clean_up();
}

// Runs on every way out, so nothing here may throw; what can't be undone is left in the container.
void StagedFolder::clean_up() {
  std::error_code unused;
  bool all_back = true;
  if (lock >= 0) {
    if (!committed) all_back = MoveJournal::read(folder, container).roll_back();
    if (all_back) fs::remove_all(container, unused);
    ::close(lock);
    lock = -1;
  }
  if (!committed && all_back)
    for (auto f = made_folders.rbegin(); f != made_folders.rend(); ++f) fs::remove(*f, unused);
  made_folders.clear();
}

} // namespace tilepack
