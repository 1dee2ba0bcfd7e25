#pragma once

#include "console.h"

#include <string>

namespace tilepack::cli {

struct LookupBenchArguments {
  std::string pack;
  std::string map;             ///< name; empty: the first
  std::string format = "text"; ///< text, json or csv
  std::string report;          ///< HTML file, or empty
  int rounds = 9;              ///< medians are taken over so many
  int lookups = 4096;          ///< places a zone and level, for the errors of mips
  bool quick = false;          ///< one round, and nothing stored
  bool targets = false;        ///< also what the project holds itself to
  int jobs = 0;
};

/// `tilepack bench` without --spans: measures lookups and mips, prints, and writes the report.
int bench_lookups_of(const LookupBenchArguments& arguments, Console& console);

} // namespace tilepack::cli
