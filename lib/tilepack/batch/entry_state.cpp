#include "tilepack/batch/entry_state.h"

#include "tilepack/bake/material_read.h"
#include "tilepack/bake/output_check.h"
#include "tilepack/bake/preset.h"
#include "tilepack/bake/text_file.h"
#include "tilepack/batch/output_lock.h"
#include "tilepack/error/error.h"
#include "tilepack/pack/pack_read.h"
#include "tilepack/pack/staged_folder.h"
#include "tilepack/scene/scene_file_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

namespace tilepack {
namespace {

namespace fs = std::filesystem;

bool makes_pack(const BatchEntry& entry) {
  return entry.verb->output == BatchOutput::pack;
}

// "pack color_0.png", and "a color_0.png" of the two that are compared.
void add_pack(std::vector<EntryInput>& inputs, std::string_view key, const std::string& pack) {
  std::error_code fault;
  if (!fs::is_directory(pack, fault) &&
      fs::path(pack).filename() != "pack.json") { // compare takes images too
    inputs.push_back({std::string(key), pack});
    return;
  }
  const fs::path json = pack_json_of(pack);
  const std::string folder = json.parent_path().string();
  std::vector<std::string> names;
  // What made the pack wrote down its files, which is less to read than pack.json.
  const auto record = read_record(side_file_of(folder, true));
  const std::optional<ContentHash> now = record ? hash_if_there(json.string()) : std::nullopt;
  const bool as_made = record && !record->outputs.empty() && record->outputs.back().name == "pack.json" &&
                       now == record->outputs.back().hash;
  if (as_made) {
    for (const HashedFile& file : record->outputs) names.push_back(file.name);
  } else {
    names = read_pack_description(pack).all_files();
    names.emplace_back("pack.json");
  }
  for (const std::string& name : names)
    inputs.push_back({fmt::format("{} {}", key, name), (fs::path(folder) / name).string()});
}

// A pack of a scene by its path, a picture by its own.
void add_scene_files(std::vector<EntryInput>& inputs, const std::string& scene) {
  for (const SceneFileName& name : scene_file_names(scene)) {
    if (name.is_pack)
      add_pack(inputs, "scene " + name.path, name.path);
    else
      inputs.push_back({"scene " + name.path, name.path});
  }
}

// "material sand color", by the names that the materials of a transition have in the pack.
void add_materials(std::vector<EntryInput>& inputs, const BakeJob& job) {
  const std::vector<std::string> names = material_names_of(job);
  for (std::size_t m = 0; m < names.size(); ++m)
    for (const MaterialFile& map : sample_files(job.transition[m]).files)
      inputs.push_back({fmt::format("material {} {}", names[m], map.name), map.file});
}

// What shaders and pages name what they show by.
std::string name_of_shown(const BatchEntry& entry) {
  const std::string& shown = entry.sources.front();
  if (shows_scene(entry)) return fs::path(shown).filename().string();
  return pack_name(shown);
}

} // namespace

std::vector<EntryInput> inputs_of(const Manifest& manifest, const BatchEntry& entry) {
  std::vector<EntryInput> inputs;
  if (entry.is_transition) {
    add_materials(inputs, bake_job_of(manifest, entry));
  } else if (entry.verb->name == "bake") {
    const BakeJob job = bake_job_of(manifest, entry);
    for (const MaterialFile& map : maps_of(job))
      inputs.push_back({inputs.empty() ? "sample" : "map " + map.name, map.file});
  } else if (entry.verb->sources.front().is_list) {
    for (std::size_t i = 0; i < entry.sources.size(); ++i)
      inputs.push_back({fmt::format("tile {}", i), entry.sources[i]});
  } else {
    const bool is_scene = shows_scene(entry);
    for (std::size_t i = 0; i < entry.sources.size(); ++i) {
      const BatchSource& source = entry.verb->sources[i];
      if (source.is_pack && !is_scene)
        add_pack(inputs, source.key, entry.sources[i]);
      else
        inputs.push_back({std::string(source.key), entry.sources[i]});
    }
    if (is_scene) add_scene_files(inputs, entry.sources.front());
  }
  for (const std::string_view option : entry.verb->files_read)
    for (const BatchOption& given : entry.options)
      if (given.name == option)
        for (const std::string& file : given.values) inputs.push_back({std::string(option), file});
  return inputs;
}

std::vector<std::string> looked_at(const BatchEntry& entry, const std::vector<EntryInput>& inputs) {
  std::vector<std::string> files;
  for (const EntryInput& input : inputs) files.push_back(input.file);
  if (is_preset_file(entry.preset)) files.push_back(entry.preset);
  if (entry.verb->name != "bake") return files;
  // A sample that is no file by itself stands for what its folder holds.
  for (const std::string& source : entry.sources) {
    if (std::any_of(inputs.begin(), inputs.end(), [&](const EntryInput& in) { return in.file == source; }))
      continue;
    std::error_code fault;
    const fs::path sample = source;
    files.push_back(fs::is_directory(sample, fault) ? sample.string()
                                                    : (sample.parent_path() / ".").string());
  }
  return files;
}

std::string canonical_options_of(const Manifest& manifest, const BatchEntry& entry) {
  if (entry.verb->name == "bake") return canonical_options(bake_job_of(manifest, entry));
  std::map<std::string, std::string> lines{{"verb", std::string(entry.verb->name)},
                                           {"version", TILEPACK_VERSION}};
  for (const BatchOption& option : entry.options) {
    if (is_beside_the_output(option.name)) continue;
    const auto& read = entry.verb->files_read;
    const bool is_file = std::find(read.begin(), read.end(), option.name) != read.end();
    std::string& line = lines[option.name];
    // Files count by what they hold, which is hashed.
    for (const std::string& value : option.values)
      line += fmt::format("{}{}", line.empty() ? "" : ",", is_file ? "a file" : value);
    std::replace(line.begin(), line.end(), '\n', ' ');
  }
  if (entry.verb->name == "shader" || entry.verb->name == "view") lines["shown"] = name_of_shown(entry);
  // What a picture is written as depends on its ending.
  if (entry.verb->output == BatchOutput::file) lines["ending"] = fs::path(entry.output).extension().string();
  std::string text;
  for (const auto& [key, value] : lines) text += fmt::format("{}={}\n", key, value);
  return text;
}

std::string folder_of_output(const BatchEntry& entry) {
  return makes_pack(entry) ? entry.output : fs::path(entry.output).parent_path().string();
}

EntryState state_of(const Manifest& manifest, const BatchEntry& entry) {
  EntryState state;
  state.input_files = inputs_of(manifest, entry);
  state.inputs.options = canonical_options_of(manifest, entry);
  for (const EntryInput& input : state.input_files)
    state.inputs.files.push_back({input.name, hash_of_file(input.file)});
  state.record = read_record(side_file_of(entry.output, makes_pack(entry)));
  state.reasons = differences(state.record, state.inputs);
  if (!state.record) return state;
  std::vector<std::string> of_outputs;
  for (const HashedFile& made : state.record->outputs) {
    const auto hash = hash_if_there((fs::path(folder_of_output(entry)) / made.name).string());
    if (hash != made.hash)
      of_outputs.push_back(fmt::format("output {} {}", made.name, hash ? "edited" : "missing"));
  }
  shorten(of_outputs);
  state.reasons.insert(state.reasons.end(), of_outputs.begin(), of_outputs.end());
  return state;
}

std::vector<HashedFile> made_files(const BatchEntry& entry) {
  std::vector<std::string> names;
  if (makes_pack(entry)) {
    names = read_pack_description(entry.output).all_files();
    names.emplace_back("pack.json");
  } else {
    names.push_back(fs::path(entry.output).filename().string());
  }
  std::vector<HashedFile> files;
  for (const std::string& name : names)
    files.push_back({name, hash_of_file((fs::path(folder_of_output(entry)) / name).string())});
  return files;
}

void write_record(const BatchEntry& entry, const BuildRecord& record) {
  write_text_file(side_file_of(entry.output, makes_pack(entry)), record_text(record));
}

void remove_left_overs(const BatchEntry& entry) {
  if (!makes_pack(entry)) return; // of files, whoever writes them (StagedFile)
  std::error_code fault;
  const fs::path folder = fs::absolute(entry.output).lexically_normal();
  const std::string name = ".tilepack-staging";
  if (fs::exists(folder.parent_path() / fmt::format(".{}{}", folder.filename().string(), name), fault) ||
      fs::exists(folder / name, fault))
    const StagedFolder recovered_and_removed(entry.output);
}

void clear_broken_pack(const BatchEntry& entry) {
  if (!makes_pack(entry)) return;
  std::error_code fault;
  const fs::path folder(entry.output);
  if (!fs::is_directory(folder, fault)) return;
  const fs::path side = side_file_of(entry.output, true);
  const auto record = read_record(side.string());
  if (!record) return;
  const bool has_json = fs::exists(folder / "pack.json", fault);
  if (has_json) {
    try {
      read_pack_description(folder);
      return;
    } catch (const Error&) { // broken: made again like any output that was edited
    }
  }
  std::set<std::string> ours{side.filename().string(), ".tilepack-staging"};
  for (const HashedFile& file : record->outputs) ours.insert(file.name);
  for (fs::directory_iterator at(folder, fault), end; !fault && at != end; at.increment(fault))
    if (!ours.contains(at->path().filename().string())) return;
  for (const HashedFile& file : record->outputs)
    if (file.name.find('/') == std::string::npos) fs::remove(folder / file.name, fault);
  fs::remove(side, fault);
}

} // namespace tilepack
