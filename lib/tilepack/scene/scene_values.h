#pragma once

#include "tilepack/json/json_cursor.h"
#include "tilepack/numeric/grid.h"
#include "tilepack/scene/scene_blocks.h"
#include "tilepack/tileset/material_map.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace tilepack {

/// A sprite of an explicit positioning: stands still, or goes round a path.
struct SceneSprite {
  std::vector<std::array<double, 2>> path; ///< middles, in cells of the grid; one: it stands there
  double period = 1;                       ///< steps of time that a round takes
  double start = 0;                        ///< where on the path it is at time 0, 0 to 1
  int pattern = 0;
  double rotate = 0;    ///< turns, clockwise
  double scale = 1;     ///< side in cells, above 0 and up to 1
  bool follows = false; ///< turned along its path; at 0 turns it goes east
};

/// A polygon of a pixel map.
struct SceneOutline {
  int material = 0;
  std::vector<double> points; ///< x, y, x, y …, in pixels of the map
};

/// What stands at an input, checked against its row of scene_blocks().
struct SceneValue {
  int node = -1;               ///< the node that gives it: its place in SceneFile::nodes; -1: a constant
  std::vector<int> nodes;      ///< of a list of nodes
  std::vector<double> numbers; ///< of constants and lists; whole numbers exactly
  std::vector<std::vector<double>> lists; ///< of a list of lists
  std::vector<std::string> texts;         ///< words, and paths as they stand in the file
  Grid<float> cells;                      ///< of a map that is written in rows
  std::vector<SceneSprite> sprites;
  std::vector<SceneOutline> outlines;
};

/// A map that a scene has a value of at each place.
struct SceneMap {
  std::string name = "color";
  Role role = Role::color;
  int channels = 4; ///< 1..4
};

/// The constant at `at`, checked against the form and range of `input`. Throws Error (invalid_content) naming the
/// place, as JsonCursor does.
SceneValue scene_constant(const JsonCursor& at, const SceneInput& input);

/// The maps of a scene; where none are named, color with alpha.
std::vector<SceneMap> scene_maps(const std::optional<JsonCursor>& at);

} // namespace tilepack
