#include "tilepack/pack/file_name.h"

#include "tilepack/error/error.h"
#include "tilepack/tileset/limits.h"

#include <algorithm>

namespace tilepack {

namespace fs = std::filesystem;

std::string file_name_fault(std::string_view name) {
  if (name.empty()) return "is empty";
  if (name.front() == '/') return "is an absolute path";
  if (name.find('\\') != std::string_view::npos) return "holds a backslash";
  if (name.find(':') != std::string_view::npos) return "holds a colon";
  if (std::any_of(name.begin(), name.end(),
                  [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }))
    return "holds a control character";
  for (std::size_t start = 0; start <= name.size();) {
    const std::size_t end = std::min(name.find('/', start), name.size());
    const std::string_view part = name.substr(start, end - start);
    if (part == "..") return "leads out of the folder";
    if (part.empty() || part == ".") return "has an empty part";
    start = end + 1;
  }
  return "";
}

bool is_map_name(std::string_view name) {
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  };
  return !name.empty() && name.size() <= limits::longest_map_name &&
         std::all_of(name.begin(), name.end(), allowed);
}

fs::path inside_folder(const fs::path& folder, const std::string& name) {
  const fs::path file = folder / name;
  std::error_code fault;
  const fs::file_status status = fs::status(file, fault);
  if (!fs::exists(status))
    throw Error(ErrorKind::cannot_read, file.string(), "the pack names this file, but it is not there");
  if (!fs::is_regular_file(status))
    throw Error(ErrorKind::invalid_content, file.string(), "is no plain file; a pack holds only image files");
  const fs::path root = fs::canonical(folder, fault);
  const fs::path resolved = fs::canonical(file, fault);
  const auto [end_of_root, unused] =
      std::mismatch(root.begin(), root.end(), resolved.begin(), resolved.end());
  if (fault || end_of_root != root.end())
    throw Error(ErrorKind::invalid_content, file.string(),
                "a symbolic link leads out of the pack's folder; copy the file into it");
  return file;
}

} // namespace tilepack
