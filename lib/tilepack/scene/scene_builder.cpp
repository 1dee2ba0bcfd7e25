#include "tilepack/scene/scene_builder.h"

#include "tilepack/json/json_line.h"
#include "tilepack/numeric/random.h"
#include "tilepack/pattern/pattern_choice.h"
#include "tilepack/scene/scene_limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tilepack {
namespace {

std::vector<char> needed_nodes(const SceneFile& scene) {
  std::vector<char> needed(scene.nodes.size(), 0);
  if (scene.output >= 0) needed[static_cast<std::size_t>(scene.output)] = 1;
  // Users come after what they use.
  for (std::size_t i = scene.nodes.size(); i-- > 0;) {
    if (needed[i] == 0) continue;
    for (const auto& [name, value] : scene.nodes[i].inputs) {
      if (value.node >= 0) needed[static_cast<std::size_t>(value.node)] = 1;
      for (const int listed : value.nodes) needed[static_cast<std::size_t>(listed)] = 1;
    }
  }
  return needed;
}

} // namespace

SceneBuilder::SceneBuilder(const SceneFile& of_scene, SceneFiles& of_files, double at_time)
    : scene(&of_scene), files(&of_files), time(at_time), needed(needed_nodes(of_scene)),
      grids(of_scene.nodes.size(), PatternGrid{0, 0}), highest(of_scene.nodes.size(), -1),
      placings(of_scene.nodes.size()) {
  made.node_of.assign(of_scene.nodes.size(), no_node);
  for (const SceneMap& map : of_scene.maps) made.graph.maps.push_back({map.name, map.role, map.channels});
}

void SceneBuilder::fail(SceneFault fault, const SceneNode& node, std::string_view input,
                        const std::string& what) const {
  const std::string place =
      input.empty() ? fmt::format("nodes.{}", node.name) : fmt::format("nodes.{}.{}", node.name, input);
  throw SceneFailure{{fault, place, json_line(scene->text, place), what}};
}

void SceneBuilder::find_units() {
  struct Laid {
    PatternGrid grid;
    bool is_stored = false;
  };
  std::vector<Laid> all;
  for (std::size_t i = 0; i < scene->nodes.size(); ++i) {
    if (needed[i] == 0) continue;
    const SceneNode& node = scene->nodes[i];
    const std::string_view block = node.block->name;
    std::string_view input = "map";
    bool is_stored = true;
    if (block == "tile-map") {
      const auto& cells = node.find("cells")->numbers;
      grids[i] = {static_cast<std::int64_t>(cells[0]), static_cast<std::int64_t>(cells[1])};
      input = "cells";
      is_stored = false;
    } else if (block == "pack") {
      grids[i] = wang_grid(node);
      input = "file";
      is_stored = false;
    } else if (block == "areas-map" || block == "number-map") {
      grids[i] = map_input(node, block == "areas-map")->grid();
    } else {
      continue;
    }
    const std::array<std::int64_t, 2> cells{grids[i].width, grids[i].height};
    for (std::size_t axis = 0; axis < 2; ++axis)
      if (scene->size[axis] % cells[axis] != 0)
        fail(SceneFault::size, node, input,
             fmt::format("{} {} don't divide the {} texels of the scene; a cell is a whole number of texels",
                         cells[axis], axis == 0 ? "columns" : "rows", scene->size[axis]));
    all.push_back({grids[i], is_stored});
  }
  const auto units_along = [&](auto cells_of, std::int64_t texels) {
    std::int64_t finest = 1, common = 0;
    for (const Laid& laid : all) {
      if (!laid.is_stored) finest = std::max(finest, cells_of(laid.grid));
      common = std::gcd(common, cells_of(laid.grid));
    }
    const bool fits = std::all_of(all.begin(), all.end(),
                                  [&](const Laid& laid) { return fits_scene(cells_of(laid.grid), finest); });
    std::int64_t units = fits ? finest : std::max<std::int64_t>(common, 1);
    while (texels / units > 65536 && texels % (units * 2) == 0 && units < std::int64_t{1} << 30 &&
           all.empty())
      units *= 2;
    return units;
  };
  made.graph.scene = {units_along([](const PatternGrid& grid) { return grid.width; }, scene->size[0]),
                      units_along([](const PatternGrid& grid) { return grid.height; }, scene->size[1])};
  const std::int64_t wide = scene->size[0] / made.graph.scene.width;
  const std::int64_t high = scene->size[1] / made.graph.scene.height;
  if (std::max(wide, high) > std::int64_t{1} << 30)
    throw SceneFailure{{SceneFault::size, "size", json_line(scene->text, "size"),
                        "is too large for grids so coarse: cells have 2^30 texels a side at most"}};
  made.graph.unit = {static_cast<int>(wide), static_cast<int>(high)};
}

