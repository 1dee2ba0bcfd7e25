#pragma once

#include "tilepack/error/error.h"
#include "tilepack/scene/scene_builder.h"
#include "tilepack/scene/scene_file.h"
#include "tilepack/scene/scene_files.h"

#include <vector>

namespace tilepack {

/// The blocks of a scene at a time, plugged together. Nodes that the output isn't made from are left out, and their
/// files not looked at. Units of the graph are cells of the finest grid, where the other grids fit it.
///
/// Throws Error naming file, line, node and input: sizes that don't divide, probabilities that don't sum to 1, numbers
/// beyond what they choose from, grids too large to be stored, files that are missing or of another kind.
SceneGraph scene_graph(const SceneFile& scene, SceneFiles& files, double time = 0);

/// The same for who wants all that is wrong: a problem a node at most, and none of nodes that are made from one with a
/// problem. `scene` has no problems of scene_reading() but nodes that are unused.
std::vector<SceneProblem> scene_graph_problems(const SceneFile& scene, SceneFiles& files);

/// An error of a graph, which names a node, or of a file of the scene as those of scene_graph() are: file, line, node.
Error scene_error(const SceneFile& scene, const Error& error);

} // namespace tilepack
