#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace tilepack {

/// The folder that holds `pack_json`, "." for a bare name.
std::filesystem::path folder_of(const std::filesystem::path& pack_json);

/// The text of a pack.json, unparsed. Throws Error: cannot_read if it is missing, no plain file or
/// unreadable; invalid_content if it is longer than 16 MiB.
std::string pack_json_text(const std::filesystem::path& pack_json);

/// The names of all that lies in `folder`, folders with a '/' at the end, in order. What is within folders is
/// not listed. Empty if the folder can't be listed.
std::vector<std::string> folder_entries(const std::filesystem::path& folder);

/// The bytes of each of `files` (relative to `folder`) that is there.
std::map<std::string, std::uint64_t> bytes_of_files(const std::filesystem::path& folder,
                                                    std::span<const std::string> files);

} // namespace tilepack
