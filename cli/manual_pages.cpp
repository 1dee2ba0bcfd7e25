#include "manual_pages.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sstream>

namespace tilepack::cli {
namespace {

// A text as troff prints it: no request at the start of a line, hyphens that can be copied.
std::string plain(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '\\')
      result += "\\e";
    else if (c == '-')
      result += "\\-";
    else
      result += c;
  }
  if (!result.empty() && (result.front() == '.' || result.front() == '\'')) result.insert(0, "\\&");
  return result;
}

std::string lines(const std::string& text) {
  std::istringstream stream(text);
  std::string result;
  for (std::string line; std::getline(stream, line);) {
    const std::size_t start = line.find_first_not_of(' ');
    result += plain(start == std::string::npos ? "" : line.substr(start)) + "\n";
  }
  return result;
}

std::string header(const std::string& name) {
  return fmt::format(".TH {} 1 \"\" \"tilepack {}\" \"User Commands\"\n", name, TILEPACK_VERSION);
}

std::string option_entry(const OptionText& option) {
  std::string names;
  for (const std::string& name : option.names)
    names += fmt::format("{}\\fB{}\\fR", names.empty() ? "" : ", ", plain(name));
  if (!option.value.empty()) names += fmt::format(" \\fI{}\\fR", plain(option.value));
  return fmt::format(".TP\n{}\n{}{}\n", names, plain(option.help),
                     option.is_required && !option.is_positional ? " (required)" : "");
}

} // namespace

std::vector<OptionText> options_of(const Verb& verb) {
  Options options({"tilepack " + verb.name, verb.summary, verb.example, verb.more});
  bool quiet = false;
  options.flag("-q,--quiet", quiet, "no progress, notes and warnings");
  verb.declare(options);
  return options.listed();
}

std::string manual_of(const Verb& verb) {
  const std::vector<OptionText> options = options_of(verb);
  std::string text = header("TILEPACK-" + verb.name);
  text += fmt::format(".SH NAME\ntilepack\\-{} \\- {}\n", verb.name, plain(verb.summary));
  text += fmt::format(".SH SYNOPSIS\n\\fBtilepack {}\\fR [\\fIOPTIONS\\fR]", verb.name);
  for (const OptionText& option : options)
    if (option.is_positional && option.is_required)
      text += fmt::format(" \\fI{}\\fR", option.names.front());
    else if (option.is_positional)
      text += fmt::format(" [\\fI{}\\fR]", option.names.front());
  text += '\n';
  std::string group = "-";
  for (const bool positional : {true, false})
    for (const OptionText& option : options) {
      if (option.is_positional != positional) continue;
      const std::string heading = positional ? "ARGUMENTS" : option.group.empty() ? "OPTIONS" : option.group;
      if (heading != group) text += fmt::format(".SH \"{}\"\n", plain(heading));
      group = heading;
      text += option_entry(option);
    }
  text += ".SH EXAMPLES\n.nf\n" + lines(verb.example) + ".fi\n";
  return text + ".SH \"SEE ALSO\"\n.BR tilepack (1)\n";
}

std::string manual_of_all() {
  std::string text = header("TILEPACK");
  text +=
      ".SH NAME\ntilepack \\- turns texture samples into tile packs, and renders, measures and checks them\n"
      ".SH SYNOPSIS\n\\fBtilepack\\fR \\fIVERB\\fR [\\fIOPTIONS\\fR]\n.SH VERBS\n";
  for (const Verb& verb : verb_table())
    text += fmt::format(".TP\n\\fBtilepack\\-{}\\fR(1)\n{}\n", verb.name, plain(verb.summary));
  text += ".SH \"EXIT STATUS\"\n";
  int code = 0;
  for (const char* meaning : {"ok", "usage", "cannot read", "invalid content", "cannot write",
                              "a check failed or images differ", "internal error"})
    text += fmt::format(".TP\n{}\n{}\n", code++, meaning);
  text += ".SH ENVIRONMENT\n.TP\nNO_COLOR\nno color in messages, if it is not empty\n.SH \"SEE ALSO\"\n";
  const char* comma = "";
  for (const Verb& verb : verb_table()) {
    text += fmt::format("{}.BR tilepack\\-{} (1)", comma, verb.name);
    comma = ",\n";
  }
  return text + "\n";
}

} // namespace tilepack::cli
