#include "tilepack/bake/bake_job.h"

#include "tilepack/bake/depfile.h"
#include "tilepack/bake/material_read.h"
#include "tilepack/bake/material_values.h"
#include "tilepack/bake/memory_estimate.h"
#include "tilepack/bake/output_check.h"
#include "tilepack/bake/prepared_sample.h"
#include "tilepack/bake/preset.h"
#include "tilepack/image/image_file.h"
#include "tilepack/pack/file_name.h"
#include "tilepack/pack/pack_write.h"
#include "tilepack/pack/staged_outputs.h"
#include "tilepack/pack/stored_format_for.h"
#include "tilepack/tileset/limits.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/global_control.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <span>
#include <utility>

namespace tilepack {
namespace {

namespace fs = std::filesystem;

// For a transition with what follows from its materials.
BakeOptions options_from(const BakeJob& job, std::span<const BakeSetting> settings) {
  BakeOptions options = bake_options(settings);
  if (job.transition.empty()) return options;
  return transition_options(std::move(options), static_cast<int>(job.transition.size()),
                            setting_of(settings, "colors") != nullptr,
                            setting_of(settings, "variants") != nullptr);
}

// Whatever `work` throws is blamed on where the job was told so. `work` gets all settings.
template <typename Work>
auto blaming(const BakeJob& job, Work work) {
  std::vector<BakeSetting> settings = job.settings;
  try {
    settings = settings_of(job);
    return work(std::as_const(settings));
  } catch (const Error& error) {
    throw blamed(error, job.place, settings);
  }
}

std::string in_folder(const BakeJob& job, const std::string& file) {
  return (fs::path(job.folder) / file).string();
}

std::vector<std::string> inputs_of(const BakeJob& job, const std::vector<MaterialFile>& maps) {
  std::vector<std::string> files;
  for (const MaterialFile& map : maps) files.push_back(map.file);
  if (is_preset_file(job.preset)) files.push_back(job.preset);
  return files;
}

// Refuses early what can't be written, or would replace what the pack is made from. What lies inside the pack's
// folder has to wait for the folder.
void check_outputs_of(const BakeJob& job, const std::vector<std::string>& inputs) {
  const OutputFile depfile{field("depfile"), job.depfile}, page{field("report"), job.report};
  check_page_name(page);
  check_outputs(std::vector{depfile, page}, inputs);
  check_text_name(depfile);
  check_pack_folder_for(job.folder, inputs);
  const fs::path pack_folder = one_spelling(job.folder);
  for (const std::string& file : {depfile.file, page.file})
    if (!file.empty() && one_spelling(file).parent_path() != pack_folder) check_writable(file);
}

std::vector<std::string> pack_files_of(const BakeJob& job, const PackDescription& description) {
  std::vector<std::string> files{in_folder(job, "pack.json")};
  for (const std::string& file : description.all_files()) files.push_back(in_folder(job, file));
  return files;
}

void add_side_files(const BakeJob& job, std::vector<std::string>& files) {
  for (const std::string& file : {job.report, job.depfile})
    if (!file.empty()) files.push_back(file);
}

void write_job(const BakeJob& job, const std::vector<std::string>& inputs, BakedJob& baked,
               const JobWatch& watch, StageClock& clock, const Progress& progress) {
  StagedOutputs outputs;
  tbb::task_group beside;
  if (watch.made) beside.run([&] { watch.made(baked); });
  try {
    outputs.add_folder(job.folder);
    if (!job.depfile.empty()) {
      check_outputs(std::vector<OutputFile>{{field("depfile"), job.depfile}},
                    pack_files_of(job, baked.description));
      outputs.add_text(job.depfile, depfile_text(in_folder(job, "pack.json"), inputs));
    }
    stage_pack(outputs, baked.made.pack, job.folder, progress);
  } catch (...) {
    beside.wait();
    throw;
  }
  beside.wait();
  baked.stages = clock.shares();
  if (!job.report.empty() && watch.page) outputs.add_text(job.report, watch.page(baked));
  outputs.commit(progress);
}

ReadOptions reading_for(const BakeJob& job) {
  ReadOptions reading;
  reading.encoding = job.encoding;
  reading.channels = job.channels;
  reading.most_texels = job.max_texels;
  return reading;
}

// A set grows with the fourth power of its colors, and so does what it takes.
void note_many_tiles(const BakeOptions& options, const JobWatch& watch) {
  const ColorCounts& k = options.synth.colors;
  const bool corner = options.synth.coloring == Coloring::corner;
  const int tiles = corner ? k.corner * k.corner * k.corner * k.corner
                           : k.horizontal * k.horizontal * k.vertical * k.vertical;
  constexpr int usual = 16, many = 256;
  if (tiles < many) return;
  watch.note(
      fmt::format("{} tiles are to be made, which takes some {} times as long as the {} of {}; {} makes 81",
                  tiles, tiles / usual, usual, field("colors", "2"), field("colors", "3")));
}

// Whoever asks for whole repeats wants to know that there were none.
void note_no_repeat(const BakeJob& job, const BakedJob& baked, const JobWatch& watch) {
  const std::vector<BakeSetting> settings = settings_of(job);
  const BakeSetting* size = setting_of(settings, "tile-size");
  const Periodicity& periods = baked.made.sample.periods;
  if (size == nullptr || size->value != "auto" || periods.x.length > 0 || periods.y.length > 0) return;
  const Size tile = baked.made.synth.tile_size;
  watch.note(fmt::format("no repeat was found in the sample: tiles of {} x {} texels follow its size alone",
                         tile.width, tile.height));
}

// Of samples that were not said to wrap.
void note_wrap(const BakeOptions& options, const BakedJob& baked, const JobWatch& watch) {
  if (options.wraps != WrapChoice::found) return;
  const auto note = [&](const SampleWrap& wrap, const std::string& sample) {
    if (wrap == SampleWrap{}) return;
    watch.note(fmt::format("{} goes on at its opposite borders{}, so tiles show what lies across them "
                           "too; {} takes it as it ends",
                           sample,
                           wrap.x && wrap.y ? ""
                           : wrap.x         ? " in the east and west"
                                            : " in the north and south",
                           field("wraps", "no")));
  };
  const auto shows_something = [](const SetReport& report) { return report.figures.sample_step > 0; };
  if (shows_something(baked.made.report)) note(baked.made.wrap, "the sample");
  for (const BakedMaterial& material : baked.made.materials)
    if (shows_something(material.report)) note(material.wrap, material.name);
}

using Tell = std::function<void(const std::vector<std::string>& notes)>;

// What was read, ready for baked().
std::vector<SampleMap> prepared_material(ReadSamples read, const BakeJob& job, const BakeOptions& options,
                                         const Tell& tell) {
  tell(read.notes);
  tell(prepare_maps(read.maps, options.material));
  for (const SampleMap& map : read.maps) {
    const StorageRequest asked{options.format, options.depth};
    const Depth depth = stored_format_for(map.role, map.encoding, map.depth, asked, StoredFor::pack).depth;
    if (const std::string clipped = check_storable(map, depth); !clipped.empty()) tell({clipped});
  }
  if (const std::string doubt = doubt_about_color(read.maps[0], job.encoding); !doubt.empty()) tell({doubt});
  return std::move(read.maps);
}

BakedJob run_checked(const BakeJob& job, const BakeOptions& options, const JobWatch& watch) {
  const std::vector<MaterialFile> maps = maps_of(job);
  const std::vector<std::string> inputs = inputs_of(job, maps);
  StageClock clock;
  Stopwatch watch_of_parts;
  check_outputs_of(job, inputs); // before minutes are spent on what can't be stored
  const Progress progress = clock.around(progress_of(job.name, watch.progress));
  report(progress, "reading", 0.0);
  BakedJob baked;
  const Tell tell = [&](const std::vector<std::string>& notes) {
    if (watch.note)
      for (const std::string& note : notes) watch.note(note);
  };
  const std::vector<std::string> names = material_names_of(job);
  std::vector<ReadSamples> read;
  for (const std::string& material : job.transition)
    read.push_back(read_samples(sample_files(material).files, reading_for(job)));
  if (names.empty()) read.push_back(read_samples(maps, reading_for(job)));
  for (const ReadSamples& material : read) check_one_size(material.maps); // matters more than any note
  tell(notes_on_material(job));
  std::vector<TransitionMaterial> materials;
  for (std::size_t m = 0; m < names.size(); ++m)
    materials.push_back({names[m], prepared_material(std::move(read[m]), job, options, tell)});
  baked.samples = materials.empty() ? prepared_material(std::move(read.front()), job, options, tell)
                                    : materials.front().maps;
  if (const std::string note = replacing_note(job.folder); watch.note && !note.empty()) watch.note(note);
  baked.read_seconds = watch_of_parts.lap();
  bool begun = false; // all options were found to go together
  const Progress making = [&](std::string_view stage, double done) {
    if (!std::exchange(begun, true) && watch.note && materials.empty()) note_many_tiles(options, watch);
    report(progress, stage, done);
  };
  baked.made = !materials.empty() ? baked_transition(materials, options, making)
               : watch.make       ? watch.make(baked.samples, options, making)
                                  : tilepack::baked(baked.samples, options, making);
  if (watch.note && materials.empty()) note_no_repeat(job, baked, watch);
  if (watch.note) note_wrap(options, baked, watch);
  baked.bake_seconds = watch_of_parts.lap();
  if (watch.accept) watch.accept(baked);
  baked.description = described(baked.made.pack);
  write_job(job, inputs, baked, watch, clock, progress);
  baked.write_seconds = watch_of_parts.lap();
  baked.stages = clock.shares();
  return baked;
}

} // namespace

std::vector<BakeSetting> settings_of(const BakeJob& job) {
  std::vector<BakeSetting> settings;
  if (!job.preset.empty()) settings = preset_called(job.preset).settings;
  settings.insert(settings.end(), job.settings.begin(), job.settings.end());
  return settings;
}

BakeOptions options_of(const BakeJob& job) {
  return blaming(job, [&](const auto& settings) { return options_from(job, settings); });
}

std::vector<std::string> material_names_of(const BakeJob& job) {
  std::vector<std::string> names;
  for (const std::string& sample : job.transition) {
    fs::path path(sample);
    if (path.filename().empty()) path = path.parent_path(); // "materials/rock/"
    std::string name = fs::is_directory(path) ? path.filename().string() : path.stem().string();
    for (char& c : name)
      if (!is_map_name(std::string(1, c))) c = '_';
    if (name.empty()) name = "material";
    constexpr std::size_t longest_stem = limits::longest_map_name - 2;
    name.resize(std::min(name.size(), longest_stem));
    const std::string stem = name;
    for (int n = 2; std::find(names.begin(), names.end(), name) != names.end(); ++n)
      name = fmt::format("{}-{}", stem, n);
    names.push_back(std::move(name));
  }
  return names;
}

std::vector<MaterialFile> maps_of(const BakeJob& job) {
  if (!job.transition.empty()) {
    std::vector<MaterialFile> all;
    for (const std::string& material : job.transition) {
      const std::vector<MaterialFile> files = sample_files(material).files;
      all.insert(all.end(), files.begin(), files.end());
    }
    return all;
  }
  std::vector<MaterialFile> files = sample_files(job.sample).files;
  const bool one_image = files.size() == 1 && files.front().file == job.sample;
  const std::size_t found = one_image ? 0 : files.size();
  // A map that is named takes the place of one that was found; two that are named for one place are an error,
  // found later.
  std::vector<bool> taken(found, false);
  for (const MaterialFile& named : job.maps) {
    const auto place = std::find_if(files.begin(), files.begin() + static_cast<std::ptrdiff_t>(found),
                                    [&](const MaterialFile& f) { return f.name == named.name; });
    const auto index = static_cast<std::size_t>(place - files.begin());
    if (index < found && !taken[index]) {
      *place = named;
      taken[index] = true;
    } else {
      files.push_back(named);
    }
  }
  return files;
}

std::vector<std::string> notes_on_material(const BakeJob& job) {
  constexpr std::size_t most = 8;
  std::vector<std::string> notes;
  std::vector<PassedOver> list;
  for (const std::string& sample : job.transition.empty() ? std::vector{job.sample} : job.transition) {
    const FoundMaterial found = sample_files(sample);
    list.insert(list.end(), found.passed_over.begin(), found.passed_over.end());
    if (!found.unlike.empty()) notes.push_back(note_on_unlike(found, sample));
  }
  std::erase_if(list, [&](const PassedOver& over) {
    return std::any_of(job.maps.begin(), job.maps.end(), [&](const MaterialFile& map) {
      std::error_code unknown;
      return fs::equivalent(map.file, over.file, unknown);
    });
  });
  for (const PassedOver& over : std::span(list).first(std::min(most, list.size())))
    notes.push_back(note_on(over));
  if (list.size() > most) notes.push_back(fmt::format("{} more files are passed over", list.size() - most));
  return notes;
}

std::vector<std::string> files_read(const BakeJob& job) {
  return inputs_of(job, maps_of(job));
}

std::vector<std::string> files_written(const BakeJob& job) {
  std::vector<std::string> files{in_folder(job, "pack.json")};
  add_side_files(job, files);
  return files;
}

std::vector<std::string> files_written(const BakeJob& job, const BakedJob& baked) {
  std::vector<std::string> files = pack_files_of(job, baked.description);
  add_side_files(job, files);
  return files;
}

std::string canonical_options(const BakeJob& job) {
  const BakeOptions options = options_of(job);
  std::map<std::string, std::string> lines;
  for (const BakeField& field : bake_fields()) lines[field.name] = field.get(options);
  for (const MaterialFile& map : maps_of(job)) {
    std::string& list = lines["maps"];
    list += fmt::format("{}{}:{}", list.empty() ? "" : ",", map.name, name_of(map.role));
    for (const ChannelContent content : map.contents) list += fmt::format(":{}", name_of(content));
    if (map.normal_y) list += fmt::format(":{}", name_of(*map.normal_y));
  }
  if (!job.transition.empty())
    lines["transition"] = fmt::format("{}", fmt::join(material_names_of(job), ","));
  // Absent where not asked for, so that packs of older records stay current.
  if (!job.require.empty()) lines["require"] = job.require;
  if (job.apply_advice) lines["apply-advice"] = "true";
  lines["channels"] = job.channels;
  lines["encoding"] = job.encoding ? std::string(name_of(*job.encoding)) : "";
  lines["version"] = TILEPACK_VERSION;
  std::string text;
  for (const auto& [key, value] : lines) text += fmt::format("{}={}\n", key, value);
  return text;
}

std::int64_t peak_memory(const BakeJob& job) {
  return blaming(job, [&](const auto& settings) {
    std::vector<MapShape> shapes;
    const auto add = [&](const MaterialFile& map) {
      const ImageHeader header = read_image_header(map.file, reading_of(map.role, reading_for(job)));
      const int channels = map.role == Role::normal ? std::max(3, header.channels) : header.channels;
      shapes.push_back({header.size, channels, header.depth});
    };
    if (job.transition.empty()) {
      for (const MaterialFile& map : maps_of(job)) add(map);
    } else { // side by side, as they are joined
      int width = 0;
      for (const std::string& material : job.transition) {
        shapes.clear();
        for (const MaterialFile& map : sample_files(material).files) add(map);
        width += shapes.front().size.width;
      }
      for (MapShape& shape : shapes) shape.size.width = width;
    }
    const std::size_t threads =
        tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    return memory_estimate(shapes, options_from(job, settings), static_cast<int>(threads));
  });
}

BakedJob run(const BakeJob& job, const JobWatch& watch) {
  return blaming(job, [&](const auto& settings) {
    if (job.sample.empty() && job.transition.empty()) throw Error(ErrorKind::usage, "", "SAMPLE is required");
    if (job.folder.empty()) throw Error(ErrorKind::usage, "", field("output") + " is required");
    if (!job.transition.empty() && !job.maps.empty())
      throw Error(
          ErrorKind::usage, field("map"),
          "does not go with " + field("transition") +
              ", for nothing says which material it is of; give each material as a folder of its maps");
    return run_checked(job, options_from(job, settings), watch);
  });
}

} // namespace tilepack
