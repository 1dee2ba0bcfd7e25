#include "batch_display.h"
#include "batch_make.h"
#include "build_rules.h"
#include "byte_size.h"
#include "interrupt.h"
#include "jobs.h"
#include "value_check.h"
#include "verb.h"

#include "tilepack/bake/depfile.h"
#include "tilepack/bake/text_file.h"
#include "tilepack/batch/batch_run.h"
#include "tilepack/batch/entry_choice.h"
#include "tilepack/batch/file_watch.h"
#include "tilepack/batch/left_outputs.h"
#include "tilepack/batch/written_files.h"
#include "tilepack/error/error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace tilepack::cli {
namespace {

struct BatchArguments {
  std::string manifest;
  std::vector<std::string> only;
  std::string shard;
  std::string memory;
  std::string cache;
  std::string cache_size;
  std::string depfile;
  std::string stamp;
  std::string log_format = "text";
  std::string emit;
  std::string rules;
  bool watch = false;
  bool dry_run = false;
  bool changed = false;
  bool all = false;
  bool verbose = false;
  bool wait = true;
  int jobs = 0;
};

// How rules call this program.
std::string program_path() {
  std::error_code fault;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", fault);
  return fault ? "tilepack" : self.string();
}

BatchSettings settings_from(const BatchArguments& arguments) {
  if (arguments.all && arguments.changed)
    throw Error(ErrorKind::usage, "--all",
                "makes everything, and --changed only what changed; give one of them");
  if (!arguments.cache_size.empty() && arguments.cache.empty())
    throw Error(ErrorKind::usage, "--cache-size", "goes with --cache");
  BatchSettings settings;
  settings.jobs = arguments.jobs;
  if (!arguments.memory.empty()) settings.memory = parsed_byte_size("--memory", arguments.memory);
  settings.cache = arguments.cache;
  if (!arguments.cache_size.empty())
    settings.cache_size = parsed_byte_size("--cache-size", arguments.cache_size);
  settings.all = arguments.all;
  settings.when_busy = arguments.wait ? WhenBusy::wait : WhenBusy::refuse;
  return settings;
}

int worst_code(const std::vector<EntryResult>& results) {
  int code = 0;
  for (const EntryResult& result : results)
    if (result.end == EntryEnd::failed) code = std::max(code, exit_code(result.kind));
  return code;
}

// What would be made, but for options that its verb refuses.
void refuse_words(const Manifest& manifest, std::vector<EntryResult>& plan) {
  for (EntryResult& result : plan) {
    if (result.end != EntryEnd::built) continue;
    try {
      check_entry_words(manifest, manifest.entries[result.entry]);
    } catch (const Error& error) {
      result.end = EntryEnd::failed;
      result.message = fmt::format("{}: {}", error.where(), error.what_happened());
      result.kind = error.kind();
    }
  }
}

// What would be made and why, on stdout.
int print_plan(const Manifest& manifest, const std::vector<EntryResult>& results, bool verbose,
               Console& console) {
  std::string text;
  std::size_t made = 0;
  for (const EntryResult& result : results) {
    const std::string& name = manifest.entries[result.entry].name;
    made += result.end == EntryEnd::built ? 1 : 0;
    if (result.end == EntryEnd::built) text += fmt::format("{}: {}\n", name, fmt::join(result.reasons, ", "));
    if (result.end == EntryEnd::failed)
      text += fmt::format("{}: can't be made: {}\n", name, spelled(result.message, FieldSpelling::json));
    if (result.end == EntryEnd::current && verbose) text += fmt::format("{}: current\n", name);
  }
  for (const std::string& output : left_outputs(manifest))
    text += fmt::format("{}: left by an earlier run, no entry of this manifest makes it\n", output);
  console.print(text + fmt::format("{} of {} would be made\n", made, results.size()));
  return worst_code(results);
}

// Files beside those of entries, by who asks for them.
std::vector<OutputFile> side_files(const BatchArguments& arguments) {
  return {{"--output", arguments.rules}, {"--depfile", arguments.depfile}, {"--stamp", arguments.stamp}};
}

void write_depfile(const BatchArguments& arguments, const Manifest& manifest,
                   const std::vector<std::size_t>& chosen) {
  if (arguments.depfile.empty() || manifest.entries.empty()) return;
  const std::string target = arguments.stamp.empty()
                                 ? target_of(manifest.entries[chosen.empty() ? 0 : chosen.front()])
                                 : arguments.stamp;
  write_text_file(arguments.depfile, depfile_text(target, files_read(manifest, chosen)));
}

// The rules of a build system on stdout, or in their file.
void print_rules(const BatchArguments& arguments, const Manifest& manifest,
                 const std::vector<std::size_t>& chosen, Console& console) {
  RuleSettings rules{program_path(), "", arguments.rules};
  if (!arguments.cache.empty()) rules.arguments += "--cache " + shell_word(arguments.cache);
  const std::string text = (arguments.emit == "ninja" ? ninja_rules : make_rules)(manifest, chosen, rules);
  if (arguments.rules.empty())
    console.print(text);
  else
    write_text_file(arguments.rules, text);
}

// Nothing is asked for but that all be current, and to be told how many there are.
bool is_plain(const BatchArguments& arguments) {
  return arguments.only.empty() && arguments.shard.empty() && arguments.cache_size.empty() &&
         arguments.depfile.empty() && arguments.stamp.empty() && arguments.log_format == "text" &&
         arguments.emit.empty() && !arguments.watch && !arguments.dry_run && !arguments.all &&
         !arguments.verbose;
}

int run_once(const BatchArguments& arguments, Console& console) {
  const BatchSettings settings = settings_from(arguments);
  if (is_plain(arguments))
    if (const auto entries = entries_if_all_current(arguments.manifest)) {
      BatchDisplay(console, {}, LogFormat::text, false).summary(std::vector<EntryResult>(*entries));
      return 0;
    }
  const Manifest manifest = read_manifest(arguments.manifest);
  const std::vector<std::size_t> chosen = chosen_entries(manifest, arguments.only, arguments.shard);
  check_beside_entries(manifest, side_files(arguments));
  if (!arguments.emit.empty()) {
    print_rules(arguments, manifest, chosen, console);
    return 0;
  }
  if (arguments.dry_run) {
    std::vector<EntryResult> plan = planned_batch(manifest, chosen, settings);
    refuse_words(manifest, plan);
    return print_plan(manifest, plan, arguments.verbose, console);
  }
  BatchDisplay display(console, manifest, arguments.log_format == "json" ? LogFormat::json : LogFormat::text,
                       arguments.verbose);
  display.expect(chosen.size());
  BatchWatch watch;
  watch.make = make_entry;
  watch.started = [&](std::size_t entry, const auto& reasons) { display.started(entry, reasons); };
  watch.progress = [&](std::size_t entry, std::string_view stage, double done) {
    if (interrupted()) throw Interrupted{"what was finished is kept"};
    display.progress(entry, stage, done);
  };
  watch.ended = [&](const EntryResult& result) { display.ended(result); };
  watch.warned = [&](std::size_t entry, std::string_view message) { display.warned(entry, message); };
  const std::vector<EntryResult> results = run_batch(manifest, chosen, settings, watch);
  if (!arguments.watch) display.summary(results);
  const int code = worst_code(results);
  write_depfile(arguments, manifest, chosen);
  if (code == 0 && !arguments.stamp.empty()) write_text_file(arguments.stamp, "");
  return code;
}

// The files that a batch hangs on, as far as the manifest can be read now; never those that it writes.
FileWatch watch_of(const BatchArguments& arguments) {
  std::vector<std::string> files{arguments.manifest}, written;
  try {
    const Manifest manifest = read_manifest(arguments.manifest);
    const auto chosen = chosen_entries(manifest, arguments.only, arguments.shard);
    for (const std::string& file : files_read(manifest, chosen)) files.push_back(file);
    for (const BatchEntry& entry : manifest.entries) {
      written.push_back(entry.output);
      written.push_back(target_of(entry));
    }
    written.push_back(index_file_of(arguments.manifest));
  } catch (const Error&) { // the run says what is wrong
  }
  return FileWatch(files, written);
}

// At once, as long as there is a manifest to be held against: a slip would be told again and again.
void refuse_side_files(const BatchArguments& arguments) {
  Manifest manifest;
  try {
    manifest = read_manifest(arguments.manifest);
  } catch (const Error&) { // the run says what is wrong
    return;
  }
  check_beside_entries(manifest, side_files(arguments));
}

int run_watching(const BatchArguments& arguments, Console& console) {
  constexpr std::chrono::milliseconds quiet{100};
  const Interrupted end{"what was finished is kept"};
  refuse_side_files(arguments);
  console.note("watching; Ctrl-C ends it");
  while (true) {
    FileWatch watch = watch_of(arguments); // before the run, so that what is saved meanwhile counts
    try {
      run_once(arguments, console);
    } catch (const Error& error) { // a manifest that is being edited
      console.error(error.message(FieldSpelling::option));
    }
    watch.wait(quiet, [&] {
      if (interrupted()) throw end;
    });
  }
}

int run_batch_verb(const BatchArguments& arguments, Console& console) {
  for (const auto& [given, name] :
       {std::pair(arguments.dry_run, "--dry-run"), std::pair(!arguments.emit.empty(), "--emit")})
    if (arguments.watch && given)
      throw Error(ErrorKind::usage, name, "makes nothing; it does not go with --watch");
  if (!arguments.rules.empty() && arguments.emit.empty())
    throw Error(ErrorKind::usage, "--output", "is where --emit writes its rules; give both");
  const JobLimit limit(arguments.jobs);
  return arguments.watch ? run_watching(arguments, console) : run_once(arguments, console);
}

Action declare_batch(Options& options) {
  auto a = std::make_shared<BatchArguments>();
  options
      .option("MANIFEST", a->manifest, "JSON list of what is to be made; manifest.schema.json describes it")
      .required();
  add_jobs_option(options, a->jobs);
  options
      .option("--memory", a->memory,
              "most that entries may need beside each other, by the estimate of each: 500M, 4G; no limit "
              "unless given")
      .value("SIZE");
  options.flag("--dry-run", a->dry_run, "say what would be made and why, and make nothing");
  options.flag("--changed", a->changed, "make what changed, which is what happens without it too");
  options.flag("--watch", a->watch, "go on, and make again what changes whenever a file is saved");
  options.flag("--all", a->all, "make everything, also what is current");
  options
      .option("--only", a->only,
              "entries with this name, or whose name matches this pattern, and what they are made from; may "
              "be repeated")
      .value("NAME");
  options
      .option("--shard", a->shard,
              "the I-th of N parts of the manifest, I from 1; other entries never move one to another part")
      .value("I/N");
  options.switch_flag(
      "wait", [a](bool on) { a->wait = on; },
      "wait for another process that writes the same output (default), or let that entry fail");
  options.group("Cache");
  options
      .option("--cache", a->cache,
              "folder that finished outputs are kept in and taken from, by the content of what they are made "
              "from; may be shared")
      .value("DIR");
  options
      .option("--cache-size", a->cache_size,
              "at the end, take out what was used longest ago until it is no larger")
      .value("SIZE");
  options.group("For build systems");
  options.option("--emit", a->emit, "print rules for a build system, one an entry, and make nothing")
      .one_of("ninja|make");
  options
      .option("-o,--output", a->rules,
              "write the rules of --emit there; they are made again when the manifest changes")
      .value("FILE");
  options.option("--depfile", a->depfile, "write a rule for make or ninja: every file that was read")
      .value("FILE");
  options
      .option("--stamp", a->stamp,
              "an empty file that is written when all is current; the target of the depfile")
      .value("FILE");
  options.group("What is told");
  options
      .option("--log-format", a->log_format,
              "lines on stderr, or one JSON object a line on stdout (batch_log.schema.json)")
      .one_of("text|json");
  options.flag("-v,--verbose", a->verbose, "name what is current too, and say why when an entry begins");
  return [a](Console& console) { return run_batch_verb(*a, console); };
}

} // namespace

Verb batch_verb() {
  return {"batch", "make everything that a manifest lists and that changed",
          "  tilepack batch textures.json\n"
          "  tilepack batch textures.json --dry-run\n"
          "  tilepack batch textures.json --jobs 8 --memory 4G --cache /mnt/share/packs\n"
          "  tilepack batch textures.json --only 'rocks/*' --watch\n"
          "  tilepack batch textures.json --emit ninja -o build.ninja && ninja\n"
          "A manifest: {\"format\": \"tilepack-manifest\", \"version\": 1,\n"
          "  \"jobs\": [{\"samples\": \"textures/*.png\", \"output\": \"packs/{stem}\"},\n"
          "           {\"verb\": \"shader\", \"packs\": \"packs/*\", \"options\": {\"lang\": \"glsl\"},\n"
          "            \"output\": \"shaders/{stem}.glsl\"}]}\n"
          "Verbs of entries: " +
              fmt::format("{}", fmt::join(batch_verb_names(), ", ")) +
              "; without one, bake.\n"
              "Exit code: the highest of all entries that failed.\n",
          declare_batch};
}

} // namespace tilepack::cli
