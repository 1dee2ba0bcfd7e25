#pragma once

#include "tilepack/report/vector_drawing.h"
#include "tilepack/scene/scene_file.h"
#include "tilepack/scene/scene_files.h"

#include <string>

namespace tilepack {

/// The graph of a scene: a box a node with a picture of what it gives and its name below, inputs to the west of those
/// that use them, the output last. Of an index or number the picture is of the whole scene, each index a color of its own
/// and numbers from dark to light; of a texture it is of a window at the middle of the scene, as it is shown by the first
/// map. Nodes that the output isn't made from are pale. Throws what scene_graph() does; texels are read as pixels need them.
VectorDrawing scene_picture(const SceneFile& scene, SceneFiles& files, double time = 0);

/// What a scene holds: nodes with what they give and take, and its files. For people, and for programs (one JSON object).
std::string scene_summary_text(const SceneFile& scene);
std::string scene_summary_json(const SceneFile& scene);

} // namespace tilepack
