#include "tilepack/scene/scene_graph.h"

#include "tilepack/json/json_line.h"
#include "tilepack/scene/scene_builder.h"

#include <fmt/format.h>

#include <optional>

namespace tilepack {
namespace {

// Errors of files name the place already: "FILE:LINE: PLACE".
SceneProblem problem_of(const SceneFile& scene, const Error& error) {
  const std::string prefix = scene.file + ":";
  std::string place;
  if (error.where().starts_with(prefix)) {
    const std::size_t end = error.where().find(": ", prefix.size());
    if (end != std::string::npos) place = error.where().substr(end + 2);
  }
  // Of the graph: "node 'NAME'".
  if (error.where().starts_with("node '")) {
    const std::string name = error.where().substr(6, error.where().size() - 7);
    place = "nodes." + name.substr(0, name.find('.'));
  }
  const SceneFault fault = error.kind() == ErrorKind::cannot_read ? SceneFault::file
                           : error.where().starts_with(prefix)    ? SceneFault::file_kind
                                                                  : SceneFault::size;
  return {fault, place, place.empty() ? 1 : json_line(scene.text, place), error.what_happened()};
}

template <class Work>
std::optional<SceneProblem> problem_when(const SceneFile& scene, Work work) {
  try {
    work();
  } catch (const SceneFailure& failure) {
    return failure.problem;
  } catch (const Error& error) {
    return problem_of(scene, error);
  }
  return std::nullopt;
}

bool uses_any(const SceneNode& node, const std::vector<char>& broken) {
  for (const auto& [name, value] : node.inputs) {
    if (value.node >= 0 && broken[static_cast<std::size_t>(value.node)] != 0) return true;
    for (const int listed : value.nodes)
      if (broken[static_cast<std::size_t>(listed)] != 0) return true;
  }
  return false;
}

// All problems, or the first alone.
std::vector<SceneProblem> build(const SceneFile& scene, SceneBuilder& builder, bool wants_all) {
  std::vector<SceneProblem> problems;
  if (const auto problem = problem_when(scene, [&] { builder.find_units(); })) return {*problem};
  std::vector<char> broken(scene.nodes.size(), 0);
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const int node = static_cast<int>(i);
    if (!builder.is_needed(node)) continue;
    broken[i] = uses_any(scene.nodes[i], broken) ? 1 : 0;
    if (broken[i] != 0) continue;
    if (const auto problem = problem_when(scene, [&] { builder.build(node); })) {
      problems.push_back(*problem);
      if (!wants_all) return problems;
      broken[i] = 1;
    }
  }
  return problems;
}

} // namespace

SceneGraph scene_graph(const SceneFile& scene, SceneFiles& files, double time) {
  SceneBuilder builder(scene, files, time);
  const auto problems = build(scene, builder, false);
  if (!problems.empty()) throw error_of(problems.front(), scene.file);
  SceneGraph made = builder.finish();
  if (const auto problem = problem_when(scene, [&] { check_pattern_graph(made.graph); }))
    throw error_of(*problem, scene.file);
  return made;
}

Error scene_error(const SceneFile& scene, const Error& error) {
  return error_of(problem_of(scene, error), scene.file);
}

std::vector<SceneProblem> scene_graph_problems(const SceneFile& scene, SceneFiles& files) {
  SceneBuilder builder(scene, files, 0);
  std::vector<SceneProblem> problems = build(scene, builder, true);
  if (problems.empty())
    if (const auto problem = problem_when(scene, [&] { check_pattern_graph(builder.finish().graph); }))
      problems.push_back(*problem);
  return problems;
}

} // namespace tilepack
