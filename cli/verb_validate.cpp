#include "jobs.h"
#include "verb.h"

#include "tilepack/verify/folder_checks.h"

#include <fmt/format.h>

#include <memory>
#include <string>

namespace tilepack::cli {
namespace {

struct ValidateArguments {
  std::string pack;
  std::string format = "text";
  bool list_rules = false;
  int jobs = 0;
};

int run_validate(const ValidateArguments& arguments, Console& console) {
  const bool json = arguments.format == "json";
  if (arguments.list_rules) {
    console.print(json ? rules_json() : rules_text());
    return 0;
  }
  if (arguments.pack.empty()) throw Error(ErrorKind::usage, "", "PACK is required");
  const JobLimit limit(arguments.jobs);
  const Report report = check_folder(arguments.pack, console.progress());
  console.print(json ? report_json(report) : report_text(report));
  if (!passed(report))
    throw Error(
        ErrorKind::check_failed, arguments.pack,
        fmt::format("errors: {}; the report on stdout says what and where", count(report.issues).errors));
  return 0;
}

Action declare_validate(CLI::App& app) {
  auto arguments = std::make_shared<ValidateArguments>();
  app.add_option("PACK", arguments->pack, "folder or pack.json")->type_name("");
  app.add_option("--format", arguments->format, "of the report on stdout")
      ->check(CLI::IsMember({"text", "json"}))
      ->type_name("text|json");
  app.add_flag("--list-rules", arguments->list_rules, "show every rule with its number and end");
  add_jobs_option(app, arguments->jobs);
  return [arguments](Console& console) { return run_validate(*arguments, console); };
}

} // namespace

Verb validate_verb() {
  return {"validate", "check that a pack is whole and keeps its promises",
          "  tilepack validate gravel.pack\n"
          "  tilepack validate gravel.pack --format json\n"
          "Exit code 0 if there is no error (warnings and notes are allowed), 5 if there is one.\n",
          declare_validate};
}

} // namespace tilepack::cli