void SceneBuilder::build(int number) {
  const auto at = static_cast<std::size_t>(number);
  const SceneNode& node = scene->nodes[at];
  if (node.block->name == "tile-map") return;
  if (node.gives == SceneKind::place) {
    placings[at] = node.block->name == "tile-transform" ? transform(node) : sprites(node);
    return;
  }
  if (Block block = block_of(number)) made.node_of[at] = add(node.name, std::move(*block));
}

SceneGraph SceneBuilder::finish() {
  made.graph.output = made.node_of[static_cast<std::size_t>(scene->output)];
  return std::move(made);
}

NodeId SceneBuilder::add(const std::string& name, PatternBlock block) {
  made.graph.nodes.push_back({name, std::move(block)});
  return static_cast<NodeId>(made.graph.nodes.size()) - 1;
}

PatternGrid SceneBuilder::grid_input(const SceneNode& node, std::string_view input) const {
  return grids[static_cast<std::size_t>(node.node_at(input))];
}

NodeId SceneBuilder::index_input(const SceneNode& node, std::string_view input) {
  const int given = node.node_at(input);
  if (given >= 0) return made.node_of[static_cast<std::size_t>(given)];
  return add(fmt::format("{}.{}", node.name, input),
             ConstantIndex{static_cast<std::int64_t>(node.number(input))});
}

NodeId SceneBuilder::number_input(const SceneNode& node, std::string_view input, bool is_always) {
  const int given = node.node_at(input);
  const std::string name = fmt::format("{}.{}", node.name, input);
  if (given < 0) {
    if (node.find(input) == nullptr && !is_always) return no_node;
    return add(name, ConstantNumber{node.number(input)});
  }
  const NodeId from = made.node_of[static_cast<std::size_t>(given)];
  return node_at(given).gives == SceneKind::index ? add(name, IndexedNumber{from}) : from;
}

NodeId SceneBuilder::length_input(const SceneNode& node, std::string_view input, int texels) {
  const std::string name = fmt::format("{}.{}", node.name, input);
  if (node.node_at(input) < 0) return add(name, ConstantNumber{node.number(input) / texels});
  const NodeId length = number_input(node, input, true);
  return add(name + ".units",
             ArithmeticNumber{NumberOperation::divide, length,
                              add(name + ".unit", ConstantNumber{static_cast<double>(texels)})});
}

NodeId SceneBuilder::texture_input(const SceneNode& node, std::string_view input) {
  const int given = node.node_at(input);
  if (given >= 0) return made.node_of[static_cast<std::size_t>(given)];
  return add(fmt::format("{}.{}", node.name, input), constant_texture(node, input));
}

