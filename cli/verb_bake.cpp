#include "bake_field_options.h"
#include "bake_report.h"
#include "bake_samples.h"
#include "jobs.h"
#include "output_file.h"
#include "value_check.h"
#include "verb.h"

#include "tilepack/bake/bake.h"
#include "tilepack/bake/bake_fields.h"
#include "tilepack/bake/preset.h"
#include "tilepack/error/error.h"
#include "tilepack/error/nearest_name.h"
#include "tilepack/image/staged_file.h"
#include "tilepack/pack/pack_read.h"
#include "tilepack/pack/pack_write.h"
#include "tilepack/report/bake_page.h"
#include "tilepack/report/pack_summary.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <tbb/task_group.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <vector>

namespace tilepack::cli {
namespace {

namespace fs = std::filesystem;

struct BakeArguments {
  std::string sample;
  std::string folder;
  std::vector<std::string> maps;
  std::string preset;
  bool list_presets = false;
  std::string encoding;
  std::string depfile;
  std::string report;
  std::string report_format = "text";
  int jobs = 0;
  std::map<std::string, std::string> fields; // bake field → what the command line says
};

std::string listed_presets() {
  std::string text;
  for (const Preset& preset : built_in_presets()) {
    text += fmt::format("{}\n  for   {}\n  cost  {}\n  sets ", preset.name, preset.purpose, preset.cost);
    for (const BakeSetting& setting : preset.settings)
      text += fmt::format(" --{} {}", setting.field, setting.value);
    text += '\n';
  }
  return text;
}

std::string listed_presets_json() {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Preset& preset : built_in_presets()) {
    nlohmann::ordered_json settings = nlohmann::ordered_json::object();
    for (const BakeSetting& setting : preset.settings) settings[setting.field] = setting.value;
    list.push_back({{"name", preset.name},
                    {"purpose", preset.purpose},
                    {"cost", preset.cost},
                    {"settings", std::move(settings)}});
  }
  return list.dump(2) + "\n";
}

std::string text_of(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  if (!stream) throw Error(ErrorKind::cannot_read, file, "the preset can't be read");
  return text.str();
}

// A built-in preset by its name, else a file.
Preset preset_called(const std::string& name) {
  std::vector<std::string> known;
  for (Preset& preset : built_in_presets()) {
    if (preset.name == name) return std::move(preset);
    known.push_back(preset.name);
  }
  const std::filesystem::path file(name);
  if (std::filesystem::is_regular_file(file)) return parsed_preset(text_of(name), file.stem().string(), name);
  if (file.has_parent_path() || file.has_extension())
    throw Error(ErrorKind::cannot_read, name, "there is no such preset file");
  const std::string nearest = nearest_name(name, known);
  throw Error(ErrorKind::usage, "--preset",
              fmt::format("there is no preset '{}'; {}--list-presets shows them, and a FILE is taken too",
                          name, nearest.empty() ? "" : fmt::format("did you mean '{}'? ", nearest)));
}

BakeOptions options_from(const BakeArguments& arguments) {
  std::vector<BakeSetting> settings;
  if (!arguments.preset.empty()) settings = preset_called(arguments.preset).settings;
  for (const auto& [field, value] : arguments.fields)
    settings.push_back({field, value, "--" + field, ErrorKind::usage});
  return bake_options(settings);
}

std::string dependencies(const BakeArguments& arguments, const std::vector<MaterialFile>& files) {
  std::vector<std::string> inputs;
  for (const MaterialFile& file : files) inputs.push_back(file.file);
  if (std::filesystem::is_regular_file(arguments.preset)) inputs.push_back(arguments.preset);
  return depfile_text((std::filesystem::path(arguments.folder) / "pack.json").string(), inputs);
}

class Stopwatch {
public:
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double>(now - std::exchange(last, now)).count();
  }

private:
  std::chrono::steady_clock::time_point last = std::chrono::steady_clock::now();
};

// Refuses early what can't be written, or would replace what the pack is made from. A report inside the
// pack's folder has to wait for the folder.
void check_outputs_of(const BakeArguments& arguments, const std::vector<MaterialFile>& files) {
  const OutputFile depfile{"--depfile", arguments.depfile}, page{"--report", arguments.report};
  check_page_name(page);
  std::vector<std::string> inputs;
  for (const MaterialFile& file : files) inputs.push_back(file.file);
  if (fs::is_regular_file(arguments.preset)) inputs.push_back(arguments.preset);
  check_outputs(std::vector{depfile, page}, inputs);
  check_pack_folder_for(arguments.folder, inputs);
  if (!depfile.file.empty()) check_writable(depfile.file);
  if (page.file.empty()) return;
  const fs::path folder = fs::absolute(page.file).parent_path().lexically_normal();
  if (folder != (fs::absolute(arguments.folder) / "").lexically_normal().parent_path())
    check_writable(page.file);
}

