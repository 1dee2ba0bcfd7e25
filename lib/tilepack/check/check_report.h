#pragma once

#include "tilepack/check/issues.h"
#include "tilepack/error/field.h"

#include <cstdint>
#include <string>
#include <vector>

namespace tilepack {

/// What a check looked at and what it found.
struct Report {
  std::string subject; ///< the pack, as the user named it
  int tiles = 0;       ///< looked at; 0 if pack.json could not be read
  int maps = 0;
  int levels = 0; ///< images looked at, over all maps
  std::vector<Issue> issues;
};

/// No error among the issues; warnings and notes are allowed.
bool passed(const Report& report);

/// For people: one paragraph an issue (what, where, found and expected, how to fix), at most eight of a rule,
/// then a line of counts.
/// Options are spelled for the reader, here and below.
std::string report_text(const Report& report, FieldSpelling spelling = FieldSpelling::option);

/// For programs: the same as JSON, held to lib/tilepack/check/report.schema.json by a test. Ends in a newline.
std::string report_json(const Report& report, FieldSpelling spelling = FieldSpelling::option);

/// The table of rules, for people and for programs.
std::string rules_text(FieldSpelling spelling = FieldSpelling::option);
std::string rules_json(FieldSpelling spelling = FieldSpelling::option);

} // namespace tilepack
