#pragma once

#include "tilepack/pack/pack_json.h"

#include <string>
#include <vector>

namespace tilepack::cli {

/// What bake prints on stdout when it is done: what was made, and where. No times, so that it repeats.
std::string bake_report_text(const PackDescription& made, const std::string& folder);
std::string bake_report_json(const PackDescription& made, const std::string& folder);

/// A rule for make and ninja: `target` depends on `inputs`. Blanks, '#', '$' and ':' are escaped as both
/// read them. An empty rule for each input follows, so that make does not fail once an input is gone.
std::string depfile_text(const std::string& target, const std::vector<std::string>& inputs);

/// A depfile that gets its name only once the pack is in place. Destroyed before, it leaves nothing.
class Depfile {
public:
  /// Writes `text` beside `file`. Throws Error (cannot_write).
  Depfile(const std::string& file, const std::string& text);
  ~Depfile();
  Depfile(const Depfile&) = delete;
  Depfile& operator=(const Depfile&) = delete;

  void commit();

private:
  std::string final_name;
  std::string staged_name; // empty once committed
};

} // namespace tilepack::cli
