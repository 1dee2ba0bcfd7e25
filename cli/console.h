#pragma once

#include "tilepack/error/error.h"
#include "tilepack/error/progress.h"

#include <string>
#include <string_view>
#include <vector>

namespace tilepack::cli {

/// Where a verb talks to its user: data on stdout, everything else on stderr.
///
/// Progress is one line that redraws itself, only on a terminal and not with --quiet. Color is used for the
/// words "error" and "warning" only, on a terminal and unless NO_COLOR is set.
class Console {
public:
  /// `command` is what messages begin with: "tilepack bake".
  explicit Console(std::string command);

  /// For a verb that another one runs: data goes into `data`, notes and warnings to `notes`, which must both outlive
  /// it, and progress to `onward`.
  Console(std::string command, std::string& data, std::vector<std::string>& notes, Progress onward);
  ~Console();
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;

  bool quiet = false; ///< no progress, notes and warnings; errors are always printed

  /// Data for stdout, as it is. Throws Error (cannot_write) when stdout can't take it; the message names
  /// `in_place`, what was made and stays all the same.
  void print(std::string_view data, std::string_view in_place = {});

  /// A line for stdout on what was made and is in its place, a newline added; none if quiet. Throws as print() does.
  void made(std::string_view line, std::string_view in_place);

  /// A line for stderr, a newline added.
  void note(std::string_view message);
  void warn(std::string_view message);
  void error(std::string_view message);

  /// A note from another thread than the one that uses the console, just before the program ends.
  void last_note(std::string_view message) const;

  /// For the stages. Also the place where Ctrl-C takes effect: it throws Interrupted, and what is half done
  /// is undone on the way out. The console must outlive it.
  Progress progress();

private:
  void draw(std::string_view stage, double done);
  void erase_progress();
  void line(std::string_view word, const char* color, std::string_view message);

  std::string command_name;
  bool terminal = false;
  bool colored = false;
  std::string drawn;                              // the progress line on screen, empty if none
  std::string* kept = nullptr;                    // data, if it is for another verb
  std::vector<std::string>* kept_notes = nullptr; // the same of notes
  Progress told;                                  // and of progress
};

} // namespace tilepack::cli
