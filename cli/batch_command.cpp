#include "batch_command.h"

#include "tilepack/numeric/enum_names.h"

#include <fmt/core.h>

namespace tilepack::cli {

std::vector<std::string> command_of(const BatchEntry& entry) {
  std::vector<std::string> words{std::string(entry.verb->name)};
  for (const MaterialFile& map : entry.maps) {
    const std::string role(name_of(map.role));
    words.push_back("--map");
    words.push_back((map.name == role ? role : map.name + ":" + role) + "=" + map.file);
  }
  if (!entry.preset.empty()) words.insert(words.end(), {"--preset", entry.preset});
  for (const BatchOption& option : entry.options) {
    if (option.name == "jobs" || option.name == "quiet") continue;
    for (const std::string& value : option.values) {
      if (!option.is_flag)
        words.push_back(fmt::format("--{}={}", option.name, value)); // a value may begin with a dash
      else if (value == "true") // off is what a flag is without being named
        words.push_back("--" + option.name);
    }
  }
  if (entry.verb->output != BatchOutput::printed) words.insert(words.end(), {"-o", entry.output});
  words.push_back("--");
  words.insert(words.end(), entry.sources.begin(), entry.sources.end());
  return words;
}

} // namespace tilepack::cli