// A depfile that gets its name only once the pack is in place.
std::unique_ptr<StagedFile> staged_depfile(const BakeArguments& arguments,
                                           const std::vector<MaterialFile>& files,
                                           const PackDescription& made) {
  if (arguments.depfile.empty()) return nullptr;
  std::vector<std::string> pack_files{(fs::path(arguments.folder) / "pack.json").string()};
  for (const std::string& file : made.all_files())
    pack_files.push_back((fs::path(arguments.folder) / file).string());
  check_outputs(std::vector<OutputFile>{{"--depfile", arguments.depfile}}, pack_files);
  const std::string text = dependencies(arguments, files);
  auto staged = std::make_unique<StagedFile>(arguments.depfile);
  staged->write(0, std::as_bytes(std::span(text.data(), text.size())));
  staged->check();
  return staged;
}

int run_bake(const BakeArguments& arguments, Console& console) {
  if (arguments.list_presets) {
    console.print(arguments.report_format == "json" ? listed_presets_json() : listed_presets());
    return 0;
  }
  if (arguments.sample.empty()) throw Error(ErrorKind::usage, "", "SAMPLE is required");
  if (arguments.folder.empty()) throw Error(ErrorKind::usage, "", "--output is required");
  const JobLimit limit(arguments.jobs);
  const BakeOptions options = options_from(arguments);
  std::vector<MaterialFile> files = sample_files(arguments.sample);
  for (const std::string& option : arguments.maps) files.push_back(parsed_map_option(option));
  std::optional<Encoding> asked;
  if (!arguments.encoding.empty()) asked = arguments.encoding == "srgb" ? Encoding::srgb : Encoding::linear;

  Stopwatch watch;
  check_outputs_of(arguments, files); // before minutes are spent on what can't be stored
  StageClock clock;
  const Progress progress = clock.around(console.progress());
  report(progress, "reading", 0.0);
  const std::vector<SampleMap> samples = read_samples(files, asked);
  if (const std::string doubt = doubt_about_color(samples[0], asked); !doubt.empty()) console.note(doubt);
  const double read_seconds = watch.lap();
  const BakedPack made = baked(samples, options, progress);
  const double bake_seconds = watch.lap();
  // What the report says is found while files are written.
  BakeSummary story{fs::path(arguments.sample).filename().string(), {}, {}};
  tbb::task_group figures;
  figures.run([&] { story.facts = bake_facts(made, samples); });
  const PackDescription description = described(made.pack);
  const std::unique_ptr<StagedFile> depfile = staged_depfile(arguments, files, description);
  write_pack(made.pack, arguments.folder, progress);
  if (depfile) depfile->commit();
  figures.wait();
  const double write_seconds = watch.lap();
  if (!arguments.report.empty()) {
    story.stages = clock.shares();
    write_text_file(arguments.report, bake_page(story, made, samples));
  }

  console.print(arguments.report_format == "json"
                    ? made_json(description, arguments.folder, &story.facts)
                    : bake_report_text(description, arguments.folder, &story.facts));
  console.note(fmt::format("read {:.2f} s, baked {:.2f} s, written {:.2f} s", read_seconds, bake_seconds,
                           write_seconds));
  return 0;
}

Action declare_bake(Options& options) {
  auto arguments = std::make_shared<BakeArguments>();
  options.option(
      "SAMPLE", arguments->sample,
      "image to make tiles from, or folder of the maps of a material (rock_albedo.png, rock_normal.png …)");
  options.option("-o,--output", arguments->folder, "folder of the pack").value("DIR");
  options
      .option("--map", arguments->maps,
              "a further map of the material, in register with SAMPLE; may be repeated")
      .value("ROLE=FILE");
  options
      .option("--preset", arguments->preset,
              "options from a built-in preset or a JSON file; flags override it")
      .value("NAME|FILE");
  options.flag("--list-presets", arguments->list_presets, "show the built-in presets and end");
  for (const BakeField& field : bake_fields()) add_field_option(options, field, arguments->fields);
  options
      .option("--encoding", arguments->encoding,
              "how color samples are encoded; as their file says unless given")
      .one_of("srgb|linear");
  options.option("--depfile", arguments->depfile, "write a rule for make or ninja: what the pack depends on")
      .value("FILE");
  options
      .option("--report-format", arguments->report_format, "of the summary or the list of presets on stdout")
      .one_of("text|json");
  options
      .option("--report", arguments->report,
              "also write a page: tiles, cuts and sources drawn, figures, what to change")
      .value("FILE.html");
  add_jobs_option(options, arguments->jobs);
  return [arguments](Console& console) { return run_bake(*arguments, console); };
}

} // namespace

Verb bake_verb() {
  return {"bake", "make a tile pack from a texture sample or a set of material maps",
          "  tilepack bake gravel.png -o gravel.pack --tile-size 128 --colors 2\n"
          "  tilepack bake rock.png -o rock.pack --map normal=rock_normal.png --preset terrain --seed 7\n"
          "  tilepack bake gravel.png -o gravel.pack --report gravel.html\n"
          "  tilepack bake materials/rock -o rock.pack\n",
          declare_bake, "; further maps of the material go by --map ROLE=FILE"};
}

} // namespace tilepack::cli
