#include "batch_make.h"

#include "bake_judging.h"
#include "bake_report.h"
#include "batch_command.h"
#include "console.h"
#include "verb.h"

#include "tilepack/bake/text_file.h"
#include "tilepack/batch/build_record.h"
#include "tilepack/error/error.h"
#include "tilepack/report/bake_page.h"
#include "tilepack/report/bake_verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace tilepack::cli {
namespace {

namespace fs = std::filesystem;

EntryStory make_bake(const BakeJob& job, const Progress& progress) {
  BakeSummary story{title_of(job), {}, {}};
  EntryStory told;
  JobWatch watch;
  watch.progress = [&](std::string_view, std::string_view stage, double done) {
    report(progress, stage, done);
  };
  watch.note = [&](std::string_view line) { told.notes.emplace_back(line); };
  std::string remark; // of a verdict that refused the set
  JudgingWatch judging;
  judging.note = watch.note;
  judging.refused = [&](const BakeFacts& facts) {
    const auto remarks = bake_verdict(facts).remarks;
    if (!remarks.empty()) remark = spelled(remarks.front().text, FieldSpelling::json);
  };
  judge(job, watch, story.facts, true, judging);
  watch.page = [&](const BakedJob& baked) {
    story.stages = baked.stages;
    return bake_page(story, baked.made, baked.samples);
  };
  try {
    run(job, watch);
  } catch (const Error& error) {
    if (remark.empty()) throw;
    throw Error(error.kind(), job.place, fmt::format("{} ({})", error.what_happened(), remark));
  }
  const BakeVerdict verdict = bake_verdict(story.facts);
  told.verdict = name_of(verdict.grade);
  for (const BakeRemark& one : verdict.remarks)
    if (one.grade != Grade::good) told.remarks.push_back(one.text);
  return told;
}

// The verb of an entry with its words, ready to run. What it prints is added to `data`, also if it throws.
class WordsOfEntry {
public:
  WordsOfEntry(const Manifest& manifest, const BatchEntry& entry, std::string& data, const Progress& progress)
      : verb(verb_of(entry)), console("tilepack " + verb.name, data, notes, progress),
        options({"tilepack " + verb.name, verb.summary, verb.example, verb.more}) {
    options.flag("-q,--quiet", console.quiet, "");
    action = verb.declare(options);
    check_option_names(manifest, entry, options);
    const std::vector<std::string> words = command_of(entry);
    try {
      options.parse({words.begin() + 1, words.end()});
    } catch (const Error& error) {
      throw in_manifest(manifest, entry, options, error);
    }
  }

  int run() { return action(console); }
  const Options& known() const { return options; }

  std::vector<std::string> notes;

private:
  static const Verb& verb_of(const BatchEntry& entry) {
    const auto verbs = verb_table();
    const auto verb =
        std::find_if(verbs.begin(), verbs.end(), [&](const Verb& v) { return v.name == entry.verb->name; });
    if (verb == verbs.end())
      throw Error(ErrorKind::internal, "", "there is no verb " + std::string(entry.verb->name));
    return *verb;
  }

  const Verb& verb;
  Console console;
  Options options;
  Action action;
};

} // namespace

void check_entry_words(const Manifest& manifest, const BatchEntry& entry) {
  if (entry.verb->name == "bake") return; // its options were looked at with its inputs
  std::string unused;
  const WordsOfEntry checked(manifest, entry, unused, {});
}

EntryStory make_entry(const Manifest& manifest, const BatchEntry& entry, const Progress& progress) {
  fs::create_directories(fs::absolute(entry.output).parent_path());
  if (entry.verb->name == "bake") return make_bake(bake_job_of(manifest, entry), progress);
  std::string data;
  const bool is_printed = entry.verb->output == BatchOutput::printed;
  WordsOfEntry words(manifest, entry, data, progress);
  try {
    if (const int code = words.run(); code != 0)
      throw Error(static_cast<ErrorKind>(code - 1), "", fmt::format("ended with exit code {}", code));
  } catch (const Error& error) {
    const Error told = in_manifest(manifest, entry, words.known(), error);
    if (error.kind() != ErrorKind::check_failed || !is_printed) throw told;
    // What it found is worth reading, but no output: without a record it is checked again.
    std::error_code unused;
    fs::remove(side_file_of(entry.output, false), unused);
    write_text_file(entry.output, data);
    throw Error(told.kind(), told.where(),
                fmt::format("{} (what it printed is in {})", told.what_happened(), entry.output));
  }
  if (is_printed) write_text_file(entry.output, data);
  return {"", {}, words.notes};
}

} // namespace tilepack::cli
