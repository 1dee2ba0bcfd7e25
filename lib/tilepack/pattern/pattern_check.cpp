#include "tilepack/error/error.h"
#include "tilepack/pattern/pattern_graph.h"

#include <fmt/format.h>

#include <cmath>
#include <set>

namespace tilepack {
namespace {

constexpr std::int64_t longest_scene_side = std::int64_t{1} << 31;

std::string spelled_grid(PatternGrid grid) {
  return fmt::format("{} x {}", grid.width, grid.height);
}

// Checks one node; what it says names that node.
struct NodeCheck {
  const PatternGraph& graph;
  std::size_t number;

  const PatternNode& node() const { return graph.nodes[number]; }

  [[noreturn]] void fail(const std::string& what) const {
    throw Error(ErrorKind::invalid_content, fmt::format("node '{}'", node().name), what);
  }
  void need(bool holds, const std::string& what) const {
    if (!holds) fail(what);
  }

  void inputs() const {
    for (const NodeInput& input : inputs_of(node().block)) {
      if (input.node == no_node) {
        need(!input.required,
             fmt::format("input '{}' is missing; it needs a node that gives {} {}", input.name,
                         input.kind == ValueKind::index ? "an" : "a", name_of(input.kind)));
        continue;
      }
      need(input.node >= 0 && static_cast<std::size_t>(input.node) < number,
           fmt::format("input '{}' is node number {}, which does not stand before it", input.name,
                       input.node));
      const PatternNode& given = graph.nodes[static_cast<std::size_t>(input.node)];
      need(kind_of(given.block) == input.kind,
           fmt::format("input '{}' takes {} {}, and node '{}' gives {} {}", input.name,
                       input.kind == ValueKind::index ? "an" : "a", name_of(input.kind), given.name,
                       kind_of(given.block) == ValueKind::index ? "an" : "a", name_of(kind_of(given.block))));
    }
  }

  void grid(PatternGrid cells, const char* name = "grid") const {
    need(cells.width >= 1 && cells.height >= 1 && cells.width <= longest_scene_side &&
             cells.height <= longest_scene_side,
         fmt::format("{} of {} cells; each side is 1 to 2^31", name, spelled_grid(cells)));
    need(fits_scene(cells.width, graph.scene.width) && fits_scene(cells.height, graph.scene.height),
         fmt::format("{} of {} cells does not divide the scene of {} units, nor the scene it", name,
                     spelled_grid(cells), spelled_grid(graph.scene)));
  }

  template <typename Map>
  void stored(const std::shared_ptr<const Map>& map) const {
    need(map != nullptr, "input 'map' is missing; it needs a stored map");
    grid(map->grid(), "map");
  }

  void source(const std::shared_ptr<const PatternSource>& from) const {
    need(from != nullptr, "input 'source' is missing; it needs a pack or a set of patterns");
    const PackFacts& facts = from->facts();
    need(facts.map_of.size() == graph.maps.size(),
         fmt::format("input 'source' ({}) tells of {} maps; the scene has {}", facts.name,
                     facts.map_of.size(), graph.maps.size()));
    need(facts.tiles >= 1 && facts.levels >= 1 && facts.tile_size.width >= 1 && facts.tile_size.height >= 1,
         fmt::format("input 'source' ({}) holds no tiles", facts.name));
  }

  void count(const char* name, std::int64_t value, std::int64_t least, std::int64_t most) const {
    need(value >= least && value <= most,
         fmt::format("{} is {}; it must be {} to {}", name, value, least, most));
  }

  // A table indexed by evenly random numbers gives each entry as often as the next only if their number divides.
  void unbiased(NodeId index, std::size_t entries) const {
    need(entries >= 1 && entries <= 65536,
         fmt::format("a table of {} entries; it must have 1 to 65536", entries));
    const auto* random = std::get_if<RandomIndex>(&graph.nodes[static_cast<std::size_t>(index)].block);
    need(random == nullptr || static_cast<std::size_t>(random->values) % entries == 0,
         fmt::format("a table of {} entries at a random index of {} values: some would come more often than "
                     "others; make "
                     "the values a multiple of the entries",
                     entries, random == nullptr ? 0 : random->values));
  }

  void operator()(const ConstantIndex&) const {}
  void operator()(const StoredIndex& b) const { stored(b.map); }
  void operator()(const RandomIndex& b) const {
    grid(b.grid);
    count("values", b.values, 1, 65536);
    count("stream", b.stream, 0, 1023);
  }
  void operator()(const TableIndex& b) const { unbiased(b.index, b.entries.size()); }
  void operator()(const MaterialIndex& b) const {
    need(!b.table.materials.empty(), "it has no materials");
    for (const std::vector<int>& map : b.table.materials) unbiased(b.index, map.size());
  }
  void operator()(const DitheredIndex& b) const {
    grid(b.coarse, "coarse");
    grid(b.grid);
    need(b.grid.width % b.coarse.width == 0 && b.grid.height % b.coarse.height == 0,
         fmt::format("grid of {} cells is no multiple of the {} areas", spelled_grid(b.grid),
                     spelled_grid(b.coarse)));
    count("stream", b.stream, 0, 511);
  }
  void operator()(const PixelIndex& b) const { stored(b.map); }
  void operator()(const CornerIndex& b) const {
    grid(b.grid);
    count("families", b.families, 2, 16);
  }
  void operator()(const AnimationIndex& b) const {
    grid(b.grid);
    count("length", b.length, 1, 65536);
  }
  void operator()(const FlooredIndex& b) const { count("values", b.values, 1, 65536); }
  void operator()(const ConstantNumber& b) const { need(std::isfinite(b.value), "its value is not finite"); }
  void operator()(const RandomNumber& b) const {
    grid(b.grid);
    count("stream", b.stream, 0, 1023);
    need(std::isfinite(b.low) && std::isfinite(b.high), "its range is not finite");
  }
  void operator()(const StoredNumber& b) const { stored(b.map); }
  void operator()(const TimeNumber&) const {}
  void operator()(const DistanceNumber&) const {}
  void operator()(const IndexedNumber&) const {}
  void operator()(const ArithmeticNumber&) const {}

