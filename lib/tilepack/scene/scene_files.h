#pragma once

#include "tilepack/pattern/pattern_source.h"
#include "tilepack/pattern/stored_map.h"
#include "tilepack/scene/scene_file.h"

#include <atomic>
#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace tilepack {

/// What became of one file or set of files of a scene.
struct SceneFileUse {
  std::string file;      ///< as the scene has it; of a set the first, and how many more
  std::string_view kind; ///< "pack", "patterns" or "map"
  int openings = 0;      ///< how often texels or values were read from it; 0: it was skipped
  std::size_t bytes = 0; ///< held of it in memory
};

/// The packs and pictures of a scene. Descriptions and headers are read when a node asks for a file; texels when the
/// first pixel needs them, and of packs from the level on that it needs. A file that several nodes name is one.
///
/// All functions throw Error: `where` is the place of the scene that asks ("FILE:LINE: nodes.NAME.INPUT"), and what
/// happened begins with the file's name. cannot_read if it isn't there, invalid_content if it is of another kind.
class SceneFiles {
public:
  explicit SceneFiles(const SceneFile& of_scene) : scene(&of_scene) {} ///< which must outlive this

  /// What is known of a pack without its images.
  struct Described {
    std::shared_ptr<const PatternSource> source;
    Pack pack; ///< without the values of its images
  };
  /// A pack with at least one of the scene's maps. `is_pattern_set`: looked up by tile, not by its mapping.
  const Described& pack(const std::string& path, const std::string& place);

  /// Pictures of one size as a set of patterns of the scene's first map.
  std::shared_ptr<const PatternSource> patterns(const std::vector<std::string>& paths,
                                                const std::string& place);

  /// A picture of one channel as numbers: `is_whole`, its codes 0 to 255 or 65535; else its values 0 to 1.
  std::shared_ptr<const StoredMap> map(const std::string& path, bool is_whole, const std::string& place);

  /// In the order of their names.
  std::vector<SceneFileUse> uses() const;

  /// Every file that nodes asked for so far, of packs all that they consist of, and the scene's own.
  std::vector<std::string> inputs() const;

private:
  struct Use {
    SceneFileUse told;
    std::vector<std::string> paths; // from where the program runs
    std::shared_ptr<std::atomic<int>> openings = std::make_shared<std::atomic<int>>(0);
    std::shared_ptr<const PatternSource> source;
    std::shared_ptr<const StoredMap> stored;
  };
  std::shared_ptr<std::atomic<int>> used(const std::string& key, const std::string& file,
                                         std::string_view kind);

  const SceneFile* scene;
  std::map<std::string, Use> files;
  std::map<std::string, Described> packs;
};

/// `image` with `channels` channels, no fewer colors than it has: grey to color, alpha of 1 added, alpha dropped.
Image with_channels(Image image, int channels);

} // namespace tilepack
