#pragma once

#include "tilepack/batch/manifest.h"

#include <cstddef>
#include <string>
#include <vector>

namespace tilepack::cli {

/// What the rules of a build system are made for.
struct RuleSettings {
  std::string program;   ///< how tilepack is called
  std::string arguments; ///< that each call gets besides, as a shell takes them: "--cache '/mnt/share'"
  std::string
      file; ///< that the rules will be in, which are made again when the manifest changes; may be empty
};

/// Rules for Ninja and for GNU make, one an entry, that call `tilepack batch MANIFEST --only NAME`. They are run
/// again when an input is newer or an option changes, which stands in them as a hash; whether there is something
/// to do is decided by content then. Paths are as in the manifest as it was named: run from the same folder.
std::string ninja_rules(const Manifest& manifest, const std::vector<std::size_t>& chosen,
                        const RuleSettings& settings);
std::string make_rules(const Manifest& manifest, const std::vector<std::size_t>& chosen,
                       const RuleSettings& settings);

/// A word as a POSIX shell takes it.
std::string shell_word(const std::string& text);

} // namespace tilepack::cli
