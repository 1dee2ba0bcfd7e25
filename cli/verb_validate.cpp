#include "jobs.h"
#include "value_check.h"
#include "verb.h"

#include "tilepack/check/folder_checks.h"
#include "tilepack/check/scene_checks.h"
#include "tilepack/measure/against_reference.h"
#include "tilepack/pack/pack_read.h"
#include "tilepack/report/quality_note.h"
#include "tilepack/scene/scene_file.h"

#include <fmt/format.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace tilepack::cli {
namespace {

struct ValidateArguments {
  std::string pack;
  std::string format = "text";
  bool list_rules = false;
  bool against_reference = false;
  int lookups = 4096;
  int jobs = 0;
};

int run_validate(const ValidateArguments& arguments, Console& console) {
  const bool json = arguments.format == "json";
  if (arguments.list_rules) {
    console.print(json ? rules_json() : rules_text());
    return 0;
  }
  if (arguments.pack.empty()) throw Error(ErrorKind::usage, "", "PACK is required");
  if (arguments.format == "csv" && !arguments.against_reference)
    throw Error(ErrorKind::usage, "--format", "csv holds the figures of --against-reference; give both");
  const JobLimit limit(arguments.jobs);
  std::optional<Pack> pack; // the very one that was checked
  const bool is_scene = is_scene_file(arguments.pack);
  if (is_scene && arguments.against_reference)
    throw Error(ErrorKind::usage, "--against-reference", "is for packs; name the pack, or leave it out");
  const Report report =
      is_scene ? check_scene(arguments.pack) : reading_pack(arguments.pack, [&](const PackFolder& folder) {
        Report found = check_folder(folder, arguments.pack, console.progress());
        if (passed(found)) note_quality(folder.description().pack, found);
        if (arguments.against_reference && passed(found)) pack = read_pack(folder);
        return found;
      });
  if (pack) {
    constexpr std::uint64_t seed = 1; // of the places looked at: the same figures every time
    const auto errors = against_reference(*pack, arguments.lookups, seed, console.progress());
    if (arguments.format == "csv")
      console.print(reference_errors_csv(errors));
    else if (json)
      console.print(fmt::format("{{\"structure\": {},\n\"against_reference\": {}}}\n", report_json(report),
                                reference_errors_json(errors)));
    else
      console.print(report_text(report) + "\n" + reference_errors_text(errors));
    return 0;
  }
  console.print(json ? report_json(report) : report_text(report));
  if (!passed(report))
    throw Error(
        ErrorKind::check_failed, arguments.pack,
        fmt::format("errors: {}; the report on stdout says what and where", count(report.issues).errors));
  return 0;
}

Action declare_validate(Options& options) {
  auto arguments = std::make_shared<ValidateArguments>();
  options.option("PACK", arguments->pack, "folder or pack.json of a pack, or a scene").needed();
  options
      .option("--format", arguments->format,
              "of the report on stdout; csv: the figures of --against-reference (default text)")
      .one_of("text|json|csv");
  options.flag(
      "--against-reference", arguments->against_reference,
      "also hold bilinear lookups against the virtual texture's true mips, level by level: inside tiles, "
      "across edges, at corners");
  options
      .option("--lookups", arguments->lookups,
              "with --against-reference: places looked at a zone and level, 16 to 1000000 (default 4096)")
      .check(whole_number(16, 1000000))
      .value("N");
  options.flag("--list-rules", arguments->list_rules, "show every rule with its number and end");
  add_jobs_option(options, arguments->jobs);
  return [arguments](Console& console) { return run_validate(*arguments, console); };
}

} // namespace

Verb validate_verb() {
  return {"validate", "check that a pack is whole and keeps its promises, or that a scene can be drawn",
          "  tilepack validate gravel.pack\n"
          "  tilepack validate gravel.pack --format json\n"
          "  tilepack validate landscape.json\n"
          "  tilepack validate gravel.pack --against-reference --format csv\n"
          "Exit code 0 if there is no error (warnings and notes are allowed), 5 if there is one.\n",
          declare_validate};
}

} // namespace tilepack::cli
