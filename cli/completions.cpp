#include "completions.h"

#include "manual_pages.h"
#include "verb.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <vector>

namespace tilepack::cli {
namespace {

// "text|json": words, of which none is a place for something to be put in ("NAME|FILE", "N|WxH|auto").
std::vector<std::string> choices(const std::string& value) {
  std::vector<std::string> words;
  for (std::size_t at = 0; at <= value.size();) {
    const std::size_t end = std::min(value.find('|', at), value.size());
    words.push_back(value.substr(at, end - at));
    at = end + 1;
  }
  const bool listed =
      words.size() > 1 && std::all_of(words.begin(), words.end(), [](const std::string& word) {
        return !word.empty() &&
               std::none_of(word.begin(), word.end(), [](unsigned char c) { return std::isupper(c); });
      });
  return listed ? words : std::vector<std::string>{};
}

bool takes_files(const std::string& value) {
  return value.find("FILE") != std::string::npos || value.find("DIR") != std::string::npos ||
         value == "IMAGE";
}

// For single quotes of bash and zsh, and for fish's.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

std::string fish_quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' || c == '\\' ? std::string("\\") + c : std::string(1, c);
  return result + "'";
}

std::vector<std::string> verb_names() {
  std::vector<std::string> names;
  for (const Verb& verb : verb_table()) names.push_back(verb.name);
  names.emplace_back("help");
  return names;
}

std::string bash() {
  std::string text =
      "# Completion of tilepack for bash.\n"
      "_tilepack() {\n"
      "  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} verb=${COMP_WORDS[1]}\n"
      "  COMPREPLY=()\n";
  text += fmt::format(
      "  if [ \"$COMP_CWORD\" -eq 1 ] || {{ [ \"$COMP_CWORD\" -eq 2 ] && [ \"$verb\" = help ]; }}; then\n"
      "    COMPREPLY=($(compgen -W '{} --version' -- \"$word\"))\n    return\n  fi\n",
      fmt::join(verb_names(), " "));
  text += "  local options=\n  case $verb in\n";
  for (const Verb& verb : verb_table()) {
    std::string names, cases;
    for (const OptionText& option : options_of(verb)) {
      if (option.is_positional) continue;
      names += fmt::format("{}{}", names.empty() ? "" : " ", fmt::join(option.names, " "));
      const auto words = choices(option.value);
      const std::string pattern = fmt::format("{}", fmt::join(option.names, "|"));
      if (!words.empty())
        cases += fmt::format("        {}) COMPREPLY=($(compgen -W '{}' -- \"$word\")); return ;;\n", pattern,
                             fmt::join(words, " "));
      else if (!option.value.empty() && takes_files(option.value))
        cases += fmt::format("        {}) COMPREPLY=($(compgen -f -- \"$word\")); return ;;\n", pattern);
      else if (!option.value.empty())
        cases += fmt::format("        {}) return ;;\n", pattern);
    }
    text += fmt::format("    {})\n      case $before in\n{}      esac\n      options='{}' ;;\n", verb.name,
                        cases, names);
  }
  return text + "  esac\n"
                "  case $word in\n"
                "    -*) COMPREPLY=($(compgen -W \"$options\" -- \"$word\")) ;;\n"
                "    *) COMPREPLY=($(compgen -f -- \"$word\")) ;;\n"
                "  esac\n}\n"
                "complete -o filenames -F _tilepack tilepack\n";
}

std::string zsh_help(const std::string& help) {
  std::string result;
  for (const char c : help)
    result += c == ':' || c == '[' || c == ']' || c == '\\' ? std::string("\\") + c : std::string(1, c);
  return result;
}

std::string zsh() {
  std::string text =
      "#compdef tilepack\n# Completion of tilepack for zsh.\n_tilepack() {\n  local -a verbs\n  verbs=(\n";
  for (const Verb& verb : verb_table())
    text += fmt::format("    {}\n", quoted(verb.name + ":" + zsh_help(verb.summary)));
  text += "    'help:the list of verbs, or the help of one'\n  )\n"
          "  if (( CURRENT == 2 )) || [[ $words[2] == help && CURRENT -eq 3 ]]; then\n    _describe verb "
          "verbs\n    return\n  fi\n"
          "  local verb=$words[2]\n  shift words\n  (( CURRENT-- ))\n  case $verb in\n";
  for (const Verb& verb : verb_table()) {
    text += fmt::format("    {})\n      _arguments", verb.name);
    for (const OptionText& option : options_of(verb)) {
      if (option.is_positional) continue;
      const auto words = choices(option.value);
      std::string action;
      if (!words.empty())
        action = fmt::format(":{}:({})", "value", fmt::join(words, " "));
      else if (!option.value.empty())
        action = fmt::format(":{}:{}", zsh_help(option.value), takes_files(option.value) ? "_files" : "");
      for (const std::string& name : option.names)
        text += fmt::format(" \\\n        {}",
                            quoted(fmt::format("*{}[{}]{}", name, zsh_help(option.help), action)));
    }
    text += " \\\n        '*:file:_files' ;;\n";
  }
  return text + "  esac\n}\n_tilepack \"$@\"\n";
}

std::string fish() {
  std::string text = "# Completion of tilepack for fish.\ncomplete -c tilepack -n __fish_use_subcommand -f\n";
  for (const Verb& verb : verb_table())
    text += fmt::format("complete -c tilepack -n __fish_use_subcommand -a {} -d {}\n", verb.name,
                        fish_quoted(verb.summary));
  text +=
      "complete -c tilepack -n __fish_use_subcommand -a help -d 'the list of verbs, or the help of one'\n";
  for (const Verb& verb : verb_table())
    for (const OptionText& option : options_of(verb)) {
      if (option.is_positional) continue;
      text += fmt::format("complete -c tilepack -n '__fish_seen_subcommand_from {}'", verb.name);
      for (const std::string& name : option.names)
        text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
      const auto words = choices(option.value);
      if (!words.empty())
        text += fmt::format(" -x -a '{}'", fmt::join(words, " "));
      else if (!option.value.empty())
        text += takes_files(option.value) ? " -r -F" : " -x";
      text += fmt::format(" -d {}\n", fish_quoted(option.help));
    }
  return text;
}

} // namespace

std::string completion_for(const std::string& shell) {
  return shell == "bash" ? bash() : shell == "zsh" ? zsh() : fish();
}

} // namespace tilepack::cli
