#pragma once

#include "tilepack/numeric/rect.h"
#include "tilepack/scene/scene_blocks.h"
#include "tilepack/scene/scene_fault.h"
#include "tilepack/scene/scene_values.h"

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace tilepack {

/// A node whose inputs are all there and of the right kind.
struct SceneNode {
  std::string name;
  const SceneBlock* block = nullptr;
  SceneKind gives = SceneKind::texture;
  std::map<std::string, SceneValue, std::less<>> inputs; ///< those given

  const SceneValue* find(std::string_view input) const; ///< null where nothing is given
  int node_at(std::string_view input) const;            ///< -1 for a constant and where nothing is given
  double number(std::string_view input) const;          ///< the constant, or the block's fallback
  std::string_view word(std::string_view input) const;  ///< the word, or the first choice
  bool flag(std::string_view input) const { return number(input) != 0; }
};

/// A scene as its file has it (lib/tilepack/scene/SCENES.md): a graph of blocks. No other file has been looked at.
struct SceneFile {
  std::string file; ///< as given
  std::string text;
  std::array<std::int64_t, 2> size{}; ///< texels of the whole texture, which repeats after them
  std::uint64_t seed = 1;
  std::vector<SceneMap> maps;   ///< 1 or more
  std::vector<SceneNode> nodes; ///< inputs before those that use them
  int output = -1;              ///< the node that is shown

  /// A path of the file, from where the program runs.
  std::string resolved(const std::string& path) const;
  /// "FILE:LINE: nodes.NAME.INPUT", as errors say it; input may be empty.
  std::string place(const SceneNode& node, std::string_view input) const;
};

/// The longest list of what is wrong with a scene, and what could be read of it all the same.
struct SceneReading {
  SceneFile scene; ///< whole only if there are no problems
  std::vector<SceneProblem> problems;
};

/// Reads a scene and lists all that is wrong with it in one go: nodes, inputs and their kinds, circles. Never
/// throws for what the text holds.
SceneReading scene_reading(std::string text, const std::string& file);

/// The same for who needs a whole scene. Throws Error (invalid_content, "FILE:LINE: nodes.NAME.INPUT"): the first
/// problem.
SceneFile parsed_scene(std::string text, const std::string& file);

/// Whether a path is meant as a scene and not as a pack: a plain file, other than a pack.json, that has the words
/// "tilepack-scene" in it, broken or not.
bool is_scene_file(const std::string& file);

/// Throws Error: cannot_read for the file, and what parsed_scene() throws.
SceneFile read_scene(const std::string& file);

} // namespace tilepack
