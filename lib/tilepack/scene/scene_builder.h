#pragma once

#include "tilepack/pattern/pattern_graph.h"
#include "tilepack/scene/scene_file.h"
#include "tilepack/scene/scene_files.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tilepack {

/// A scene as a graph that can be evaluated.
struct SceneGraph {
  PatternGraph graph;
  std::vector<NodeId>
      node_of; ///< by node of the scene: its node of the graph; no_node of those that are no value (grids, places) or not needed
};

/// Where a node of the kind `place` puts patterns.
struct ScenePlacing {
  PatternGrid grid;
  TransformFit fit = TransformFit::none;
  NodeId x = no_node, y = no_node, scale = no_node, rotation = no_node;
  std::shared_ptr<const SpriteMap> sprites; ///< of explicit positioning
  int most_pattern = 0;                     ///< the highest pattern of a sprite
};

/// One thing wrong with a node, on its way to who lists or throws it.
struct SceneFailure {
  SceneProblem problem;
};

/// Makes the nodes of a graph from those of a scene, one after the other: scene_graph() drives it.
class SceneBuilder {
public:
  SceneBuilder(const SceneFile& scene, SceneFiles& files, double time);

  /// Throws SceneFailure, and Error of files. Inputs have been built.
  void build(int node);

  SceneGraph finish();
  bool is_needed(int node) const { return needed[static_cast<std::size_t>(node)] != 0; }
  /// The grids of all needed nodes, and units that suit them. Throws as build().
  void find_units();

private:
  using Block = std::optional<PatternBlock>;

  const SceneNode& node_at(int node) const { return scene->nodes[static_cast<std::size_t>(node)]; }
  [[noreturn]] void fail(SceneFault fault, const SceneNode& node, std::string_view input,
                         const std::string& what) const;

  // What inputs hold.
  PatternGrid grid_input(const SceneNode& node, std::string_view input) const;
  NodeId index_input(const SceneNode& node, std::string_view input);
  NodeId number_input(const SceneNode& node, std::string_view input, bool is_always = false);
  NodeId texture_input(const SceneNode& node, std::string_view input);
  PatternBlock constant_texture(const SceneNode& node, std::string_view input) const;
  std::vector<NodeId> texture_inputs(const SceneNode& node) const;
  /// In units along an axis, of texels.
  NodeId length_input(const SceneNode& node, std::string_view input, int texels);
  std::shared_ptr<const StoredMap> map_input(const SceneNode& node, bool is_whole);
  std::shared_ptr<const PatternSource> patterns_input(const SceneNode& node);
  HashKind hash_input(const SceneNode& node) const;
  std::uint64_t seed_input(const SceneNode& node) const;
  std::vector<int> probability_table(const SceneNode& node, std::string_view input,
                                     const std::vector<double>& probabilities) const;

  // A block each; none where the name is another's.
  Block block_of(int node);
  Block choice_block(int node);
  Block transition_block(int node);
  Block animation_block(int node);
  Block texture_block(int node);
  PatternBlock stored_index(int node);
  PatternBlock probability_index(int node);
  PatternBlock material_index(int node);
  PatternBlock pixel_index(int node);
  PatternBlock reference_texture(const SceneNode& node);
  PatternBlock corner_tiles(const SceneNode& node);
  int variants_of(const SceneNode& node) const; // as given, or as many as the pack has
  PatternBlock transition_texture(const SceneNode& node);
  PatternBlock border_texture(const SceneNode& node);
  PatternBlock blend_texture(const SceneNode& node);
  PatternBlock animation_index(int node);
  PatternBlock wang_texture(const SceneNode& node);
  ScenePlacing transform(const SceneNode& node);
  ScenePlacing sprites(const SceneNode& node) const;
  std::vector<int> tiles_by_corners(const SceneNode& node, int materials, int variants) const;

  PatternGrid wang_grid(const SceneNode& node) const;
  PatternGrid coarse_grid(const SceneNode& node, std::string_view input) const;
  void check_choice(const SceneNode& node, std::string_view input, std::int64_t count,
                    std::string_view of) const;
  NodeId add(const std::string& name, PatternBlock block);

  const SceneFile* scene;
  SceneFiles* files;
  double time;
  SceneGraph made;
  std::vector<char> needed;
  std::vector<PatternGrid> grids;     // by node; of those without 0
  std::vector<std::int64_t> highest;  // by node: the highest index it gives, -1 where that isn't known
  std::vector<ScenePlacing> placings; // by node
};

} // namespace tilepack
