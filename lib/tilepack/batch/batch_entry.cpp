#include "tilepack/batch/batch_entry.h"

#include "tilepack/scene/scene_file.h"

namespace tilepack {

bool shows_scene(const BatchEntry& entry) {
  if (entry.verb->name == "compose") return true;
  return !entry.sources.empty() && entry.verb->sources.front().is_pack &&
         is_scene_file(entry.sources.front());
}

} // namespace tilepack
