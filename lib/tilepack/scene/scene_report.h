#pragma once

#include "tilepack/image/image.h"
#include "tilepack/scene/scene_file.h"
#include "tilepack/scene/scene_files.h"
#include "tilepack/scene/scene_graph.h"

#include <cstddef>
#include <string>
#include <vector>

namespace tilepack {

/// What drawing a scene took: which nodes and files the pixels needed, which were left alone, what was held.
struct SceneReport {
  struct Node {
    std::string name;
    std::string_view block;
    bool is_used = false; ///< a pixel needed its value; grids and places are used with those that take them
  };
  std::string scene; ///< as the user named it
  std::string map;
  Size picture;
  int frames = 1;
  std::vector<Node> nodes;
  std::vector<SceneFileUse> files;
  std::size_t texture_bytes = 0; ///< the largest coarse map and tables of a frame
  std::size_t band_bytes = 0;    ///< the picture's rows in work

  std::size_t held_bytes() const; ///< all of these
};

/// The nodes of a report. `used`: by node of the graph, PatternTexture::used_nodes().
std::vector<SceneReport::Node> scene_report_nodes(const SceneFile& scene, const SceneGraph& made,
                                                  const std::vector<bool>& used);

std::string scene_report_text(const SceneReport& report);
/// Ends in a newline.
std::string scene_report_json(const SceneReport& report);

} // namespace tilepack
