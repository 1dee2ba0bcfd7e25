#include "tilepack/check/scene_checks.h"

#include "tilepack/bake/text_file.h"
#include "tilepack/scene/scene_file.h"
#include "tilepack/scene/scene_graph.h"

#include <fmt/format.h>

#include <algorithm>

namespace tilepack {
namespace {

Rule rule_of(SceneFault fault) {
  switch (fault) {
  case SceneFault::not_json:
    return Rule::scene_not_json;
  case SceneFault::field:
    return Rule::scene_field;
  case SceneFault::unknown_block:
    return Rule::scene_block;
  case SceneFault::unknown_node:
    return Rule::scene_node;
  case SceneFault::wrong_kind:
    return Rule::scene_kind;
  case SceneFault::circle:
    return Rule::scene_circle;
  case SceneFault::size:
    return Rule::scene_size;
  case SceneFault::probability:
    return Rule::scene_probability;
  case SceneFault::index:
    return Rule::scene_index;
  case SceneFault::stored:
    return Rule::scene_stored;
  case SceneFault::file:
    return Rule::scene_file;
  case SceneFault::file_kind:
    return Rule::scene_file_kind;
  case SceneFault::unused:
    break;
  }
  return Rule::scene_unused;
}

} // namespace

Report check_scene(const std::string& file) {
  SceneReading reading = scene_reading(read_text_file(file, "the scene"), file);
  Report report;
  report.subject = file;
  const auto is_error = [](const SceneProblem& problem) { return problem.fault != SceneFault::unused; };
  if (std::none_of(reading.problems.begin(), reading.problems.end(), is_error)) {
    SceneFiles files(reading.scene);
    const auto more = scene_graph_problems(reading.scene, files);
    reading.problems.insert(reading.problems.begin(), more.begin(), more.end());
    report.maps = static_cast<int>(reading.scene.maps.size());
    report.levels = static_cast<int>(files.uses().size());
  }
  for (const SceneProblem& problem : reading.problems)
    report.issues.push_back(
        {rule_of(problem.fault),
         problem.place.empty() ? file : fmt::format("{}:{}: {}", file, problem.line, problem.place),
         problem.what, ""});
  return report;
}

} // namespace tilepack
