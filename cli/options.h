#pragma once

#include "value_check.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tilepack::cli {

/// What the command line of one verb is called and says of itself.
struct CommandText {
  std::string name;    ///< "tilepack bake"
  std::string summary; ///< one line, no full stop
  std::string example; ///< lines below the help
  std::string more;    ///< follows the message of an argument too many
};

/// One option or positional as it was declared, for manual pages and completion.
struct OptionText {
  std::vector<std::string> names; ///< "-o", "--output"; of a positional its name
  std::string value;              ///< "FILE", "text|json"; empty for a flag and a positional
  std::string help;
  std::string group; ///< heading that it stands below; of the first empty
  bool is_positional = false;
  bool is_required = false;
};

class OptionParser;

/// One option that was declared; says more about it. A handle: the Options it came from must outlive it.
class Option {
public:
  /// What the help writes for the value, "FILE".
  Option& value(const std::string& name);

  /// Refuses values; see value_check.h.
  Option& check(Check check);

  /// `words`, "text|json", are all that is taken, and what the help writes for the value.
  Option& one_of(const std::string& words);

  /// Without it, parsing fails. The help marks it.
  Option& required();

  /// The help marks it as required; that it is there, the verb checks itself.
  Option& needed();

  /// Taken as before, but in no help: a name that has been given up.
  Option& hidden();

private:
  friend class Options;
  Option(OptionParser& of, int number) : parser(&of), index(number) {}

  OptionParser* parser;
  int index;
};

/// The positionals and options of one verb: declared, parsed, shown as help.
///
/// Values go into the variables that the declarations name, which must live until parsing is done; a variable
/// whose option is absent keeps its value. The last of repeated options counts, so that scripts append to
/// override; lists collect. This is all that a verb sees of CLI11, which takes long to compile.
class Options {
public:
  explicit Options(const CommandText& text);
  ~Options();
  Options(const Options&) = delete;
  Options& operator=(const Options&) = delete;

  /// `names`: "-o,--output", or "PACK" for a positional, which has no value name. In a list, an option adds
  /// one value each time it is given; a positional takes all that are left.
  Option option(const std::string& names, std::string& variable, const std::string& help);
  Option option(const std::string& names, int& variable, const std::string& help);
  Option option(const std::string& names, std::int64_t& variable, const std::string& help);
  Option option(const std::string& names, double& variable, const std::string& help);
  Option option(const std::string& names, std::optional<std::string>& variable, const std::string& help);
  Option option(const std::string& names, std::optional<int>& variable, const std::string& help);
  Option option(const std::string& names, std::optional<double>& variable, const std::string& help);
  Option option(const std::string& names, std::vector<std::string>& variable, const std::string& help);

  /// The value, as text, goes to `taken`.
  Option option(const std::string& names, std::function<void(const std::string&)> taken,
                const std::string& help);

  void flag(const std::string& names, bool& variable, const std::string& help);

  /// --NAME tells `taken` true, --no-NAME false.
  void switch_flag(const std::string& name, std::function<void(bool)> taken, const std::string& help);

  /// What is declared from here on stands in the help below this heading; headings come in the order of their
  /// first option, "General" last. Until then: "Options".
  void group(const std::string& heading);

  /// A section of the help of its own, after the options. `lines` end in a line break.
  void section(const std::string& heading, const std::string& lines);

  /// What follows the message of an argument too many, worked out from that argument when there is one; values
  /// are filled in by then. Empty: CommandText::more.
  void explain_extra(std::function<std::string(const std::string& extra)> explained);

  /// False if --help was among the arguments; nothing is filled in then. Throws Error (usage), which says
  /// what is wrong and what may have been meant.
  bool parse(const std::vector<std::string>& arguments);

  /// Was it on the command line? For after parsing. `name`: "--level".
  bool given(const std::string& name) const;

  /// All of them, in the order of the help.
  std::vector<OptionText> listed() const;

  /// The text of --help, 100 columns: descriptions begin with a capital letter, whatever was declared.
  std::string help() const;

private:
  std::unique_ptr<OptionParser> parser;
};

} // namespace tilepack::cli
