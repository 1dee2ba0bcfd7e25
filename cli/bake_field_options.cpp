#include "bake_field_options.h"

#include "value_check.h"

#include <fmt/core.h>

#include <algorithm>

namespace tilepack::cli {
namespace {

const char* heading_of(FieldScope scope) {
  switch (scope) {
  case FieldScope::tiles:
    return "How tiles are made";
  case FieldScope::material:
    return "Levels of materials";
  case FieldScope::packing:
    break;
  }
  return "How tiles are stored";
}

std::string help_of(const BakeField& field) {
  const std::string usual = field.get(bake_options({}));
  if (usual.empty()) return field.help;
  if (field.type == BakeFieldType::flag)
    return fmt::format("{} (default {})", field.help, usual == "true" ? "yes" : "no");
  return fmt::format("{} (default {})", field.help, usual);
}

void add_field_option(Options& options, const BakeField& field, std::map<std::string, std::string>& values) {
  if (field.type == BakeFieldType::flag) {
    options.switch_flag(
        field.name, [&values, name = field.name](bool on) { values[name] = on ? "true" : "false"; },
        help_of(field));
    return;
  }
  options
      .option(
          "--" + field.name, [&values, name = field.name](const std::string& text) { values[name] = text; },
          help_of(field))
      .value(field.value);
}

bool names_images(const std::string& format) {
  return format != "text" && format != "json";
}

} // namespace

void add_field_options(Options& options, std::span<const BakeField> fields,
                       std::span<const std::string_view> first, std::map<std::string, std::string>& values) {
  const auto is_first = [&](const BakeField& field) {
    return std::find(first.begin(), first.end(), field.name) != first.end();
  };
  options.group(most_used);
  for (const std::string_view name : first)
    for (const BakeField& field : fields)
      if (field.name == name) add_field_option(options, field, values);
  for (const BakeField& field : fields) {
    if (is_first(field)) continue;
    options.group(heading_of(field.scope));
    add_field_option(options, field, values);
  }
  options.group("");
}

bool PrintedFormat::json() const {
  const auto last =
      std::find_if(given.rbegin(), given.rend(), [](const auto& f) { return !names_images(f); });
  return (last == given.rend() ? old_name : *last) == "json";
}

bool PrintedFormat::asked_for() const {
  return !old_name.empty() ||
         std::any_of(given.begin(), given.end(), [](const auto& format) { return !names_images(format); });
}

std::string PrintedFormat::settle(std::map<std::string, std::string>& values) {
  std::string now;
  for (const std::string& format : given) {
    if (!names_images(format)) continue;
    values.try_emplace("image-format", format);
    now = fmt::format(
        "--format {0} is written --image-format {0} now; --format is what is printed, text or json", format);
  }
  if (now.empty() && !old_name.empty())
    now = fmt::format("--report-format {0} is written --format {0} now", old_name);
  return now;
}

void add_printed_format(Options& options, PrintedFormat& format) {
  options.option("--format", format.given, "what is printed on stdout (default text)")
      .check([](const std::string& text) {
        const bool known = text == "text" || text == "json" || text == "png" || text == "exr";
        return known ? std::string()
                     : fmt::format(
                           "'{}' is not allowed; it must be text or json, for what is printed: the images "
                           "of the pack go by --image-format png or exr",
                           text);
      })
      .value("text|json");
  options.option("--report-format", format.old_name, "").one_of("text|json").hidden();
}

} // namespace tilepack::cli
