#pragma once

#include "tilepack/error/error.h"

#include <string>
#include <string_view>

namespace tilepack {

/// What can be wrong with a scene.
enum class SceneFault {
  not_json,
  field,         ///< a field is missing, unknown, of the wrong type or out of range
  unknown_block, ///< a block that is none
  unknown_node,  ///< the name of a node that isn't there
  wrong_kind,    ///< a node that gives another kind than the input takes
  circle,        ///< a node that is made from itself
  size,          ///< sizes that don't divide each other
  probability,   ///< probabilities that don't sum to 1
  index,         ///< numbers beyond what they choose from
  stored,        ///< a grid too large to be stored
  file,          ///< a file that is missing or can't be read
  file_kind,     ///< a file of another kind than the input takes
  unused,        ///< a node that nothing shown is made from: no error
};

/// One thing that is wrong.
struct SceneProblem {
  SceneFault fault = SceneFault::field;
  std::string place; ///< in the file: "nodes.leaves.pattern"
  int line = 1;      ///< of the file, from 1
  std::string what;  ///< the value, the allowed range and the way out
};

/// As an error: `file` and the line before the place. Files that can't be read are cannot_read, all else
/// invalid_content.
Error error_of(const SceneProblem& problem, std::string_view file);

} // namespace tilepack
