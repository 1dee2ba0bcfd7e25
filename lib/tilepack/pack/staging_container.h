#pragma once

#include "tilepack/image/file_descriptor.h"

#include <filesystem>

namespace tilepack {

/// Where the files of a folder wait until they are put in place: a folder beside it, `.NAME.tilepack-staging`,
/// or within it, `.tilepack-staging`. Locked while a writer is at work. `folder` is absolute and canonical.
std::filesystem::path container_beside(const std::filesystem::path& folder);
std::filesystem::path container_within(const std::filesystem::path& folder);

/// Makes the container and locks it. Throws Error (cannot_write), naming nothing, if another process holds it,
/// and std::filesystem::filesystem_error.
FileDescriptor locked_container(const std::filesystem::path& container);

/// Undoes what a killed process left half done in `container`, whose lock is held, or completes it, and empties
/// it. Throws Error (cannot_write) if files can't be moved back.
void recover(const std::filesystem::path& folder, const std::filesystem::path& container);

/// The same with a container that may be there and may be locked; removes it if it is nobody's any more.
void recover_left_over(const std::filesystem::path& folder, const std::filesystem::path& container);

/// How the files of `folder` stand for whoever wants to read them.
enum class FolderState {
  whole,      ///< as a writer left them
  in_between, ///< a writer is moving them one by one this moment
};

/// Puts right what a killed writer left, so far as that matters for reading. Throws Error (cannot_read) if the
/// files are half old and half new and can't be moved back.
FolderState settle(const std::filesystem::path& folder);

} // namespace tilepack
