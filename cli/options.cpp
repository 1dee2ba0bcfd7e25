#include "options.h"

#include "tilepack/error/error.h"
#include "tilepack/error/nearest_name.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <algorithm>
#include <cstdint>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

// CLI11 takes long to compile: it is included here alone.

namespace tilepack::cli {
namespace {

constexpr std::size_t page_width = 100;
constexpr std::size_t description_column = 34;

constexpr const char* general_heading = "General";
constexpr const char* hidden_heading = "Hidden"; // in no help; CLI11 can't name options without a heading

std::string capitalized(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text;
}

// CLI11's help, with descriptions wrapped to the page and capital letters at their beginning, flags shown by
// their names alone, what must be given marked, and the general options last.
class HelpFormat : public CLI::Formatter {
public:
  HelpFormat() { column_width(description_column); }

  std::set<const CLI::Option*> needed; // beside those that CLI11 knows to be required
  std::string sections;                // ready text, shown after the options

  bool must_be_given(const CLI::Option* option) const {
    return option->get_required() || needed.count(option) != 0;
  }

  // "tilepack bake SAMPLE -o DIR [OPTIONS]"
  std::string make_usage(const CLI::App* app, std::string name) const override {
    std::string text = "Usage: " + name;
    for (const CLI::Option* option : app->get_options({})) {
      if (!option->get_positional()) continue;
      const std::string word =
          option->get_name(true) + (option->get_expected_max() > 1 ? std::string("...") : std::string());
      text += must_be_given(option) ? " " + word : " [" + word + "]";
    }
    for (const CLI::Option* option : app->get_options({}))
      if (!option->get_positional() && must_be_given(option))
        text += fmt::format(" {} {}",
                            option->get_snames().empty() ? "--" + option->get_lnames().front()
                                                         : "-" + option->get_snames().front(),
                            option->get_type_name());
    return text + " [OPTIONS]\n";
  }

  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode) const override {
    return make_description(app) + make_usage(app, std::move(name)) + make_positionals(app) + groups(app) +
           sections + make_footer(app);
  }

  // CLI11 writes "--no-flag{false}" for what a flag's other name stands for; the name says it.
  std::string make_option_name(const CLI::Option* option, bool is_positional) const override {
    std::string name = CLI::Formatter::make_option_name(option, is_positional);
    const std::string value = "{false}";
    for (std::size_t at = name.find(value); at != std::string::npos; at = name.find(value))
      name.erase(at, value.size());
    return name;
  }

  // CLI11 writes REQUIRED, also beside positionals, which the line of usage marks.
  std::string make_option_opts(const CLI::Option* option) const override {
    if (option->get_expected_max() == 0) return "";
    std::string text;
    if (!option->get_type_name().empty()) text += " " + option->get_type_name();
    if (option->get_positional() && option->get_expected_max() > 1) text += " ...";
    if (must_be_given(option) && !option->get_positional()) text += " (required)";
    return text;
  }

  // CLI11 indents what follows a line break.
  std::string make_option_desc(const CLI::Option* option) const override {
    const std::size_t width = page_width - get_column_width();
    std::istringstream words(capitalized(CLI::Formatter::make_option_desc(option)));
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

private:
  std::string groups(const CLI::App* app) const {
    std::vector<std::string> headings;
    for (const CLI::Option* option : app->get_options({})) {
      const std::string& heading = option->get_group();
      if (option->get_positional() || heading == hidden_heading || heading == general_heading) continue;
      if (std::find(headings.begin(), headings.end(), heading) == headings.end()) headings.push_back(heading);
    }
    headings.emplace_back(general_heading);
    std::string text;
    for (const std::string& heading : headings)
      text += make_group(heading, false, app->get_options([&](const CLI::Option* option) {
        return option->get_group() == heading && !option->get_positional();
      }));
    return text;
  }
};

} // namespace

class OptionParser {
public:
  explicit OptionParser(const CommandText& text)
      : app(capitalized(text.summary) + ".", text.name), more(text.more),
        common_group(app.option_defaults()->get_group()), format(std::make_shared<HelpFormat>()) {
    app.footer("\nExample:\n" + text.example);
    app.formatter(format);
    app.get_help_ptr()->group(general_heading)->description("print this help and end");
    app.option_defaults()->take_last(); // what collects says take_all itself
  }

