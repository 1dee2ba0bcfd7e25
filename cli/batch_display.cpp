#include "batch_display.h"

#include "tilepack/error/printable.h"
#include "tilepack/json/json_value.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <sys/ioctl.h>
#include <unistd.h>

namespace tilepack::cli {
namespace {

constexpr double between_draws = 0.1; // seconds
constexpr double between_json = 0.5;  // seconds, of one entry's progress

int terminal_width() {
  winsize size{};
  return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

// No longer than the terminal is wide, or it would take two lines.
std::string cut(const std::string& text, int width) {
  std::size_t bytes = 0;
  int letters = 0;
  while (bytes < text.size() && letters < width - 1) {
    ++bytes;
    while (bytes < text.size() && (text[bytes] & 0xC0) == 0x80) ++bytes; // the rest of a letter
    ++letters;
  }
  return text.substr(0, bytes);
}

std::string duration(double seconds) {
  const auto whole = static_cast<std::int64_t>(seconds + 0.5);
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{}:{:02} min", whole / 60, whole % 60);
  return fmt::format("{}:{:02} h", whole / 3600, whole / 60 % 60);
}

std::string one_line(const JsonValue& value) {
  std::string text = filled_json_text(value, 1 << 30);
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

std::vector<std::string> spelled_all(const std::vector<std::string>& marked) {
  std::vector<std::string> texts;
  for (const std::string& text : marked) texts.push_back(spelled(text, FieldSpelling::json));
  return texts;
}

} // namespace

BatchDisplay::BatchDisplay(Console& told, const Manifest& of, LogFormat as, bool tells_all)
    : console(told), manifest(of), format(as), verbose(tells_all),
      terminal(::isatty(STDERR_FILENO) != 0 && !told.quiet && as == LogFormat::text) {}

BatchDisplay::~BatchDisplay() {
  erase();
}

void BatchDisplay::expect(std::size_t entries) {
  expected = entries;
}

double BatchDisplay::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
}

void BatchDisplay::print_json(const std::string& line) {
  console.print(line + "\n");
}

void BatchDisplay::started(std::size_t entry, const std::vector<std::string>& reasons) {
  const std::scoped_lock lock(mutex);
  running[entry] = {};
  if (format == LogFormat::json) {
    print_json(
        one_line({{"event", "start"}, {"entry", name(entry)}, {"seconds", seconds()}, {"reasons", reasons}}));
  } else if (verbose) {
    erase();
    console.note(fmt::format("{}: {}", name(entry), fmt::join(reasons, ", ")));
  }
  draw(false);
}

void BatchDisplay::progress(std::size_t entry, std::string_view stage, double done) {
  const std::scoped_lock lock(mutex);
  Running& one = running[entry];
  one.stage = stage;
  one.done = done;
  if (format == LogFormat::json && seconds() - one.told_at > between_json) {
    one.told_at = seconds();
    print_json(one_line({{"event", "progress"},
                         {"entry", name(entry)},
                         {"seconds", seconds()},
                         {"stage", std::string(stage)},
                         {"done", std::clamp(done, 0.0, 1.0)}}));
  }
  draw(false);
}

void BatchDisplay::ended(const EntryResult& result) {
  const std::scoped_lock lock(mutex);
  running.erase(result.entry);
  ++finished;
  idle += result.end == EntryEnd::current || result.end == EntryEnd::skipped ? 1 : 0;
  const std::string message = spelled(result.message, FieldSpelling::json);
  if (format == LogFormat::json) {
    JsonValue value{{"event", result.end == EntryEnd::failed ? "failed" : "done"},
                    {"entry", name(result.entry)},
                    {"seconds", seconds()},
                    {"end", std::string(name_of(result.end))},
                    {"took", result.seconds},
                    {"peak_memory", result.peak_memory}};
    if (result.end == EntryEnd::failed) {
      value["message"] = message;
      value["code"] = exit_code(result.kind);
    }
    if (!result.story.verdict.empty()) {
      value["verdict"] = result.story.verdict;
      value["remarks"] = spelled_all(result.story.remarks);
    }
    if (!result.story.notes.empty()) value["notes"] = spelled_all(result.story.notes);
    print_json(one_line(value));
  } else if (result.end == EntryEnd::failed) {
    erase();
    console.error(fmt::format("{}: {}", name(result.entry), message));
  } else if (result.end == EntryEnd::skipped) {
    erase();
    console.warn(fmt::format("{}: left out, since what it is made from failed", name(result.entry)));
  } else if (result.end != EntryEnd::current || verbose) {
    erase();
    if (result.end == EntryEnd::current)
      console.note(fmt::format("{}: current", name(result.entry)));
    else
      tell_made(result);
  }
  draw(false);
}

// "sand: built in 1.1 s (sample changed): fair", and why if that is asked for.
void BatchDisplay::tell_made(const EntryResult& result) {
  std::string line = fmt::format("{}: {} in {:.1f} s ({})", name(result.entry), name_of(result.end),
                                 result.seconds, fmt::join(result.reasons, ", "));
  const EntryStory& story = result.story;
  if (!story.remarks.empty()) {
    line += fmt::format(": {}", story.verdict);
    if (verbose) line += fmt::format(" ({})", spelled(story.remarks.front(), FieldSpelling::json));
  }
  console.note(line);
  if (verbose)
    for (const std::string& note : story.notes)
      console.note(fmt::format("{}: {}", name(result.entry), spelled(note, FieldSpelling::json)));
}

void BatchDisplay::warned(std::size_t entry, std::string_view message) {
  const std::scoped_lock lock(mutex);
  erase();
  console.warn(fmt::format("{}: {}", name(entry), spelled(message, FieldSpelling::json)));
}

void BatchDisplay::summary(const std::vector<EntryResult>& results) {
  const std::scoped_lock lock(mutex);
  erase();
  terminal = false;
  std::map<EntryEnd, int> counts;
  for (const EntryResult& result : results) ++counts[result.end];
  if (format == LogFormat::json) {
    JsonValue value{{"event", "end"}, {"seconds", seconds()}, {"entries", results.size()}};
    for (const auto& end : enum_names<EntryEnd>) value[end.name] = counts[end.value];
    print_json(one_line(value));
    return;
  }
  if (console.quiet) return; // errors were told
  for (const EntryResult& result : results) {
    if (result.end != EntryEnd::failed || results.size() == 1) continue;
    console.print(fmt::format("failed: {}: {}\n", printable(name(result.entry)),
                              printable(spelled(result.message, FieldSpelling::json))));
  }
  std::string text = fmt::format("{} {}", results.size(), results.size() == 1 ? "entry" : "entries");
  const char* before = ": ";
  for (const auto& end : enum_names<EntryEnd>)
    if (counts[end.value] > 0) {
      text += fmt::format("{}{} {}", before, counts[end.value], end.name);
      before = ", ";
    }
  console.print(text + "\n");
}

void BatchDisplay::erase() {
  if (drawn_lines == 0) return;
  std::string text;
  for (int i = 0; i < drawn_lines; ++i) text += "\033[1A\033[2K";
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
  drawn_lines = 0;
}

std::string BatchDisplay::total_line() const {
  double done = static_cast<double>(finished - idle);
  for (const auto& [entry, one] : running) done += std::clamp(one.done, 0.0, 1.0);
  const double all = static_cast<double>(std::max(expected, finished) - idle);
  std::string text = fmt::format("{} of {} done", finished, expected);
  if (done > 0.5) text += fmt::format(", {} left", duration(seconds() * (all - done) / done));
  return text;
}

void BatchDisplay::draw(bool now) {
  if (!terminal || (!now && seconds() - drawn_at < between_draws)) return;
  drawn_at = seconds();
  erase();
  const int width = terminal_width();
  std::string text;
  for (const auto& [entry, one] : running) {
    const int percent = static_cast<int>(std::clamp(one.done, 0.0, 1.0) * 100);
    text += cut(fmt::format("{:3d} % {:<12} {}", percent, one.stage, printable(name(entry))), width) + "\n";
    ++drawn_lines;
  }
  text += cut(total_line(), width) + "\n";
  ++drawn_lines;
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

} // namespace tilepack::cli
