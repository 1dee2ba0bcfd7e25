#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace tilepack {

/// Why `name` can't be the name of a pack's file, as the end of a sentence ("is an absolute path"), or empty
/// if it can: relative, '/' between folders, no "." or ".." part, no backslash, no control character.
/// It is about the text alone; inside_folder() holds it against what is on disk.
std::string file_name_fault(std::string_view name);

/// True for 1 to 64 letters, digits, '-' and '_' of ASCII: what maps may be called, since files are named
/// after them on every file system.
bool is_map_name(std::string_view name);

/// folder / name, after making sure that it is a plain file and that no symbolic link leads out of `folder`.
/// Throws Error: cannot_read if there is no such file, invalid_content if it lies outside or is a folder,
/// a pipe or a device.
std::filesystem::path inside_folder(const std::filesystem::path& folder, const std::string& name);

} // namespace tilepack