  template <typename Value>
  int add(const std::string& names, Value& variable, const std::string& help) {
    return keep(app.add_option(names, variable, help));
  }

  int keep(CLI::Option* option) {
    if (option->get_positional()) option->type_name("");
    declared.push_back(option);
    return static_cast<int>(declared.size()) - 1;
  }

  CLI::Option& at(int index) { return *declared[static_cast<std::size_t>(index)]; }

  // CLI11 reports a missing argument before an unknown option; but what it could not place tells more, since
  // a mistyped option is what leaves arguments out of place.
  std::string explained(const CLI::ParseError& error) const {
    std::vector<std::string> extras = app.remaining();
    extras.erase(std::remove(extras.begin(), extras.end(), "--"), extras.end()); // ends the options
    const auto flag = std::find_if(extras.begin(), extras.end(), [](const std::string& argument) {
      return argument.size() > 1 && argument.front() == '-';
    });
    if (flag != extras.end()) {
      std::vector<std::string> known;
      for (const CLI::Option* option : app.get_options())
        for (const std::string& name :
             option->get_group() == hidden_heading ? std::vector<std::string>() : option->get_lnames())
          known.push_back("--" + name);
      const std::string name = flag->substr(0, flag->find('='));
      const std::string nearest = nearest_name(name, known);
      return fmt::format("unknown option '{}'{}", name,
                         nearest.empty() ? "" : fmt::format("; did you mean {}?", with_short_name(nearest)));
    }
    // A value that is refused tells more than what follows it.
    if (!extras.empty() && dynamic_cast<const CLI::ValidationError*>(&error) == nullptr) {
      const std::string told = explain_extra ? explain_extra(extras.front()) : "";
      return fmt::format("unexpected argument '{}'{}", extras.front(), told.empty() ? more : told);
    }
    if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr) {
      const std::string what = error.what(); // "--report: 1 required FILE.html missing"
      const std::string name = what.substr(0, what.find(':'));
      if (const CLI::Option* option = app.get_option_no_throw(name))
        return fmt::format("{}: its value is missing; write {} {}", name, name, option->get_type_name());
    }
    if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr) {
      const std::string what = error.what(); // "--lang is required"
      const CLI::Option* option = app.get_option_no_throw(what.substr(0, what.find(' ')));
      if (option != nullptr && !option->get_positional())
        return fmt::format("{}: add {} {}", what,
                           option->get_snames().empty() ? "--" + option->get_lnames().front()
                                                        : "-" + option->get_snames().front(),
                           option->get_type_name());
    }
    return error.what();
  }

  // "'--output' (-o)"
  std::string with_short_name(const std::string& name) const {
    const CLI::Option* option = app.get_option_no_throw(name);
    return option == nullptr || option->get_snames().empty()
               ? fmt::format("'{}'", name)
               : fmt::format("'{}' (-{})", name, option->get_snames().front());
  }

  CLI::App app;
  std::string more;
  std::string common_group;
  std::shared_ptr<HelpFormat> format;
  std::function<std::string(const std::string&)> explain_extra;

private:
  std::vector<CLI::Option*> declared;
};

Option& Option::value(const std::string& name) {
  parser->at(index).type_name(name);
  return *this;
}

Option& Option::check(Check check) {
  parser->at(index).check(
      CLI::Validator([allowed = std::move(check)](const std::string& text) { return allowed(text); }, ""));
  return *this;
}

Option& Option::one_of(const std::string& words) {
  return check(cli::one_of(words)).value(words);
}

Option& Option::required() {
  parser->at(index).required();
  return *this;
}

Option& Option::needed() {
  parser->format->needed.insert(&parser->at(index));
  return *this;
}

