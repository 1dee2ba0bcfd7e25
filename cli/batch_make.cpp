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

void make_bake(const BakeJob& job, const Progress& progress) {
  BakeSummary story{title_of(job), {}, {}};
  JobWatch watch;
  watch.progress = [&](std::string_view, std::string_view stage, double done) {
    report(progress, stage, done);
  };
  std::string remark; // of a verdict that refused the set
  JudgingWatch judging;
  judging.refused = [&](const BakeFacts& facts) {
    const auto remarks = bake_verdict(facts).remarks;
    if (!remarks.empty()) remark = spelled(remarks.front().text, FieldSpelling::json);
  };
  judge(job, watch, story.facts, !job.report.empty(), judging);
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
}

// Runs the words of a command line in this process; what it prints is added to `data`, also if it throws.
void run_words(const std::vector<std::string>& words, std::string& data, const Progress& progress) {
  const auto verbs = verb_table();
  const auto verb =
      std::find_if(verbs.begin(), verbs.end(), [&](const Verb& v) { return v.name == words.front(); });
  if (verb == verbs.end()) throw Error(ErrorKind::internal, "", "there is no verb " + words.front());
  Console console("tilepack " + verb->name, data, progress);
  Options options({"tilepack " + verb->name, verb->summary, verb->example, verb->more});
  options.flag("-q,--quiet", console.quiet, "");
  const Action action = verb->declare(options);
  options.parse({words.begin() + 1, words.end()});
  if (const int code = action(console); code != 0)
    throw Error(static_cast<ErrorKind>(code - 1), "", fmt::format("ended with exit code {}", code));
}

} // namespace

void make_entry(const Manifest& manifest, const BatchEntry& entry, const Progress& progress) {
  fs::create_directories(fs::absolute(entry.output).parent_path());
  if (entry.verb->name == "bake") {
    make_bake(bake_job_of(manifest, entry), progress);
    return;
  }
  std::string data;
  const bool is_printed = entry.verb->output == BatchOutput::printed;
  try {
    run_words(command_of(entry), data, progress);
  } catch (const Error& error) {
    std::string what = error.what_happened();
    if (error.kind() == ErrorKind::check_failed && is_printed) {
      // What it found is worth reading, but no output: without a record it is checked again.
      std::error_code unused;
      fs::remove(side_file_of(entry.output, false), unused);
      write_text_file(entry.output, data);
      what += fmt::format(" (what it printed is in {})", entry.output);
    }
    const ErrorKind kind = error.kind() == ErrorKind::usage ? ErrorKind::invalid_content : error.kind();
    throw Error(kind, place_in(manifest, entry.at),
                error.where().empty() ? what : error.where() + ": " + what);
  }
  if (is_printed) write_text_file(entry.output, data);
}

} // namespace tilepack::cli
