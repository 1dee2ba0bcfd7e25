#include "verb.h"

#include <array>

namespace tilepack::cli {

std::span<const Verb> verb_table() {
  static const std::array table{
      bake_verb(),
      inspect_verb(),
      validate_verb(),
      render_verb(),
      compare_verb(),
  };
  return table;
}

} // namespace tilepack::cli
