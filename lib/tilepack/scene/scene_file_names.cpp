#include "tilepack/scene/scene_file_names.h"

#include "tilepack/error/error.h"

#include <map>

namespace tilepack {

std::vector<SceneFileName> scene_file_names(const SceneFile& scene) {
  std::vector<char> needed(scene.nodes.size(), 0);
  needed[static_cast<std::size_t>(scene.output)] = 1;
  std::map<std::string, bool> paths;
  // Users come after what they use.
  for (std::size_t i = scene.nodes.size(); i-- > 0;) {
    if (needed[i] == 0) continue;
    for (const auto& [name, value] : scene.nodes[i].inputs) {
      if (value.node >= 0) needed[static_cast<std::size_t>(value.node)] = 1;
      for (const int listed : value.nodes) needed[static_cast<std::size_t>(listed)] = 1;
      const SceneForm form = scene.nodes[i].block->find(name)->form;
      if (form == SceneForm::choice || form == SceneForm::text) continue;
      for (const std::string& path : value.texts)
        paths.emplace(scene.resolved(path), form == SceneForm::file);
    }
  }
  std::vector<SceneFileName> names;
  for (const auto& [path, is_pack] : paths) names.push_back({path, is_pack});
  return names;
}

std::vector<SceneFileName> scene_file_names(const std::string& file) {
  try {
    return scene_file_names(read_scene(file));
  } catch (const Error&) {
    return {};
  }
}

} // namespace tilepack