  void operator()(const ConstantTexture& b) const {
    need(b.values.size() == graph.maps.size(),
         fmt::format("it has values for {} maps; the scene has {}", b.values.size(), graph.maps.size()));
    for (std::size_t map = 0; map < b.values.size(); ++map)
      need(b.values[map].empty() ||
               b.values[map].size() == static_cast<std::size_t>(graph.maps[map].channels),
           fmt::format("it has {} values for map '{}' of {} channels", b.values[map].size(),
                       graph.maps[map].name, graph.maps[map].channels));
  }
  void operator()(const WangTexture& b) const {
    source(b.source);
    grid(b.grid);
  }
  void operator()(const PatternsTexture& b) const {
    source(b.source);
    grid(b.grid);
  }
  void operator()(const SpritesTexture& b) const {
    source(b.source);
    need(b.sprites != nullptr, "it has no sprites");
    grid(b.sprites->grid());
  }
  void operator()(const SelectTexture& b) const { need(!b.textures.empty(), "it has no textures"); }
  void operator()(const TransitionTexture& b) const {
    source(b.source);
    grid(b.grid);
    count("number of textures", static_cast<std::int64_t>(b.textures.size()), 2, 16);
    count("variants", b.variants, 1, 64);
    count("colors of a material", b.colors_of_material, 1, 8);
    std::int64_t codes = 1;
    for (int i = 0; i < 4; ++i) codes *= static_cast<std::int64_t>(b.textures.size()) * b.colors_of_material;
    const int tiles = b.source->facts().tiles;
    if (b.tiles.empty()) {
      need(tiles >= codes * b.variants,
           fmt::format("input 'source' ({}) has {} tiles; {} materials at four corners in {} "
                       "variants need {}",
                       b.source->facts().name, tiles, b.textures.size(), b.variants, codes * b.variants));
      return;
    }
    need(static_cast<std::int64_t>(b.tiles.size()) == codes * b.variants,
         fmt::format("it names {} tiles; {} materials at four corners in {} variants need {}", b.tiles.size(),
                     b.textures.size(), b.variants, codes * b.variants));
    for (const int tile : b.tiles)
      need(tile >= -1 && tile < tiles, fmt::format("it names tile {}; the set has 0 to {}", tile, tiles - 1));
  }
  void operator()(const BorderTexture& b) const {
    source(b.source);
    grid(b.grid);
    count("variants", b.variants, 1, 64);
    need(b.source->facts().tiles >= 16 * b.variants,
         fmt::format("input 'source' ({}) has {} tiles; the border of a material in {} variants needs {}",
                     b.source->facts().name, b.source->facts().tiles, b.variants, 16 * b.variants));
  }
  void operator()(const HeightBlendTexture& b) const {
    grid(b.grid);
    count("number of textures", static_cast<std::int64_t>(b.textures.size()), 2, 16);
    count("height", b.height, -1, static_cast<std::int64_t>(graph.maps.size()) - 1);
    const double texels =
        static_cast<double>(graph.scene.width) / static_cast<double>(b.grid.width) * graph.unit.width;
    need(b.width > 0 && b.relief >= 0 && b.width / texels + b.relief <= 1,
         fmt::format("width {} and relief {}: of the {} texels from one centre of an area to the next, the "
                     "border's width "
                     "and what heights may move it take up more than all",
                     b.width, b.relief, texels));
  }
  void operator()(const LayersTexture& b) const { need(!b.textures.empty(), "it has no textures"); }
  void operator()(const MovedTexture&) const {}
};

} // namespace

void check_pattern_graph(const PatternGraph& graph) {
  const auto need = [](bool holds, const std::string& what) {
    if (!holds) throw Error(ErrorKind::invalid_content, "scene", what);
  };
  need(graph.scene.width >= 1 && graph.scene.height >= 1 && graph.scene.width <= longest_scene_side &&
           graph.scene.height <= longest_scene_side,
       fmt::format("it is {} units large; each side is 1 to 2^31", spelled_grid(graph.scene)));
  need(graph.unit.width >= 1 && graph.unit.height >= 1 && graph.unit.width <= 65536 &&
           graph.unit.height <= 65536,
       fmt::format("a unit is {} x {} texels; each side is 1 to 65536", graph.unit.width, graph.unit.height));
  need(!graph.maps.empty(), "it has no map");
  for (const PatternMapFacts& map : graph.maps)
    need(map.channels >= 1 && map.channels <= 4,
         fmt::format("map '{}' has {} channels; it must have 1 to 4", map.name, map.channels));
  std::set<std::string> names;
  for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
    const NodeCheck check{graph, i};
    check.need(names.insert(graph.nodes[i].name).second, "there are two nodes of this name");
    check.inputs();
    std::visit(check, graph.nodes[i].block);
  }
  need(graph.output >= 0 && static_cast<std::size_t>(graph.output) < graph.nodes.size(),
       fmt::format("its output is node number {}; there are {} nodes", graph.output, graph.nodes.size()));
  const PatternNode& output = graph.nodes[static_cast<std::size_t>(graph.output)];
  need(kind_of(output.block) == ValueKind::texture,
       fmt::format("its output, node '{}', gives no texture", output.name));
}

} // namespace tilepack
