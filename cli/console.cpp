#include "console.h"

#include "interrupt.h"

#include "tilepack/error/printable.h"

#include <fmt/core.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <unistd.h>

namespace tilepack::cli {

Console::Console(std::string command) : command_name(std::move(command)) {
  terminal = isatty(STDERR_FILENO) != 0;
  const char* no_color = std::getenv("NO_COLOR");
  colored = terminal && (no_color == nullptr || *no_color == '\0');
}

Console::Console(std::string command, std::string& data, std::vector<std::string>& notes, Progress onward)
    : quiet(true), command_name(std::move(command)), kept(&data), kept_notes(&notes),
      told(std::move(onward)) {}

Console::~Console() {
  erase_progress();
}

void Console::print(std::string_view data, std::string_view in_place) {
  if (kept) {
    *kept += data;
    return;
  }
  erase_progress();
  if (std::fwrite(data.data(), 1, data.size(), stdout) != data.size() || std::fflush(stdout) != 0)
    throw Error(ErrorKind::cannot_write, "stdout",
                fmt::format("{}{}{}{}",
                            errno == EBADF ? "is closed; open it (> /dev/null), or have nothing printed (-q)."
                                           : "the output could not be written; is the disk full?",
                            in_place.empty() ? "" : " ", in_place,
                            in_place.empty() ? "" : " is whole and in place"));
}

void Console::made(std::string_view line, std::string_view in_place) {
  if (!quiet) print(std::string(printable(line)) + "\n", in_place);
}

void Console::note(std::string_view message) {
  if (kept_notes) kept_notes->emplace_back(message);
  if (!quiet) line("", "", message);
}

void Console::warn(std::string_view message) {
  if (kept_notes) kept_notes->emplace_back(message);
  if (!quiet) line("warning", "\033[33m", message);
}

void Console::error(std::string_view message) {
  line("error", "\033[31m", message);
}

void Console::line(std::string_view word, const char* color, std::string_view message) {
  erase_progress();
  std::string text = command_name + ": ";
  if (!word.empty()) text += colored ? fmt::format("{}{}\033[0m: ", color, word) : fmt::format("{}: ", word);
  text += printable(message); // names of files and what they hold may be anything
  text += '\n';
  std::fwrite(text.data(), 1, text.size(), stderr);
}

void Console::last_note(std::string_view message) const {
  if (quiet) return;
  const std::string text =
      fmt::format("{}{}: {}\n", terminal ? "\r\033[K" : "", command_name, printable(message));
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

Progress Console::progress() {
  if (kept) return told;
  return [this](std::string_view stage, double done) {
    if (interrupted()) throw Interrupted();
    if (terminal && !quiet) draw(stage, done);
  };
}

void Console::draw(std::string_view stage, double done) {
  const int percent = static_cast<int>(std::clamp(done, 0.0, 1.0) * 100.0);
  const std::string text = fmt::format("{:3d} % {}", percent, stage);
  if (text == drawn) return;
  erase_progress();
  drawn = text;
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

void Console::erase_progress() {
  if (drawn.empty()) return;
  std::fputs("\r\033[K", stderr);
  std::fflush(stderr);
  drawn.clear();
}

} // namespace tilepack::cli