PatternBlock SceneBuilder::constant_texture(const SceneNode& node, std::string_view input) const {
  const std::vector<double>& given = node.find(input)->numbers;
  const SceneMap& map = scene->maps.front();
  ConstantTexture texture;
  texture.values.resize(scene->maps.size());
  std::vector<double>& values = texture.values.front();
  const bool has_alpha = given.size() == 2 || given.size() == 4;
  const std::size_t colors = has_alpha ? given.size() - 1 : given.size();
  const bool takes_alpha = map.channels == 2 || map.channels == 4;
  const auto wanted = static_cast<std::size_t>(takes_alpha ? map.channels - 1 : map.channels);
  if (colors > wanted)
    fail(SceneFault::field, node, input,
         fmt::format("has {} numbers, and the map \"{}\" of the scene {} channels", given.size(), map.name,
                     map.channels));
  for (std::size_t c = 0; c < wanted; ++c) values.push_back(given[colors == 1 ? 0 : c]);
  if (takes_alpha) values.push_back(has_alpha ? given.back() : 1);
  return texture;
}

std::vector<NodeId> SceneBuilder::texture_inputs(const SceneNode& node) const {
  std::vector<NodeId> textures;
  for (const int listed : node.find("textures")->nodes)
    textures.push_back(made.node_of[static_cast<std::size_t>(listed)]);
  return textures;
}

std::shared_ptr<const StoredMap> SceneBuilder::map_input(const SceneNode& node, bool is_whole) {
  const SceneValue& value = *node.find("map");
  if (!value.texts.empty()) return files->map(value.texts.front(), is_whole, scene->place(node, "map"));
  return std::make_shared<StoredMap>(value.cells);
}

std::shared_ptr<const PatternSource> SceneBuilder::patterns_input(const SceneNode& node) {
  const SceneValue* patterns = node.find("patterns");
  const SceneValue* pack = node.find("pack");
  if ((patterns == nullptr) == (pack == nullptr))
    fail(SceneFault::field, node, "", "needs either \"patterns\", a list of pictures, or \"pack\"");
  if (patterns != nullptr) return files->patterns(patterns->texts, scene->place(node, "patterns"));
  return files->pack(pack->texts.front(), scene->place(node, "pack")).source;
}

HashKind SceneBuilder::hash_input(const SceneNode& node) const {
  return *enum_named<HashKind>(node.word("hash"));
}

std::uint64_t SceneBuilder::seed_input(const SceneNode& node) const {
  const SceneValue* seed = node.find("seed");
  return seed == nullptr
             ? random_bits(scene->seed, node.name, 0)
             : random_bits(scene->seed, "scene node", static_cast<std::uint64_t>(seed->numbers.front()));
}

std::vector<int> SceneBuilder::probability_table(const SceneNode& node, std::string_view input,
                                                 const std::vector<double>& probabilities) const {
  const double sum = std::accumulate(probabilities.begin(), probabilities.end(), 0.0);
  if (std::abs(sum - 1) > 1e-6)
    fail(SceneFault::probability, node, input,
         fmt::format("the {} probabilities sum to {:.6g}; they must sum to 1", probabilities.size(), sum));
  const int entries = static_cast<int>(node.number("entries"));
  std::vector<int> table = probability_map(probabilities, entries);
  if (node.flag("blank"))
    std::replace(table.begin(), table.end(), static_cast<int>(probabilities.size()) - 1, -1);
  return table;
}

PatternGrid SceneBuilder::coarse_grid(const SceneNode& node, std::string_view input) const {
  const PatternGrid grid =
      node.node_at(input) < 0 ? PatternGrid{0, 0} : grids[static_cast<std::size_t>(node.node_at(input))];
  if (grid.width == 0)
    fail(SceneFault::size, node, input,
         "is not constant in cells; take an areas-map, or an index computed for the cells of a coarse "
         "tile-map");
  return grid;
}

void SceneBuilder::check_choice(const SceneNode& node, std::string_view input, std::int64_t count,
                                std::string_view of) const {
  const int given = node.node_at(input);
  const std::int64_t most =
      given >= 0 ? highest[static_cast<std::size_t>(given)] : static_cast<std::int64_t>(node.number(input));
  if (most >= count)
    fail(SceneFault::index, node, input,
         fmt::format("gives numbers up to {}, and there {} {} {}, counted from 0", most,
                     count == 1 ? "is" : "are", count, of));
}

} // namespace tilepack
