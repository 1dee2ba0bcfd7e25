#include "batch_command.h"

#include "tilepack/error/nearest_name.h"
#include "tilepack/numeric/enum_names.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <string_view>

namespace tilepack::cli {
namespace {

// None of the command line is an option of an entry.
bool is_left_out(const BatchOption& option) {
  return option.name == "jobs" || option.name == "quiet";
}

const OptionText* option_called(const std::vector<OptionText>& known, const std::string& name) {
  const auto found = std::find_if(known.begin(), known.end(), [&](const OptionText& option) {
    return std::find(option.names.begin(), option.names.end(), "--" + name) != option.names.end();
  });
  return found == known.end() ? nullptr : &*found;
}

std::string place_of_option(const Manifest& manifest, const BatchOption& option) {
  return fmt::format("{}: \"{}\"", place_in(manifest, option.at), option.name);
}

// "--scale" as "\"scale\"", where it is one of the options.
std::string with_json_names(const std::string& text, const std::vector<OptionText>& known) {
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    const bool begins =
        text.compare(at, 2, "--") == 0 && (at == 0 || text[at - 1] == ' ' || text[at - 1] == '(');
    std::size_t end = at + 2;
    while (begins && end < text.size() &&
           (std::islower(static_cast<unsigned char>(text[end])) || text[end] == '-'))
      ++end;
    const std::string name = begins ? text.substr(at + 2, end - at - 2) : "";
    if (name.empty() || option_called(known, name) == nullptr) {
      result += text[at++];
      continue;
    }
    result += fmt::format("\"{}\"", name);
    at = end;
  }
  return result;
}

} // namespace

std::vector<std::string> command_of(const BatchEntry& entry) {
  std::vector<std::string> words{std::string(entry.verb->name)};
  for (const MaterialFile& map : entry.maps) {
    const std::string role(name_of(map.role));
    words.push_back("--map");
    words.push_back((map.name == role ? role : map.name + ":" + role) + "=" + map.file);
  }
  if (!entry.preset.empty()) words.insert(words.end(), {"--preset", entry.preset});
  for (const BatchOption& option : entry.options) {
    if (is_left_out(option)) continue;
    for (const std::string& value : option.values) {
      if (!option.is_flag)
        words.push_back(fmt::format("--{}={}", option.name, value)); // a value may begin with a dash
      else if (value == "true") // off is what a flag is without being named
        words.push_back("--" + option.name);
    }
  }
  if (entry.verb->output != BatchOutput::printed) words.insert(words.end(), {"-o", entry.output});
  words.push_back("--");
  words.insert(words.end(), entry.sources.begin(), entry.sources.end());
  return words;
}

void check_option_names(const Manifest& manifest, const BatchEntry& entry, const Options& known) {
  const std::vector<OptionText> options = known.listed();
  for (const BatchOption& option : entry.options) {
    if (is_left_out(option)) continue;
    const auto refuse = [&](const std::string& what) {
      throw Error(ErrorKind::invalid_content, place_of_option(manifest, option), what);
    };
    const OptionText* const found = option_called(options, option.name);
    if (found == nullptr) {
      std::vector<std::string> names;
      for (const OptionText& one : options)
        for (const std::string& name : one.names)
          if (name.rfind("--", 0) == 0) names.push_back(name.substr(2));
      const std::string nearest = nearest_name(option.name, names);
      refuse(fmt::format("is no option of {}{}", entry.verb->name,
                         nearest.empty() ? "" : fmt::format("; did you mean \"{}\"?", nearest)));
    }
    if (found->value.empty() && !option.is_flag)
      refuse(fmt::format("'{}' is not allowed; it must be true or false", option.values.front()));
    if (!found->value.empty() && option.is_flag)
      refuse(fmt::format("needs a value ({}), and is {}", found->value, option.values.front()));
  }
}

Error in_manifest(const Manifest& manifest, const BatchEntry& entry, const Options& known,
                  const Error& error) {
  const std::vector<OptionText> options = known.listed();
  const ErrorKind kind = error.kind() == ErrorKind::usage ? ErrorKind::invalid_content : error.kind();
  std::string where = error.where(), what = error.what_happened();
  // What CLI11 refuses has the option at its beginning: "--scale: '0' is not allowed".
  if (const std::size_t colon = what.find(": ");
      where.empty() && what.rfind("--", 0) == 0 && colon < what.find(' ')) {
    where = what.substr(0, colon);
    what.erase(0, colon + 2);
  }
  what = with_json_names(what, options);
  // "--lang is required: add --lang glsl|hlsl"
  if (const std::size_t required = what.find(" is required"); where.empty() && required != what.npos) {
    where = what.substr(0, required);
    what = fmt::format("is missing among the \"options\" of {}", entry.verb->name);
  }
  const std::string name = !error.field().empty()      ? error.field()
                           : where.rfind("--", 0) == 0 ? where.substr(2)
                                                       : "";
  const auto option = std::find_if(entry.options.begin(), entry.options.end(),
                                   [&](const BatchOption& one) { return one.name == name; });
  if (option != entry.options.end()) return Error(kind, place_of_option(manifest, *option), what);
  where = with_json_names(where, options);
  return Error(kind, place_in(manifest, entry.at), where.empty() ? what : fmt::format("{}: {}", where, what));
}

} // namespace tilepack::cli
