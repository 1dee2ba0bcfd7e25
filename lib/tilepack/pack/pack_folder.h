#pragma once

#include "tilepack/error/error.h"
#include "tilepack/image/file_descriptor.h"
#include "tilepack/image/file_swap.h"
#include "tilepack/pack/pack_json.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace tilepack {

/// `folder_or_json` itself, or the pack.json in it if it is a folder.
std::filesystem::path pack_json_of(const std::filesystem::path& folder_or_json);

/// The folder that holds `pack_json`, "." for a bare name.
std::filesystem::path folder_of(const std::filesystem::path& pack_json);

/// What a pack is called: as the folder that holds it, wherever that lies. Shaders and pages name it so.
std::string pack_name(const std::filesystem::path& folder_or_json);

/// A pack folder held open, and every file that its pack.json names: whoever replaces the pack meanwhile, what is
/// read here is the pack that was there when it was opened, all of it.
///
/// Opening begins again when the pack is replaced in that moment, waits for a writer that has to move files one
/// by one, and puts back what a writer left that was killed doing so.
class PackFolder {
public:
  /// Throws Error: cannot_read if pack.json is missing, no plain file or unreadable, or half of the files are
  /// another pack's; invalid_content if it is longer than 16 MiB.
  explicit PackFolder(const std::filesystem::path& folder_or_json);

  const std::filesystem::path& json_path() const { return json; } ///< as given; for messages
  const std::string& json_text() const { return text; }

  /// What pack.json says. Throws Error (invalid_content) as parsed_pack_json() does.
  const PackDescription& description() const;

  /// Where to read the file that pack.json calls `name`: a path that leads to it whatever becomes of the
  /// folder's name. Throws Error: cannot_read if there is no such file, invalid_content if it is no plain file or
  /// a symbolic link leads out of the folder.
  std::filesystem::path file(const std::string& name) const;

  /// `error` about such a path, naming the file as the user knows it.
  Error named(const Error& error, const std::string& name) const;

  /// The names of all that lies in the folder, folders with a '/' at the end, in order. What is within folders
  /// is not listed. Empty if the folder can't be listed.
  std::vector<std::string> entries() const;

  /// The bytes of each of `files` that is there.
  std::map<std::string, std::uint64_t> bytes_of(std::span<const std::string> files) const;

  /// Whether what was read since may be of two packs: the pack was replaced, and its files couldn't all be held
  /// (they are more than a process may open, or pack.json names none).
  bool is_stale() const;

private:
  bool open();
  void hold(const std::vector<std::string>& names);
  bool leads_elsewhere() const;
  bool json_was_moved() const;
  std::filesystem::path root() const;

  std::filesystem::path json, folder; // as given
  FileDescriptor opened, opened_json;
  std::string text;
  std::optional<PackDescription> described_pack;
  std::optional<Error> fault; // of the description
  std::map<std::string, FileDescriptor> held;
  bool holds_all = false;
};

[[noreturn]] void throw_replaced_again_and_again(const std::filesystem::path& folder);

/// What `work` makes of the pack; begun again if what it read was of two packs. `work` gets the folder and has no
/// other effect than what it returns or throws. Throws what `work` throws, and Error (cannot_read) if the pack is
/// replaced each time.
template <typename Work>
auto reading_pack(const std::filesystem::path& folder_or_json, Work work) {
  constexpr int most_attempts = 100;
  for (int attempt = 0; attempt < most_attempts; ++attempt) {
    const PackFolder folder(folder_or_json);
    try {
      auto result = work(folder);
      if (!folder.is_stale()) return result;
    } catch (const Error&) {
      if (!folder.is_stale()) throw;
    }
  }
  throw_replaced_again_and_again(folder_or_json);
}

} // namespace tilepack
