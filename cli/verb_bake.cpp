#include "bake_field_options.h"
#include "bake_judging.h"
#include "bake_report.h"
#include "interrupt.h"
#include "jobs.h"
#include "value_check.h"
#include "verb.h"

#include "tilepack/bake/bake_job.h"
#include "tilepack/bake/map_kinds.h"
#include "tilepack/bake/material_read.h"
#include "tilepack/bake/preset.h"
#include "tilepack/batch/file_watch.h"
#include "tilepack/batch/job_content.h"
#include "tilepack/batch/output_lock.h"
#include "tilepack/report/bake_page.h"
#include "tilepack/report/pack_summary.h"
#include "tilepack/tileset/material_map.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tilepack::cli {
namespace {

struct BakeArguments {
  std::vector<std::string> samples;
  bool transition = false;
  std::string folder;
  std::vector<std::string> maps;
  std::string preset;
  bool list_presets = false;
  bool list_maps = false;
  std::string encoding;
  std::string channels;
  std::int64_t max_texels = usual_most_texels;
  std::string depfile;
  std::string report;
  PrintedFormat printed;
  std::string require;
  bool apply_advice = false;
  int jobs = 0;
  bool wait = false;
  bool watch = false;
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

BakeJob job_from(const BakeArguments& arguments) {
  BakeJob job;
  if (arguments.transition)
    job.transition = arguments.samples;
  else if (!arguments.samples.empty())
    job.sample = arguments.samples.front();
  for (const std::string& map : arguments.maps) job.maps.push_back(parsed_map(map));
  job.preset = arguments.preset;
  for (const auto& [name, value] : arguments.fields)
    job.settings.push_back({name, value, field(name), ErrorKind::usage});
  if (!arguments.encoding.empty())
    job.encoding = arguments.encoding == "srgb" ? Encoding::srgb : Encoding::linear;
  job.channels = arguments.channels;
  job.max_texels = arguments.max_texels;
  job.require = arguments.require;
  job.apply_advice = arguments.apply_advice;
  job.folder = arguments.folder;
  job.report = arguments.report;
  job.depfile = arguments.depfile;
  return job;
}

// Where there is a verb for it.
std::string many_samples() {
  const auto verbs = verb_table();
  const bool there = std::any_of(verbs.begin(), verbs.end(), [](const Verb& v) { return v.name == "batch"; });
  return there ? "; for many samples see `tilepack batch --help`" : "";
}

// A shell hands on a pattern that nothing matches, or that is quoted, as it is.
void refuse_pattern(const std::string& sample) {
  std::error_code unused;
  if (sample.find_first_of("*?") == std::string::npos || std::filesystem::exists(sample, unused)) return;
  throw Error(ErrorKind::usage, sample,
              "is a pattern, and a bake takes one sample: name a file or a folder" + many_samples());
}

void bake_once(const BakeArguments& arguments, const BakeJob& job, Console& console) {
  const Progress waiting = console.progress();
  std::optional<OutputLock> lock;
  if (!job.folder.empty())
    lock.emplace(job.folder, arguments.wait ? WhenBusy::wait : WhenBusy::refuse,
                 [&](const std::string& who) { report(waiting, "waiting for " + who, 0.0); });
  BakeSummary story{title_of(job), {}, {}};
  JobWatch watch;
  watch.progress = [draw = console.progress()](std::string_view, std::string_view stage, double done) {
    draw(stage, done);
  };
  watch.note = [&](std::string_view line) { console.note(spelled(line, FieldSpelling::option)); };
  judge(job, watch, story.facts, true,
        {[&](std::string_view line) { console.note(spelled(line, FieldSpelling::option)); },
         // What is printed on stdout is for whoever wants to mend it.
         [&](const BakeFacts& facts) {
           console.print(arguments.printed.json() ? judged_json(facts) : verdict_text(facts));
         }});
  watch.page = [&](const BakedJob& baked) {
    story.stages = baked.stages;
    return bake_page(story, baked.made, baked.samples);
  };
  const BakedJob baked = run(job, watch);
  if (arguments.watch) {
    const std::string text = bake_report_text(baked.description, job.folder, &story.facts);
    console.note(text.substr(0, text.find('\n'))); // a line each time
    return;
  }
  if (arguments.printed.json())
    console.print(made_json(baked.description, job.folder, &story.facts), job.folder);
  else if (!console.quiet || arguments.printed.asked_for())
    console.print(bake_report_text(baked.description, job.folder, &story.facts), job.folder);
  console.note(fmt::format("read {:.2f} s, baked {:.2f} s, written {:.2f} s", baked.read_seconds,
                           baked.bake_seconds, baked.write_seconds));
}

int bake_watching(const BakeArguments& arguments, const BakeJob& job, Console& console) {
  if (arguments.printed.json())
    throw Error(ErrorKind::usage, "--format", "json is for one bake; it does not go with --watch");
  constexpr std::chrono::milliseconds quiet{100};
  std::optional<ContentHash> made;
  console.note("watching; Ctrl-C ends it");
  while (true) {
    std::vector<std::string> files = job.transition.empty() ? std::vector{job.sample} : job.transition;
    try {
      files = files_read(job);
    } catch (const Error&) { // the bake says what is wrong
    }
    FileWatch watch(files); // before the bake, so that what is saved meanwhile counts
    const ContentHash now = content_of(job);
    if (made != now) {
      try {
        bake_once(arguments, job, console);
      } catch (const Error& error) {
        console.error(error.message(FieldSpelling::option));
      }
      made = now;
    }
    watch.wait(quiet, [] {
      if (interrupted()) throw Interrupted{"the pack is whole"};
    });
  }
}

// Maps whose '=' was left out swallow no file, which is then one argument too many.
std::string explained_extra(const BakeArguments& arguments, const std::string& extra) {
  for (const std::string& map : arguments.maps)
    if (map.find('=') == std::string::npos)
      return fmt::format("; --map {0} has no '=': write --map {0}={1}", map, extra);
  return "; one sample a bake, and further maps of the material go by --map ROLE=FILE, several materials by "
         "--transition" +
         many_samples();
}

// Where a sample without -o would go: beside nothing of others, and named like it.
std::string usual_folder(const std::string& sample) {
  std::filesystem::path path(sample);
  if (path.filename().empty()) path = path.parent_path();
  const std::string stem = path.stem().string();
  return (stem.empty() || stem.front() == '.' ? "material" : stem) + ".pack";
}

int run_bake(BakeArguments& arguments, Console& console) {
  if (arguments.list_presets) {
    console.print(arguments.printed.json() ? listed_presets_json() : listed_presets());
    return 0;
  }
  if (arguments.list_maps) {
    console.print(kinds_text());
    return 0;
  }
  for (const std::string& sample : arguments.samples) refuse_pattern(sample);
  if (!arguments.transition && arguments.samples.size() > 1)
    throw Error(ErrorKind::usage, "",
                fmt::format("unexpected argument '{}'{}", arguments.samples[1],
                            explained_extra(arguments, arguments.samples[1])));
  if (arguments.transition && arguments.samples.empty())
    throw Error(ErrorKind::usage, "--transition", "needs 2 to 4 materials: --transition A.png B.png");
  if (arguments.folder.empty() && !arguments.samples.empty())
    throw Error(ErrorKind::usage, "",
                fmt::format("--output is required: `tilepack bake {}{} -o {}`",
                            arguments.transition ? "--transition " : "", fmt::join(arguments.samples, " "),
                            usual_folder(arguments.samples.front())));
  const std::string now = arguments.printed.settle(arguments.fields);
  const JobLimit limit(arguments.jobs);
  const BakeJob job = job_from(arguments);
  if (arguments.watch) return bake_watching(arguments, job, console);
  bake_once(arguments, job, console);
  if (!now.empty()) console.note(now);
  return 0;
}

std::string preset_lines() {
  std::string text;
  for (const Preset& preset : built_in_presets())
    text += fmt::format("  {:<11} {}\n", preset.name, preset.purpose);
  return text;
}

constexpr std::array<std::string_view, 6> first_fields{"tile-size", "colors", "wraps",
                                                       "flatten",   "effort", "seed"};

Action declare_bake(Options& options) {
  auto arguments = std::make_shared<BakeArguments>();
  options
      .option("SAMPLE", arguments->samples,
              "image to make tiles from, or folder of the maps of a material (rock_albedo.png, "
              "rock_normal.png …); with --transition 2 to 4 of them")
      .needed();
  options.group(most_used);
  options.option("-o,--output", arguments->folder, "folder of the pack; made if it is not there")
      .value("DIR")
      .needed();
  options
      .option(
          "--map", arguments->maps,
          "a further map of the material, in register with SAMPLE; may be repeated. ROLE is data or one of " +
              listed_kinds())
      .value("ROLE=FILE");
  options.flag(
      "--transition", arguments->transition,
      "each SAMPLE is a material, and tiles lead from any of them to any other: corner colors are materials, "
      "0 the first");
  options
      .option("--preset", arguments->preset,
              "options from a built-in preset (below) or a JSON file; flags override it")
      .value("NAME|FILE");
  options
      .option("--report", arguments->report,
              "also write a page: tiles, cuts and sources drawn, figures, what to change")
      .value("FILE.html");
  add_field_options(options, bake_fields(), first_fields, arguments->fields);
  options.group(most_used);
  options
      .option("--require", arguments->require,
              "write nothing and exit with 5 if the verdict on the set is worse (default: any will do)")
      .one_of("good|fair");
  options.flag(
      "--apply-advice", arguments->apply_advice,
      "where the verdict is not good, bake again with the options it names, at most twice, and keep the "
      "better");
  options.group("Reading samples");
  options.flag(
      "--list-maps", arguments->list_maps,
      "show the kinds of maps, and the endings of file names that they are known by in a folder, and end");
  options
      .option("--encoding", arguments->encoding,
              "how color samples are encoded; as their file says unless given")
      .one_of("srgb|linear");
  options
      .option("--channels", arguments->channels,
              "channels of a color sample by their names in the file, in this order")
      .value("R,G,B");
  options
      .option("--max-texels", arguments->max_texels,
              fmt::format("samples of more are refused before memory is taken (default {})",
                          arguments->max_texels))
      .check(whole_number(1, std::int64_t{1} << 40))
      .value("N");
  options.group("General");
  add_printed_format(options, arguments->printed);
  options.option("--depfile", arguments->depfile, "write a rule for make or ninja: what the pack depends on")
      .value("FILE");
  options.flag("--list-presets", arguments->list_presets, "show the built-in presets in full and end");
  options.flag("--wait", arguments->wait, "wait for another process that writes this pack");
  options.flag("--watch", arguments->watch,
               "go on, and bake again whenever what the pack is made from is saved");
  add_jobs_option(options, arguments->jobs);
  options.section("Presets", preset_lines());
  options.section(
      "Roles of maps, and the endings of names that files of them are known by",
      kind_lines() +
          "  data, or NAME:ROLE=FILE for a map with a name of its own: --map dirt:mask=dirt.png\n");
  options.explain_extra([arguments](const std::string& extra) { return explained_extra(*arguments, extra); });
  return [arguments](Console& console) { return run_bake(*arguments, console); };
}

} // namespace

Verb bake_verb() {
  return {"bake", "make a tile pack from a texture sample or a set of material maps",
          "  tilepack bake gravel.png -o gravel.pack --tile-size 128 --colors 2\n"
          "  tilepack bake rock.png -o rock.pack --map normal=rock_normal.png --preset terrain --seed 7\n"
          "  tilepack bake gravel.png -o gravel.pack --report gravel.html\n"
          "  tilepack bake materials/rock -o rock.pack\n"
          "  tilepack bake --transition pebbles.png sand.png -o beach.pack\n",
          declare_bake};
}

} // namespace tilepack::cli
