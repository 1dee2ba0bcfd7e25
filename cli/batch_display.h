#pragma once

#include "console.h"

#include "tilepack/batch/batch_run.h"

#include <chrono>
#include <cstddef>
#include <map>
#include <mutex>
#include <string>
#include <vector>

namespace tilepack::cli {

enum class LogFormat { text, json };

/// What a batch says while it runs: on a terminal a line for each entry at work and one for all with the time left,
/// which redraw themselves; elsewhere a line on stderr for each entry that was made or failed. As JSON one object a
/// line on stdout instead, as batch_log.schema.json describes them. May be called by several threads at a time.
class BatchDisplay {
public:
  BatchDisplay(Console& told, const Manifest& of, LogFormat as, bool tells_all);
  ~BatchDisplay();
  BatchDisplay(const BatchDisplay&) = delete;
  BatchDisplay& operator=(const BatchDisplay&) = delete;

  /// Before the first entry: so many will be looked at.
  void expect(std::size_t entries);
  void started(std::size_t entry, const std::vector<std::string>& reasons);
  void progress(std::size_t entry, std::string_view stage, double done);
  void ended(const EntryResult& result);
  void warned(std::size_t entry, std::string_view message);

  /// At the end, unless quiet: the counts, and each failure of several entries with its message.
  void summary(const std::vector<EntryResult>& results);

private:
  struct Running {
    std::string stage;
    double done = 0;
    double told_at = -1; // seconds, of JSON
  };
  const std::string& name(std::size_t entry) const { return manifest.entries[entry].name; }
  double seconds() const;
  void erase();
  void draw(bool now);
  void tell_made(const EntryResult& result);
  void print_json(const std::string& line);
  std::string total_line() const;

  Console& console;
  const Manifest& manifest;
  LogFormat format;
  bool verbose;
  bool terminal;
  std::mutex mutex;
  std::map<std::size_t, Running> running;
  std::size_t expected = 0;
  std::size_t finished = 0;
  std::size_t idle = 0; // of the finished, those that took no time
  int drawn_lines = 0;
  double drawn_at = -1;
  std::chrono::steady_clock::time_point began = std::chrono::steady_clock::now();
};

} // namespace tilepack::cli
