#include "tilepack/pack/staging_container.h"

#include "tilepack/error/error.h"
#include "tilepack/image/file_swap.h"
#include "tilepack/pack/move_journal.h"

#include <fmt/format.h>

#include <cerrno>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <system_error>

namespace tilepack {

namespace fs = std::filesystem;

namespace {

enum class Lock { held, busy, gone };

/// A lock on the folder `container`. It goes with the process, so what lies in a container that can be locked
/// was left by one that was killed. File systems without locks are used without.
Lock try_lock(const fs::path& container, FileDescriptor& lock) {
  lock = FileDescriptor(::open(container.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC | O_NOFOLLOW));
  if (!lock) {
    if (errno == ENOENT) return Lock::gone;
    throw fs::filesystem_error("open", container, {errno, std::system_category()});
  }
  if (::flock(lock.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) return Lock::busy;
  // Who had the lock may have removed the folder since.
  struct stat opened {};
  const bool same =
      ::fstat(lock.get(), &opened) == 0 && file_id(container) == FileId{opened.st_dev, opened.st_ino};
  return same ? Lock::held : Lock::gone;
}

} // namespace

fs::path container_beside(const fs::path& folder) {
  return folder.parent_path() / hidden_name(folder.filename().string(), "tilepack-staging");
}

fs::path container_within(const fs::path& folder) {
  return folder / ".tilepack-staging";
}

FileDescriptor locked_container(const fs::path& container) {
  FileDescriptor lock;
  for (int attempt = 0; attempt < 100; ++attempt) {
    const bool made = fs::create_directory(container);
    Lock state = Lock::gone;
    try {
      state = try_lock(container, lock);
    } catch (...) { // no file descriptor left, say
      std::error_code ignored;
      if (made) fs::remove(container, ignored);
      throw;
    }
    if (state == Lock::held) return lock;
    if (state == Lock::busy)
      throw Error(ErrorKind::cannot_write, "", "another process is writing a pack here; wait for it");
  }
  throw fs::filesystem_error("lock", container, std::error_code(EBUSY, std::system_category()));
}

void recover(const fs::path& folder, const fs::path& container) {
  const MoveJournal journal = MoveJournal::read(folder, container);
  if (!journal.is_complete() && !journal.roll_back())
    throw Error(
        ErrorKind::cannot_write, "",
        fmt::format("a writer was killed here, and the files it moved to {} can't be moved back; do so "
                    "by hand",
                    container.string()));
  journal.drop_parts();
  journal.remove();
  for (const auto& entry : fs::directory_iterator(container)) fs::remove_all(entry.path());
}

void recover_left_over(const fs::path& folder, const fs::path& container) {
  if (!fs::exists(fs::symlink_status(container))) return;
  FileDescriptor lock;
  if (try_lock(container, lock) != Lock::held) return;
  recover(folder, container);
  fs::remove(container);
}

FolderState settle(const fs::path& folder) {
  for (const fs::path& container : {container_beside(folder), container_within(folder)}) {
    const bool moving = MoveJournal::read(folder, container).moves_one_by_one();
    if (!moving && !MoveJournal::is_there(container)) continue;
    try {
      FileDescriptor lock;
      const Lock state = try_lock(container, lock);
      if (state == Lock::busy && moving) return FolderState::in_between;
      if (state == Lock::held) {
        recover(folder, container);
        fs::remove(container);
      }
    } catch (const std::exception& fault) {
      if (moving)
        throw Error(
            ErrorKind::cannot_read, folder.string(),
            fmt::format("a writer was killed while it replaced this pack, and what it left can't be put "
                        "right ({}); bake the pack again, or give the permission to write",
                        fault.what()));
    }
  }
  return FolderState::whole;
}

} // namespace tilepack
