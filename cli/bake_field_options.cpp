#include "bake_field_options.h"

#include <fmt/format.h>

namespace tilepack::cli {
namespace {

// In all other verbs --format is what the summary is printed as.
CLI::Validator no_report_format(const BakeField& field) {
  return CLI::Validator(
      [field](const std::string& text) {
        if (text != "json" && text != "text") return std::string();
        return fmt::format("'{0}' is not allowed; it must be {1}, for the images of the pack: "
                           "--report-format {0} is for what is printed",
                           text, field.value);
      },
      "");
}

} // namespace

void add_field_option(CLI::App& app, const BakeField& field, std::map<std::string, std::string>& values) {
  const auto store = [&values, name = field.name](const std::string& value) { values[name] = value; };
  if (field.type == BakeFieldType::flag) {
    app.add_flag_function(
        fmt::format("--{0},!--no-{0}", field.name),
        [store](std::int64_t count) { store(count > 0 ? "true" : "false"); }, field.help);
    return;
  }
  CLI::Option* option = app.add_option_function<std::string>("--" + field.name, store, field.help);
  option->type_name(field.value);
  if (field.name == "format") option->check(no_report_format(field));
}

} // namespace tilepack::cli
