#include "tilepack/batch/path_pattern.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fnmatch.h>

namespace tilepack {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> names_of_path(std::string_view path) {
  std::vector<std::string> names;
  for (std::size_t at = 0; at < path.size();) {
    const std::size_t end = std::min(path.find('/', at), path.size());
    if (end > at) names.emplace_back(path.substr(at, end - at));
    at = end + 1;
  }
  return names;
}

bool name_matches(const std::string& pattern, const std::string& name) {
  return fnmatch(pattern.c_str(), name.c_str(), FNM_PERIOD) == 0;
}

bool all_match(std::span<const std::string> pattern, std::span<const std::string> names) {
  if (pattern.empty()) return names.empty();
  if (pattern.front() == "**") {
    for (std::size_t skipped = 0; skipped <= names.size(); ++skipped)
      if (all_match(pattern.subspan(1), names.subspan(skipped))) return true;
    return false;
  }
  return !names.empty() && name_matches(pattern.front(), names.front()) &&
         all_match(pattern.subspan(1), names.subspan(1));
}

std::string joined(const std::string& folder, const std::string& name) {
  return folder.empty() || folder.ends_with('/') ? folder + name : folder + "/" + name;
}

class Search {
public:
  PatternMatches found;

  // `matched`: a part of the pattern before this one matched the folder.
  void in(const std::string& folder, std::span<const std::string> pattern, bool matched = false) {
    if (pattern.empty()) {
      if (!folder.empty()) found.paths.push_back(folder);
      return;
    }
    if (pattern.front() == "**") {
      in(folder, pattern.subspan(1), true);
      for (const fs::directory_entry& entry : listed(folder)) {
        std::error_code fault;
        const std::string name = entry.path().filename().string();
        if (name.front() != '.' && entry.is_directory(fault) && !entry.is_symlink(fault))
          in(joined(folder, name), pattern, true);
      }
    } else if (!is_pattern(pattern.front())) {
      std::error_code fault;
      const std::string path = joined(folder, pattern.front());
      if (matched) found.folders.push_back(folder.empty() ? "." : folder); // where it may come to be
      if (fs::exists(path, fault)) in(path, pattern.subspan(1), matched);
    } else {
      for (const fs::directory_entry& entry : listed(folder)) {
        const std::string name = entry.path().filename().string();
        std::error_code fault;
        if (name_matches(pattern.front(), name) && (pattern.size() == 1 || entry.is_directory(fault)))
          in(joined(folder, name), pattern.subspan(1), true);
      }
    }
  }

private:
  std::vector<fs::directory_entry> listed(const std::string& folder) {
    const std::string place = folder.empty() ? "." : folder;
    found.folders.push_back(place);
    std::vector<fs::directory_entry> entries;
    std::error_code fault;
    for (fs::directory_iterator at(place, fault), end; !fault && at != end; at.increment(fault))
      entries.push_back(*at);
    return entries;
  }
};

} // namespace

bool is_pattern(std::string_view text) {
  return text.find_first_of("*?[") != std::string_view::npos;
}

bool matches(std::string_view pattern, std::string_view path) {
  return pattern.starts_with('/') == path.starts_with('/') &&
         all_match(names_of_path(pattern), names_of_path(path));
}

PatternMatches paths_matching(const std::string& pattern) {
  Search search;
  search.in(pattern.starts_with('/') ? "/" : "", names_of_path(pattern));
  for (std::vector<std::string>* list : {&search.found.paths, &search.found.folders}) {
    std::sort(list->begin(), list->end());
    list->erase(std::unique(list->begin(), list->end()), list->end());
  }
  return std::move(search.found);
}

} // namespace tilepack
