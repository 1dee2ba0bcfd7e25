#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tilepack {

/// Patterns of paths: `*` any letters within a name, `?` one of them, `[a-c]` one of a list, and `**` as a whole
/// name for any folders, none too. A name that begins with a dot is matched only by a pattern that begins so.
bool is_pattern(std::string_view text);

/// Whether `path` matches, name by name.
bool matches(std::string_view pattern, std::string_view path);

/// What is found on disk.
struct PatternMatches {
  std::vector<std::string> paths;   ///< in order of their bytes; files and folders
  std::vector<std::string> folders; ///< that were looked through: a new match shows in one of them
};

/// `pattern` may be absolute, else it is meant from the current folder. Folders that can't be listed hold nothing.
PatternMatches paths_matching(const std::string& pattern);

} // namespace tilepack
