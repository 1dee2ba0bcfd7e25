#include "tilepack/batch/entry_choice.h"

#include "tilepack/bake/field_value.h"
#include "tilepack/batch/content_hash.h"
#include "tilepack/batch/path_pattern.h"
#include "tilepack/error/error.h"
#include "tilepack/error/nearest_name.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace tilepack {
namespace {

struct Part {
  std::int64_t number = 1; // from 1
  std::int64_t parts = 1;
};

Part parsed_part(const std::string& text) {
  constexpr std::int64_t most = 1'000'000;
  if (text.empty()) return {};
  Part part;
  const std::size_t slash = std::min(text.find('/'), text.size());
  const std::string_view whole = text;
  if (slash == text.size() || !parse_whole(whole.substr(slash + 1), 1, most, part.parts) ||
      !parse_whole(whole.substr(0, slash), 1, part.parts, part.number))
    throw Error(ErrorKind::usage, field("shard"),
                fmt::format("'{}' is not allowed; it must be I/N with 1 <= I <= N <= {}", text, most));
  return part;
}

// Relative to the manifest, so that it is the same wherever that lies.
std::string written_output(const Manifest& manifest, const BatchEntry& entry) {
  const std::filesystem::path folder = std::filesystem::path(manifest.file).parent_path();
  return std::filesystem::path(entry.output)
      .lexically_relative(folder.empty() ? "." : folder)
      .generic_string();
}

std::int64_t part_of(const Manifest& manifest, std::size_t entry, std::int64_t parts) {
  while (!manifest.entries[entry].after.empty()) entry = manifest.entries[entry].after.front();
  const ContentHash hash = hash_of(written_output(manifest, manifest.entries[entry]));
  return 1 + static_cast<std::int64_t>(hash.low % static_cast<std::uint64_t>(parts));
}

bool is_asked_for(const BatchEntry& entry, const std::string& only) {
  return entry.name == only || (is_pattern(only) && matches(only, entry.name));
}

} // namespace

std::vector<std::size_t> chosen_entries(const Manifest& manifest, std::span<const std::string> only,
                                        const std::string& shard) {
  const Part part = parsed_part(shard);
  for (const std::string& name : only) {
    const auto& entries = manifest.entries;
    if (std::any_of(entries.begin(), entries.end(),
                    [&](const BatchEntry& entry) { return is_asked_for(entry, name); }))
      continue;
    std::vector<std::string> known;
    std::string nearest; // "sand" means packs/sand
    for (const BatchEntry& entry : entries) {
      known.push_back(entry.name);
      if (nearest.empty() && std::filesystem::path(entry.name).stem() == name) nearest = entry.name;
    }
    if (nearest.empty()) nearest = nearest_name(name, known);
    throw Error(ErrorKind::usage, field("only"),
                fmt::format("'{}' is no entry of {}{}", name, manifest.file,
                            nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest)));
  }
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < manifest.entries.size(); ++i) {
    const BatchEntry& entry = manifest.entries[i];
    const bool asked = only.empty() || std::any_of(only.begin(), only.end(), [&](const std::string& name) {
                         return is_asked_for(entry, name);
                       });
    if (asked && (part.parts == 1 || part_of(manifest, i, part.parts) == part.number)) chosen.push_back(i);
  }
  return chosen;
}

std::string target_of(const BatchEntry& entry) {
  if (entry.verb->output != BatchOutput::pack) return entry.output;
  return (std::filesystem::path(entry.output) / "pack.json").string();
}

} // namespace tilepack
