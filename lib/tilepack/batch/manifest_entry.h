#pragma once

#include "tilepack/batch/batch_entry.h"
#include "tilepack/json/json_cursor.h"

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace tilepack {

/// One of "jobs" as it is written, before patterns and paths mean anything.
struct EntryText {
  const BatchVerb* verb = nullptr;
  std::string at; ///< "jobs[3]"
  std::string name;
  std::string output;
  std::vector<std::string> sources; ///< empty if there is a pattern
  bool is_transition = false;       ///< a bake whose sources are materials
  std::vector<std::string> pattern; ///< one or several; empty if there is none
  std::string pattern_at;
  bool is_pack_pattern = false;
  std::vector<MaterialFile> maps;
  std::string preset;
  std::vector<BatchOption> options;
};

/// What entries take that don't say otherwise.
struct EntryDefaults {
  std::string preset;
  std::map<std::string, std::vector<BatchOption>> options; ///< by verb
};

/// Throw Error (invalid_content) as JsonCursor does.
EntryDefaults entry_defaults(const JsonCursor& defaults);
EntryText entry_text(const JsonCursor& job, const std::string& at, const EntryDefaults& defaults);

/// Whether the value of an option of that verb is a file, and one that is read.
bool is_file_option(const BatchVerb& verb, std::string_view option);
bool is_read_option(const BatchVerb& verb, std::string_view option);

} // namespace tilepack
