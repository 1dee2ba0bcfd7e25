#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace tilepack::cli {

/// CLI11's help, with descriptions wrapped to 100 columns, flags shown by their names alone, and options
/// that must be given marked "(required)"; which positionals must be, the line of usage says.
class HelpFormat : public CLI::Formatter {
public:
  HelpFormat() { column_width(34); }
  std::string make_option_name(const CLI::Option* option, bool is_positional) const override;
  std::string make_option_opts(const CLI::Option* option) const override;
  std::string make_option_desc(const CLI::Option* option) const override;
};

} // namespace tilepack::cli
