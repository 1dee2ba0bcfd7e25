#include "tilepack/pack/staged_folder.h"

#include "tilepack/error/error.h"
#include "tilepack/pack/move_journal.h"
#include "tilepack/pack/staging_container.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/xattr.h>
#include <unistd.h>

namespace tilepack {

namespace fs = std::filesystem;

namespace {

Error refused(const fs::path& where, const std::error_code& reason) {
  if (where.is_relative() && current_folder_was_removed())
    return Error(ErrorKind::cannot_write, where.string(),
                 "the current folder was removed; go to one that is there");
  return Error(ErrorKind::cannot_write, where.string(),
               reason.message() + "; check the path, its permissions and the free space");
}

std::error_code last_error() {
  return {errno, std::system_category()};
}

/// Why another folder can't take the place of this one, as the end of a sentence; empty if it can.
std::string fault_of_place(const fs::path& folder) {
  if (!folder.has_parent_path() || folder == folder.parent_path()) return "is the root of all folders";
  if (!fs::exists(folder)) return "";
  struct statx status {
  }, parent{};
  if (::statx(AT_FDCWD, folder.c_str(), 0, STATX_BASIC_STATS, &status) != 0 ||
      ::statx(AT_FDCWD, folder.parent_path().c_str(), 0, STATX_BASIC_STATS, &parent) != 0)
    return "can't be looked at";
  if ((status.stx_attributes & STATX_ATTR_MOUNT_ROOT) != 0 || status.stx_dev_major != parent.stx_dev_major ||
      status.stx_dev_minor != parent.stx_dev_minor)
    return "is a mount point";
  std::error_code fault;
  const fs::path here = fs::current_path(fault);
  // A shell that sits in it would sit in a folder without a name.
  if (!fault && std::mismatch(folder.begin(), folder.end(), here.begin(), here.end()).first == folder.end())
    return "is the current folder or around it";
  return "";
}

bool has_access_list(const fs::path& folder) {
  for (const char* list : {"system.posix_acl_access", "system.posix_acl_default"})
    if (::getxattr(folder.c_str(), list, nullptr, 0) > 0) return true;
  return false;
}

/// Gives `to` the owner and permissions of `from`. False if that can't be, or if there is more than that.
bool take_over_access(const fs::path& from, const fs::path& to) {
  struct stat old {
  }, made{};
  if (::stat(from.c_str(), &old) != 0 || ::stat(to.c_str(), &made) != 0) return false;
  if (has_access_list(from)) return false;
  if ((old.st_uid != made.st_uid || old.st_gid != made.st_gid) &&
      ::chown(to.c_str(), old.st_uid, old.st_gid) != 0)
    return false;
  return ::chmod(to.c_str(), old.st_mode & 07777) == 0;
}

/// Files that are made in `to` get the group that they would get in `from`, if its set-group-id bit gives one.
void take_over_group(const fs::path& from, const fs::path& to) {
  struct stat old {
  }, made{};
  if (::stat(from.c_str(), &old) != 0 || (old.st_mode & S_ISGID) == 0 || ::stat(to.c_str(), &made) != 0)
    return;
  if (::chown(to.c_str(), static_cast<uid_t>(-1), old.st_gid) == 0)
    ::chmod(to.c_str(), (made.st_mode & 07777) | S_ISGID);
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
    recover_left_over(folder, container_beside(folder));
    recover_left_over(folder, container_within(folder));
    make_parents();
    choose_container();
    recover(folder, container); // in case another process was faster, and killed
    staging = container / "new";
    fs::create_directory(staging);
    take_over_group(folder, staging);
  } catch (const fs::filesystem_error& error) {
    clean_up();
    throw refused(target, error.code());
  } catch (const Error& error) {
    clean_up();
    throw Error(error.kind(), target.string(), error.what());
  }
}

void StagedFolder::make_folder(const fs::path& path) {
  const StepOnDisk step;
  if (!fs::create_directory(path)) return;
  made_folders.push_back(path);
  unfinished.emplace_back(path, UnfinishedOutput::Content::anybodys);
}

void StagedFolder::make_parents() {
  std::vector<fs::path> missing;
  for (fs::path f = folder.parent_path(); !f.empty() && !fs::exists(f); f = f.parent_path())
    missing.push_back(f);
  for (auto f = missing.rbegin(); f != missing.rend(); ++f) make_folder(*f);
}

void StagedFolder::choose_container() {
  const bool exists = fs::exists(folder);
  // A folder may forbid changes to what is in it and yet be replaced as a whole; that is not what was meant.
  if (exists && ::access(folder.c_str(), W_OK | X_OK) != 0)
    throw fs::filesystem_error("access", folder, last_error());
  const StepOnDisk step;
  const auto take = [this](const fs::path& where) {
    lock = locked_container(where);
    container = where;
    unfinished.emplace_back(where);
  };
  std::error_code fault;
  if (fault_of_place(folder).empty()) {
    const bool made = fs::create_directory(container_beside(folder), fault);
    try {
      if (!fault) return take(container_beside(folder));
    } catch (...) { // no file descriptor left, say
      if (made) fs::remove(container_beside(folder), fault);
      throw;
    }
  }
  if (!exists) make_folder(folder);
  take(container_within(folder));
}

void StagedFolder::commit(const std::vector<std::string>& new_files,
                          const std::vector<std::string>& old_files, std::span<const FileSwap> beside) {
  for (const std::string& name : new_files)
    if (!is_among(old_files, name) && fs::exists(fs::symlink_status(folder / name)))
      throw Error(ErrorKind::cannot_write, (target / name).string(),
                  "is in the way and no part of the pack here; move it or choose another folder");
  StepOnDisk step;
  try {
    if (container == container_within(folder) || !exchange(old_files, beside))
      move_one_by_one(new_files, old_files, beside);
  } catch (const fs::filesystem_error& error) {
    throw refused(target, error.code());
  }
  committed = true;
  step.puts_in_place();
  const MoveJournal done{folder, container, {}, {}, {beside.begin(), beside.end()}};
  done.drop_parts();
  done.remove();
}

// False if the folder as a whole can't be replaced; nothing has happened then.
bool StagedFolder::exchange(const std::vector<std::string>& old_files, std::span<const FileSwap> beside) {
  const bool exists = fs::exists(folder);
  if (exists) {
    for (const auto& entry : fs::directory_iterator(folder)) {
      if (entry.is_directory() && !entry.is_symlink()) return false;
      const fs::path name = entry.path().filename();
      if (!is_among(old_files, name) &&
          ::linkat(AT_FDCWD, entry.path().c_str(), AT_FDCWD, (staging / name).c_str(), 0) != 0)
        return false;
    }
    if (!take_over_access(folder, staging)) return false;
  }
  const MoveJournal journal{folder, container, {}, {}, {beside.begin(), beside.end()}, file_id(staging)};
  if (!beside.empty()) journal.write();
  for (const FileSwap& swap : beside) put_in_place(swap, swap.target.string());
  // A new folder: not over anything but an empty one.
  const int result = exists
                         ? ::renameat2(AT_FDCWD, staging.c_str(), AT_FDCWD, folder.c_str(), RENAME_EXCHANGE)
                         : ::rename(staging.c_str(), folder.c_str());
  if (result != 0) {
    journal.roll_back();
    journal.remove();
    return false;
  }
  // What came into the old folder since it was read.
  std::error_code unused;
  for (auto entry = fs::directory_iterator(staging, unused);
       exists && !unused && entry != fs::directory_iterator(); entry.increment(unused)) {
    const fs::path name = entry->path().filename();
    if (!is_among(old_files, name))
      ::renameat2(AT_FDCWD, entry->path().c_str(), AT_FDCWD, (folder / name).c_str(), RENAME_NOREPLACE);
  }
  return true;
}

void StagedFolder::move_one_by_one(const std::vector<std::string>& new_files,
                                   const std::vector<std::string>& old_files,
                                   std::span<const FileSwap> beside) {
  MoveJournal journal{folder, container, {}, new_files, {beside.begin(), beside.end()}};
  for (const std::string& name : old_files)
    if (fs::is_regular_file(fs::symlink_status(folder / name))) journal.old_files.push_back(name);
  fs::create_directory(folder); // if missing
  fs::create_directory(container / "retired");
  journal.write();
  for (const FileSwap& swap : beside) put_in_place(swap, swap.target.string());
  // pack.json, the last of both, goes first and comes last: meanwhile nothing looks like a pack.
  for (std::size_t i = journal.old_files.size(); i-- > 0;)
    fs::rename(folder / journal.old_files[i], journal.retired(i));
  for (const std::string& name : new_files) fs::rename(staging / name, folder / name);
  journal.remove(); // with this it is done
}

StagedFolder::~StagedFolder() {
  clean_up();
}

// Runs on every way out, so nothing here may throw; what can't be undone is left in the container.
void StagedFolder::clean_up() {
  std::error_code unused;
  bool all_back = true;
  if (lock) {
    if (!committed) all_back = MoveJournal::read(folder, container).roll_back();
    if (all_back) fs::remove_all(container, unused);
    std::error_code fault;
    if (all_back && fs::exists(container, fault) && !fault) {
      // To remove a folder takes file descriptors. Under a name that nobody looks for it needs no lock.
      const fs::path aside =
          container.parent_path() / fmt::format("{}.{}", container.filename().string(), ::getpid());
      fs::rename(container, aside, fault);
      lock.close();
      if (!fault) fs::remove_all(aside, unused);
    }
    lock.close();
  }
  if (!committed && all_back)
    for (auto f = made_folders.rbegin(); f != made_folders.rend(); ++f) fs::remove(*f, unused);
  made_folders.clear();
  unfinished.clear();
}

std::string moved_one_by_one(const fs::path& given) {
  std::error_code fault;
  fs::path folder = fs::weakly_canonical(fs::absolute(given, fault), fault);
  if (folder.filename().empty()) folder = folder.parent_path(); // "pack/"
  if (fault || !fs::is_directory(folder, fault)) return "";
  if (std::string place = fault_of_place(folder); !place.empty()) return place;
  if (::access(folder.parent_path().c_str(), W_OK | X_OK) != 0)
    return "lies in a folder that can't be written to";
  if (has_access_list(folder)) return "has an access list";
  for (auto entry = fs::directory_iterator(folder, fault); !fault && entry != fs::directory_iterator();
       entry.increment(fault))
    if (entry->is_directory(fault) && !entry->is_symlink(fault)) return "has folders in it";
  struct stat status {};
  if (::geteuid() != 0 && ::stat(folder.c_str(), &status) == 0 && status.st_uid != ::geteuid())
    return "belongs to another user";
  return "";
}

} // namespace tilepack
