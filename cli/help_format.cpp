#include "help_format.h"

#include <sstream>

namespace tilepack::cli {

namespace {

constexpr std::size_t page_width = 100;

} // namespace

// CLI11 writes "--no-flag{false}" for what a flag's other name stands for; the name says it.
std::string HelpFormat::make_option_name(const CLI::Option* option, bool is_positional) const {
  std::string name = CLI::Formatter::make_option_name(option, is_positional);
  const std::string value = "{false}";
  for (std::size_t at = name.find(value); at != std::string::npos; at = name.find(value))
    name.erase(at, value.size());
  return name;
}

// CLI11 writes REQUIRED, also beside positionals.
std::string HelpFormat::make_option_opts(const CLI::Option* option) const {
  if (option->get_expected_max() == 0) return "";
  std::string text;
  if (!option->get_type_name().empty()) text += " " + option->get_type_name();
  if (option->get_positional() && option->get_expected_max() > 1) text += " ...";
  if (option->get_required() && !option->get_positional()) text += " (required)";
  return text;
}

// CLI11 indents what follows a line break.
std::string HelpFormat::make_option_desc(const CLI::Option* option) const {
  const std::size_t width = page_width - get_column_width();
  std::istringstream words(CLI::Formatter::make_option_desc(option));
  std::string text;
  std::size_t column = 0;
  for (std::string word; words >> word;) {
    if (column > 0 && column + 1 + word.size() > width) {
      text += '\n';
      column = 0;
    } else if (column > 0) {
      text += ' ';
      ++column;
    }
    text += word;
    column += word.size();
  }
  return text;
}

} // namespace tilepack::cli
