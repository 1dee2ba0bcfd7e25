// A scene: any text is a graph whose inputs are there and stand before their users, or problems with their lines.

#include "tilepack/error/error.h"
#include "tilepack/scene/scene_file.h"

#include <cstdint>
#include <cstdlib>
#include <string>

namespace {

void check(bool holds) {
  if (!holds) __builtin_trap();
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  const tilepack::SceneReading reading = tilepack::scene_reading(text, "s.json");
  bool is_whole = true;
  for (const tilepack::SceneProblem& problem : reading.problems) {
    check(problem.line >= 1 && !problem.what.empty());
    is_whole = is_whole && problem.fault == tilepack::SceneFault::unused;
  }
  if (!is_whole) return 0;
  const tilepack::SceneFile& scene = reading.scene;
  check(scene.output >= 0 && scene.output < static_cast<int>(scene.nodes.size()));
  check(!scene.maps.empty() && scene.size[0] >= 1 && scene.size[1] >= 1);
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const tilepack::SceneNode& node = scene.nodes[i];
    check(node.block != nullptr && !node.name.empty());
    for (const tilepack::SceneInput& input : node.block->inputs) {
      const tilepack::SceneValue* value = node.find(input.name);
      check(value != nullptr || !input.is_required);
      if (value == nullptr) continue;
      check(value->node < static_cast<int>(i));
      for (const int listed : value->nodes) check(listed >= 0 && listed < static_cast<int>(i));
      if (input.form == tilepack::SceneForm::choice) check(!node.word(input.name).empty());
    }
    scene.place(node, "");
  }
  return 0;
}
