#pragma once

#include "tilepack/scene/scene_file.h"

#include <string>
#include <vector>

namespace tilepack {

/// A file that a scene names.
struct SceneFileName {
  std::string path;     ///< from where the program runs
  bool is_pack = false; ///< a folder with a pack, or its pack.json
};

/// All files that the nodes of a scene name which its output is made from, each once, in the order of their paths. No
/// file is looked at.
std::vector<SceneFileName> scene_file_names(const SceneFile& scene);

/// The same of a scene on disk; empty where it can't be read or isn't sound, which is told when it is drawn.
std::vector<SceneFileName> scene_file_names(const std::string& file);

} // namespace tilepack
