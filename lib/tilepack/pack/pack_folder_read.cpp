#include "tilepack/pack/pack_folder_read.h"

#include "tilepack/error/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

namespace tilepack {

namespace fs = std::filesystem;

namespace {

constexpr std::uintmax_t largest_json = std::uintmax_t{16} << 20;

} // namespace

fs::path folder_of(const fs::path& pack_json) {
  return pack_json.has_parent_path() ? pack_json.parent_path() : fs::path(".");
}

std::string pack_json_text(const fs::path& pack_json) {
  std::error_code fault;
  const fs::file_status status = fs::status(pack_json, fault);
  if (!fs::exists(status))
    throw Error(ErrorKind::cannot_read, pack_json.string(),
                "there is no such file; a pack is a folder with a pack.json");
  if (!fs::is_regular_file(status))
    throw Error(ErrorKind::cannot_read, pack_json.string(), "is no plain file");
  if (pack_json.extension() != ".json")
    throw Error(ErrorKind::cannot_read, pack_json.string(),
                "is no pack; name the pack's folder or its pack.json");
  const std::uintmax_t size = fs::file_size(pack_json, fault);
  if (!fault && size > largest_json)
    throw Error(ErrorKind::invalid_content, pack_json.string(),
                fmt::format("is {} bytes long; a pack.json has at most {}", size, largest_json));
  std::ifstream stream(pack_json, std::ios::binary);
  std::string text(fault ? 0 : static_cast<std::size_t>(size), '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (fault || !stream)
    throw Error(ErrorKind::cannot_read, pack_json.string(), "can't be read; check its permissions");
  return text;
}

std::vector<std::string> folder_entries(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code fault;
  for (fs::directory_iterator entry(folder, fault), end; !fault && entry != end; entry.increment(fault)) {
    std::error_code unknown;
    names.push_back(entry->path().filename().string() + (entry->is_directory(unknown) ? "/" : ""));
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::map<std::string, std::uint64_t> bytes_of_files(const fs::path& folder,
                                                    std::span<const std::string> files) {
  std::map<std::string, std::uint64_t> bytes;
  for (const std::string& file : files) {
    std::error_code missing;
    const auto size = fs::file_size(folder / file, missing);
    if (!missing) bytes[file] = size;
  }
  return bytes;
}

} // namespace tilepack
