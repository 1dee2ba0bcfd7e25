#include "verb.h"

#include <array>

namespace tilepack::cli {

std::span<const Verb> verb_table() {
  static const std::array table{
      bake_verb(),    pack_verb(),    inspect_verb(), validate_verb(), render_verb(), compose_verb(),
      compare_verb(), layouts_verb(), bench_verb(),   shader_verb(),   view_verb(),   batch_verb(),
  };
  return table;
}

} // namespace tilepack::cli
