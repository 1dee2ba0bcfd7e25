#include "bake_field_options.h"

#include <fmt/core.h>

namespace tilepack::cli {
namespace {

// In all other verbs --format is what the summary is printed as.
Check no_report_format(const BakeField& field) {
  return [field](const std::string& text) {
    if (text != "json" && text != "text") return std::string();
    return fmt::format("'{0}' is not allowed; it must be {1}, for the images of the pack: "
                       "--report-format {0} is for what is printed",
                       text, field.value);
  };
}

} // namespace

void add_field_option(Options& options, const BakeField& field, std::map<std::string, std::string>& values) {
  if (field.type == BakeFieldType::flag) {
    options.switch_flag(
        field.name, [&values, name = field.name](bool on) { values[name] = on ? "true" : "false"; },
        field.help);
    return;
  }
  Option option = options.option(
      "--" + field.name, [&values, name = field.name](const std::string& text) { values[name] = text; },
      field.help);
  option.value(field.value);
  if (field.name == "format") option.check(no_report_format(field));
}

} // namespace tilepack::cli