Option& Option::hidden() {
  parser->at(index).group(hidden_heading);
  return *this;
}

Options::Options(const CommandText& text) : parser(std::make_unique<OptionParser>(text)) {}

Options::~Options() = default;

Option Options::option(const std::string& names, std::string& variable, const std::string& help) {
  return {*parser, parser->add(names, variable, help)};
}

Option Options::option(const std::string& names, int& variable, const std::string& help) {
  return {*parser, parser->add(names, variable, help)};
}

Option Options::option(const std::string& names, std::int64_t& variable, const std::string& help) {
  return {*parser, parser->add(names, variable, help)};
}

Option Options::option(const std::string& names, double& variable, const std::string& help) {
  return {*parser, parser->add(names, variable, help)};
}

Option Options::option(const std::string& names, std::optional<std::string>& variable,
                       const std::string& help) {
  return {*parser, parser->add(names, variable, help)};
}

Option Options::option(const std::string& names, std::optional<int>& variable, const std::string& help) {
  return {*parser, parser->add(names, variable, help)};
}

Option Options::option(const std::string& names, std::optional<double>& variable, const std::string& help) {
  return {*parser, parser->add(names, variable, help)};
}

Option Options::option(const std::string& names, std::vector<std::string>& variable,
                       const std::string& help) {
  const int index = parser->add(names, variable, help);
  CLI::Option& option = parser->at(index);
  if (!option.get_positional()) option.expected(1)->take_all()->allow_extra_args(false);
  return {*parser, index};
}

Option Options::option(const std::string& names, std::function<void(const std::string&)> taken,
                       const std::string& help) {
  return {*parser, parser->keep(parser->app.add_option_function<std::string>(names, std::move(taken), help))};
}

void Options::flag(const std::string& names, bool& variable, const std::string& help) {
  parser->app.add_flag(names, variable, help);
}

void Options::switch_flag(const std::string& name, std::function<void(bool)> taken, const std::string& help) {
  parser->app.add_flag_function(
      fmt::format("--{0},!--no-{0}", name), [taken](std::int64_t count) { taken(count > 0); }, help);
}

void Options::group(const std::string& heading) {
  parser->app.option_defaults()->group(heading.empty() ? parser->common_group : heading);
}

void Options::section(const std::string& heading, const std::string& lines) {
  parser->format->sections += fmt::format("\n{}:\n{}", heading, lines);
}

void Options::explain_extra(std::function<std::string(const std::string& extra)> explained) {
  parser->explain_extra = std::move(explained);
}

bool Options::parse(const std::vector<std::string>& arguments) {
  try {
    parser->app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend())); // last first
  } catch (const CLI::CallForHelp&) {
    return false;
  } catch (const CLI::ParseError& error) {
    throw Error(ErrorKind::usage, "", parser->explained(error));
  }
  const CLI::Option* output = parser->app.get_option_no_throw("--output");
  if (output != nullptr && output->count() > 0 && output->results().back().empty())
    throw Error(ErrorKind::usage, "--output",
                fmt::format("is empty; name a {}", output->get_type_name() == "DIR" ? "folder" : "file"));
  return true;
}

bool Options::given(const std::string& name) const {
  return parser->app.count(name) > 0;
}

std::vector<OptionText> Options::listed() const {
  std::vector<OptionText> list;
  for (const CLI::Option* option : parser->app.get_options()) {
    OptionText text;
    text.is_positional = option->get_positional();
    if (text.is_positional) {
      text.names = {option->get_name(true)};
    } else {
      for (const std::string& name : option->get_snames()) text.names.push_back("-" + name);
      for (const std::string& name : option->get_lnames()) text.names.push_back("--" + name);
      if (option->get_expected_max() > 0) text.value = option->get_type_name();
    }
    text.help = option->get_description();
    text.group = option->get_group() == parser->common_group ? "" : option->get_group();
    text.is_required = option->get_required();
    list.push_back(std::move(text));
  }
  return list;
}

std::string Options::help() const {
  return parser->app.help();
}

} // namespace tilepack::cli
