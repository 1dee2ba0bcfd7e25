#include "tilepack/pattern/pattern_graph.h"

#include <type_traits>

namespace tilepack {
namespace {

struct InputList {
  std::vector<NodeInput> list;

  void index(const char* name, NodeId node) { list.push_back({name, node, ValueKind::index, true}); }
  void number(const char* name, NodeId node, bool required = false) {
    list.push_back({name, node, ValueKind::number, required});
  }
  void texture(const char* name, NodeId node) { list.push_back({name, node, ValueKind::texture, true}); }
  void textures(const std::vector<NodeId>& nodes) {
    for (std::size_t i = 0; i < nodes.size(); ++i)
      list.push_back({"textures " + std::to_string(i), nodes[i], ValueKind::texture, true});
  }

  template <typename Block>
  void operator()(const Block&) {} // has no inputs
  void operator()(const TableIndex& b) { index("index", b.index); }
  void operator()(const MaterialIndex& b) {
    index("material", b.material);
    index("index", b.index);
  }
  void operator()(const DitheredIndex& b) { index("areas", b.areas); }
  void operator()(const CornerIndex& b) { index("material", b.material); }
  void operator()(const AnimationIndex& b) {
    number("phase", b.phase);
    number("rest", b.rest);
    number("density", b.density);
    number("rest_before", b.rest_before);
    number("density_before", b.density_before);
  }
  void operator()(const FlooredIndex& b) { number("number", b.number, true); }
  void operator()(const DistanceNumber& b) {
    number("x", b.x, true);
    number("y", b.y, true);
  }
  void operator()(const IndexedNumber& b) { index("index", b.index); }
  void operator()(const ArithmeticNumber& b) {
    number("a", b.a, true);
    number("b", b.b, true);
  }
  void operator()(const PatternsTexture& b) {
    index("index", b.index);
    number("x", b.x);
    number("y", b.y);
    number("scale", b.scale);
    number("rotation", b.rotation);
  }
  void operator()(const SelectTexture& b) {
    index("index", b.index);
    textures(b.textures);
  }
  void operator()(const TransitionTexture& b) {
    index("material", b.material);
    textures(b.textures);
  }
  void operator()(const BorderTexture& b) {
    index("material", b.material);
    texture("inside", b.inside);
    texture("below", b.below);
  }
  void operator()(const HeightBlendTexture& b) {
    index("areas", b.areas);
    textures(b.textures);
  }
  void operator()(const LayersTexture& b) { textures(b.textures); }
  void operator()(const MovedTexture& b) {
    texture("texture", b.texture);
    number("x", b.x);
    number("y", b.y);
  }
};

template <typename Block>
concept ReadsSource = requires(const Block& block) {
  block.source.get();
};

} // namespace

ValueKind kind_of(const PatternBlock& block) {
  // In the variant's order: indices, numbers, textures.
  const PatternBlock first_number = ConstantNumber{}, first_texture = ConstantTexture{};
  if (block.index() < first_number.index()) return ValueKind::index;
  return block.index() < first_texture.index() ? ValueKind::number : ValueKind::texture;
}

std::vector<NodeInput> inputs_of(const PatternBlock& block) {
  InputList inputs;
  std::visit(inputs, block);
  return inputs.list;
}

const PatternSource* source_of(const PatternBlock& block) {
  return std::visit(
      [](const auto& b) -> const PatternSource* {
        if constexpr (ReadsSource<std::decay_t<decltype(b)>>)
          return b.source.get();
        else
          return nullptr;
      },
      block);
}

std::vector<bool> reachable_nodes(const PatternGraph& graph) {
  std::vector<bool> reachable(graph.nodes.size());
  if (graph.output < 0 || static_cast<std::size_t>(graph.output) >= graph.nodes.size()) return reachable;
  reachable[static_cast<std::size_t>(graph.output)] = true;
  for (std::size_t i = graph.nodes.size(); i-- > 0;) { // users stand after their inputs
    if (!reachable[i]) continue;
    for (const NodeInput& input : inputs_of(graph.nodes[i].block))
      if (input.node >= 0 && static_cast<std::size_t>(input.node) < i)
        reachable[static_cast<std::size_t>(input.node)] = true;
  }
  return reachable;
}

} // namespace tilepack
