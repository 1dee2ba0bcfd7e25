#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace tilepack {

/// What a file or folder is by the system's numbers, whatever it is called.
struct FileId {
  std::uint64_t device = 0;
  std::uint64_t number = 0;
  bool operator==(const FileId&) const = default;
};

/// Of what has this name, which may be a link; nothing if there is none.
std::optional<FileId> file_id(const std::filesystem::path& file);

/// Relative names lead nowhere then.
bool current_folder_was_removed();

/// A finished file that waits under the name `part` to become `target`. As data, so that what was begun can be
/// written down, and undone by another process.
struct FileSwap {
  std::filesystem::path target; ///< both absolute, in one folder
  std::filesystem::path part;
  FileId id;             ///< of the new file
  bool replaces = false; ///< there is an older file of the name
};

/// Gives the new file its name. An older one waits as `part`, where the file system can exchange names, and is
/// gone where it can't. Throws Error (cannot_write), naming `shown`.
void put_in_place(const FileSwap& swap, const std::string& shown);

/// Undoes that, if it was done and `target` is still the new file: the older one is back, or there is none.
void take_back(const FileSwap& swap) noexcept;

/// Removes what waits as `part`.
void drop_part(const FileSwap& swap) noexcept;

/// A name for what lies beside `name` for a while: ".NAME.SUFFIX", shortened where file systems take no more.
/// The same for the same arguments.
std::string hidden_name(const std::string& name, std::string_view suffix);

/// What temporary files of a target are called: ".NAME.0.part" and on, up to `most_parts`.
std::string part_name(const std::string& name, int number);
constexpr int most_parts = 1000;

} // namespace tilepack
