#include "tilepack/batch/written_files.h"

#include "tilepack/bake/material_names.h"
#include "tilepack/bake/preset.h"
#include "tilepack/batch/build_record.h"
#include "tilepack/batch/current_index.h"
#include "tilepack/batch/entry_choice.h"
#include "tilepack/batch/entry_state.h"
#include "tilepack/error/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>

namespace tilepack {
namespace {

namespace fs = std::filesystem;

bool is_pack_entry(const BatchEntry& entry) {
  return entry.verb->output == BatchOutput::pack;
}

// Pages and pictures that options ask for.
std::vector<std::string> further_files(const BatchEntry& entry) {
  std::vector<std::string> files;
  for (const BatchOption& option : entry.options)
    for (const std::string_view written : entry.verb->files_written)
      if (option.name == written) files.insert(files.end(), option.values.begin(), option.values.end());
  return files;
}

// What an entry writes in the place of its output: of a pack that is there, all of its files.
std::vector<std::string> output_files(const BatchEntry& entry) {
  std::error_code fault;
  if (is_pack_entry(entry) && fs::exists(target_of(entry), fault)) {
    try {
      return files_of_pack(entry.output);
    } catch (const Error&) { // broken: what it names is not known
    }
  }
  return {target_of(entry)};
}

// Files, without the folders that patterns look through; none of an entry that can't be looked through.
std::vector<std::string> input_files(const Manifest& manifest, const BatchEntry& entry) {
  std::vector<std::string> files;
  try {
    for (const EntryInput& input : inputs_of(manifest, entry)) files.push_back(input.file);
  } catch (const Error&) { // it fails when it is made, and says why
    files = entry.sources;
  }
  return files;
}

// What all entries hang on.
std::vector<std::string> shared_files(const Manifest& manifest) {
  std::vector<std::string> files{manifest.file};
  for (const BatchEntry& entry : manifest.entries)
    if (is_preset_file(entry.preset)) files.push_back(entry.preset);
  return files;
}

// Each file that is read, by what it is on disk, with the entries that read it.
class Readers {
public:
  explicit Readers(const Manifest& manifest) {
    for (const std::string& file : shared_files(manifest))
      if (const auto id = id_behind(file)) shared.emplace(key(*id), file);
    for (std::size_t i = 0; i < manifest.entries.size(); ++i)
      for (const std::string& file : input_files(manifest, manifest.entries[i]))
        if (const auto id = id_behind(file)) readers[key(*id)].push_back(i);
  }

  bool all_hang_on(const FileId& id) const { return shared.count(key(id)) != 0; }

  std::span<const std::size_t> of(const FileId& id) const {
    const auto found = readers.find(key(id));
    return found == readers.end() ? std::span<const std::size_t>() : found->second;
  }

private:
  using Key = std::pair<std::uint64_t, std::uint64_t>;
  static Key key(const FileId& id) { return {id.device, id.number}; }

  std::map<Key, std::string> shared;
  std::map<Key, std::vector<std::size_t>> readers;
};

class WrittenFiles {
public:
  explicit WrittenFiles(const Manifest& of) : manifest(of) {}

  void check(std::span<const std::size_t> made) {
    for (const std::size_t i : made) {
      const BatchEntry& entry = manifest.entries[i];
      if (entry.verb->output == BatchOutput::printed &&
          (has_readable_ending(entry.output) || has_other_image_ending(entry.output)))
        fail(entry, entry.output, "ends as an image does, and a text would be written there");
      if (!is_pack_entry(entry))
        if (const fs::path pack = pack_of_file(entry.output); !pack.empty())
          fail(entry, entry.output,
               fmt::format("would replace a file of the pack '{}'", pack.filename().string()));
      claim(i, entry.output);
      for (const std::string& file : further_files(entry)) claim(i, file);
    }
    for (const std::size_t i : made) check_replaced(i);
  }

private:
  [[noreturn]] void fail(const BatchEntry& entry, const std::string& file, const std::string& what,
                         const char* way_out = "choose another name") const {
    throw Error(ErrorKind::invalid_content,
                fmt::format("{}: {}.output", place_in(manifest, entry.at), entry.at),
                fmt::format("'{}' {}; {}", file, what, way_out));
  }

  std::string line_of(std::size_t entry) const {
    return fmt::format("the entry on line {}", manifest.lines->line(manifest.entries[entry].at));
  }

  void claim(std::size_t i, const std::string& file) {
    const auto [other, is_new] = writers.emplace(one_spelling(file).string(), i);
    if (is_new) return;
    const bool is_own = other->second == i;
    fail(manifest.entries[i], file,
         is_own ? "is written twice by this entry"
                : fmt::format("is what {} makes too", line_of(other->second)));
  }

  void check_replaced(std::size_t i) {
    const BatchEntry& entry = manifest.entries[i];
    const bool is_made_by_batch = read_record(side_file_of(entry.output, is_pack_entry(entry))).has_value();
    if (!is_made_by_batch)
      for (const std::string& file : output_files(entry)) check_file(i, file, is_pack_entry(entry));
    for (const std::string& file : further_files(entry)) check_file(i, file, false);
  }

  // A pack that stands for what will be there may be replaced before others read it.
  void check_file(std::size_t i, const std::string& file, bool is_of_pack) {
    const std::optional<FileId> id = id_behind(file);
    if (!id) return;
    if (!readers) readers.emplace(manifest);
    const BatchEntry& entry = manifest.entries[i];
    if (readers->all_hang_on(*id)) fail(entry, file, "would replace a file that is worked from");
    for (const std::size_t reader : readers->of(*id)) {
      if (reader == i) fail(entry, file, "would replace a file that this entry works from");
      const auto& after = manifest.entries[reader].after;
      const bool waits = std::find(after.begin(), after.end(), i) != after.end();
      if (!(waits && is_of_pack))
        fail(entry, file, fmt::format("was made by no batch, and {} works from it", line_of(reader)),
             "choose another name, or remove it if it is what this entry makes");
    }
  }

  const Manifest& manifest;
  std::map<std::string, std::size_t> writers;
  std::optional<Readers> readers; // most batches need none
};

} // namespace

void check_beside_entries(const Manifest& manifest, std::span<const OutputFile> outputs) {
  if (std::all_of(outputs.begin(), outputs.end(), [](const OutputFile& o) { return o.file.empty(); })) return;
  std::vector<std::string> files = shared_files(manifest);
  files.push_back(index_file_of(manifest.file));
  std::map<std::string, std::string> packs; // one spelling → as written
  for (const BatchEntry& entry : manifest.entries) {
    for (const auto& some : {input_files(manifest, entry), output_files(entry), further_files(entry)})
      files.insert(files.end(), some.begin(), some.end());
    files.push_back(side_file_of(entry.output, is_pack_entry(entry)));
    if (is_pack_entry(entry)) packs.emplace(one_spelling(entry.output).string(), entry.output);
  }
  check_outputs(outputs, files);
  for (const OutputFile& output : outputs) {
    if (output.file.empty()) continue;
    check_text_name(output);
    const auto pack = packs.find(one_spelling(output.file).parent_path().string());
    if (pack != packs.end())
      throw Error(
          ErrorKind::usage, output.where,
          fmt::format("'{}' lies in the pack '{}'; choose a path outside of it", output.file, pack->second));
  }
}

void check_written_files(const Manifest& manifest, std::span<const std::size_t> made) {
  WrittenFiles(manifest).check(made);
}

} // namespace tilepack
