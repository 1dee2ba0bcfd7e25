#pragma once

#include "tilepack/numeric/rect.h"
#include "tilepack/pattern/pattern_nodes.h"
#include "tilepack/tileset/material_map.h"

#include <string>
#include <vector>

namespace tilepack {

/// A map that a scene has a value of at each place.
struct PatternMapFacts {
  std::string name; ///< "color", "normal", "height"
  Role role = Role::color;
  int channels = 3; ///< 1..4; of color, 2 and 4 have alpha
  bool has_alpha() const { return tilepack::has_alpha(role, channels); }
};

struct PatternNode {
  std::string name; ///< for messages; unique
  PatternBlock block;
};

/// A procedural texture: blocks plugged together.   [LN03]
///
/// Nodes stand in an order in which inputs come before their users, so there are no cycles; nothing is evaluated that
/// `output` doesn't need at a place that is looked at. The graph holds its maps and packs by shared pointers: copying it
/// is cheap, and a graph for another time differs in nothing.
struct PatternGraph {
  PatternGrid scene;   ///< units of the whole scene, 1..2^31 a side
  Size unit{256, 256}; ///< texels of level 0 that a unit has: what `scale 1` and `rect` count in
  std::vector<PatternMapFacts> maps; ///< 1 or more
  std::vector<PatternNode> nodes;
  NodeId output = no_node; ///< a texture
};

/// Throws Error (invalid_content) for the first fault: where() is "node 'NAME'", or "scene", and the text names the input.
/// Checked are: inputs that are missing, out of range, of the wrong kind or not before their user; grids that don't fit
/// the scene (fits_scene) or an input's; sizes and ranges as the nodes say; tables that would bias a RandomIndex; sources
/// whose facts don't suit; names that stand twice. Stored maps and packs are not opened.
void check_pattern_graph(const PatternGraph& graph);

/// An input of a node, by the name of the member it stands in ("textures 2": the third of several).
struct NodeInput {
  std::string name;
  NodeId node = no_node; ///< no_node: not given
  ValueKind kind = ValueKind::index;
  bool required = true;
};

/// The inputs of a node, in the order of its members.
std::vector<NodeInput> inputs_of(const PatternBlock& block);

/// The source that a block reads its texels from; null for others.
const PatternSource* source_of(const PatternBlock& block);

/// Whether each node is needed by the output at all (a property of the graph; see PatternTexture::used_nodes() for what
/// was needed in fact).
std::vector<bool> reachable_nodes(const PatternGraph& graph);

} // namespace tilepack
