#include "tilepack/pattern/pattern_choice.h"
#include "tilepack/pattern/transition_tiles.h"
#include "tilepack/scene/scene_builder.h"
#include "tilepack/scene/scene_limits.h"
#include "tilepack/scene/sprite_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tilepack {

SceneBuilder::Block SceneBuilder::block_of(int node) {
  for (const auto make : {&SceneBuilder::choice_block, &SceneBuilder::transition_block,
                          &SceneBuilder::animation_block, &SceneBuilder::texture_block})
    if (Block block = (this->*make)(node)) return block;
  return std::nullopt;
}

SceneBuilder::Block SceneBuilder::choice_block(int number) {
  const auto at = static_cast<std::size_t>(number);
  const SceneNode& node = scene->nodes[at];
  const std::string_view block = node.block->name;
  if (block == "indirection-map" || block == "areas-map") return stored_index(number);
  if (block == "probability-map") return probability_index(number);
  if (block == "materials-map") return material_index(number);
  if (block == "reference-texture") return reference_texture(node);
  if (block == "virtual-indirection-map") {
    grids[at] = grid_input(node, "grid");
    highest[at] = static_cast<std::int64_t>(node.number("count")) - 1;
    return RandomIndex{grids[at], static_cast<int>(node.number("count")), seed_input(node), 0,
                       hash_input(node)};
  }
  if (block == "random-map") {
    const SceneValue* range = node.find("range");
    return RandomNumber{grid_input(node, "grid"),
                        range == nullptr ? 0 : range->numbers[0],
                        range == nullptr ? 1 : range->numbers[1],
                        seed_input(node),
                        0,
                        hash_input(node)};
  }
  if (block == "dithered-areas-map") {
    grids[at] = grid_input(node, "grid");
    const int areas = node.node_at("areas");
    if (areas >= 0) highest[at] = highest[static_cast<std::size_t>(areas)];
    const PatternGrid coarse = coarse_grid(node, "areas");
    if (grids[at].width % coarse.width != 0 || grids[at].height % coarse.height != 0)
      fail(SceneFault::size, node, "grid",
           fmt::format("{} x {} cells; areas are {} x {}, and each must hold a whole number of cells",
                       grids[at].width, grids[at].height, coarse.width, coarse.height));
    return DitheredIndex{index_input(node, "areas"), coarse, grids[at],
                         seed_input(node),           0,      hash_input(node)};
  }
  if (block == "select") {
    const std::vector<NodeId> textures = texture_inputs(node);
    check_choice(node, "index", static_cast<std::int64_t>(textures.size()), "textures");
    return SelectTexture{index_input(node, "index"), textures};
  }
  return std::nullopt;
}

PatternBlock SceneBuilder::stored_index(int number) {
  const auto at = static_cast<std::size_t>(number);
  const SceneNode& node = scene->nodes[at];
  const SceneValue& value = *node.find("map");
  if (node.block->name == "indirection-map") {
    grids[at] = grid_input(node, "grid");
    const double cells = static_cast<double>(grids[at].width) * static_cast<double>(grids[at].height);
    if (cells > scene_limits::most_stored_cells)
      fail(SceneFault::stored, node, "grid",
           fmt::format(
               "{} x {} cells would be stored, and 2^28 are the most; take a virtual-indirection-map, which "
               "stores none, or an areas-map of fewer",
               grids[at].width, grids[at].height));
  }
  const auto map = map_input(node, true);
  if (node.block->name == "indirection-map" && !(map->grid() == grids[at]))
    fail(SceneFault::size, node, "map",
         fmt::format("has {} x {} numbers, and the grid {} x {} cells; it needs one a cell",
                     map->grid().width, map->grid().height, grids[at].width, grids[at].height));
  grids[at] = map->grid();
  if (value.texts.empty())
    highest[at] =
        static_cast<std::int64_t>(*std::max_element(value.cells.values.begin(), value.cells.values.end()));
  return StoredIndex{map};
}

PatternBlock SceneBuilder::probability_index(int number) {
  const auto at = static_cast<std::size_t>(number);
  const SceneNode& node = scene->nodes[at];
  grids[at] = grid_input(node, "grid");
  TableIndex table;
  table.entries = probability_table(node, "probabilities", node.find("probabilities")->numbers);
  highest[at] = *std::max_element(table.entries.begin(), table.entries.end());
  table.index = add(node.name + ".random", RandomIndex{grids[at], static_cast<int>(table.entries.size()),
                                                       seed_input(node), 0, hash_input(node)});
  return table;
}

PatternBlock SceneBuilder::material_index(int number) {
  const auto at = static_cast<std::size_t>(number);
  const SceneNode& node = scene->nodes[at];
  grids[at] = grid_input(node, "grid");
  const auto& lists = node.find("materials")->lists;
  MaterialIndex choice;
  for (std::size_t i = 0; i < lists.size(); ++i) {
    choice.table.materials.push_back(probability_table(node, fmt::format("materials[{}]", i), lists[i]));
    for (const int entry : choice.table.materials.back())
      highest[at] = std::max<std::int64_t>(highest[at], entry);
  }
  check_choice(node, "material", static_cast<std::int64_t>(lists.size()), "materials");
  choice.material = index_input(node, "material");
  choice.index = add(node.name + ".random", RandomIndex{grids[at], static_cast<int>(node.number("entries")),
                                                        seed_input(node), 0, hash_input(node)});
  return choice;
}

PatternBlock SceneBuilder::reference_texture(const SceneNode& node) {
  const auto source = patterns_input(node);
  const ScenePlacing& placing = placings[static_cast<std::size_t>(node.node_at("place"))];
  const int there = source->facts().tiles;
  if (placing.sprites != nullptr) {
    if (placing.most_pattern >= there)
      fail(SceneFault::index, node, "place",
           fmt::format("has sprites of patterns up to {}, and there are {} patterns, counted from 0",
                       placing.most_pattern, there));
    return SpritesTexture{source, placing.sprites};
  }
  check_choice(node, "pattern", there, "patterns");
  PatternsTexture texture;
  texture.source = source;
  texture.index = index_input(node, "pattern");
  texture.seamless = node.flag("seamless");
  if (node_at(node.node_at("place")).gives == SceneKind::grid) {
    texture.grid = grid_input(node, "place");
    return texture;
  }
  texture.grid = placing.grid;
  texture.fit = placing.fit;
  texture.x = placing.x;
  texture.y = placing.y;
  texture.scale = placing.scale;
  texture.rotation = placing.rotation;
  return texture;
}

ScenePlacing SceneBuilder::transform(const SceneNode& node) {
  ScenePlacing placing;
  placing.grid = grid_input(node, "grid");
  placing.fit = *enum_named<TransformFit>(node.word("fit"));
  placing.x = number_input(node, "x");
  placing.y = number_input(node, "y");
  placing.scale = number_input(node, "scale");
  placing.rotation = number_input(node, "rotate");
  return placing;
}

ScenePlacing SceneBuilder::sprites(const SceneNode& node) const {
  ScenePlacing placing;
  placing.grid = grid_input(node, "grid");
  constexpr int layers = 64; // that a cell may hold; only those used take memory
  auto map = std::make_shared<SpriteMap>(placing.grid, layers);
  const auto& list = node.find("sprites")->sprites;
  for (std::size_t i = 0; i < list.size(); ++i) {
    try {
      map->set(static_cast<int>(i), sprite_at_time(list[i], time, placing.grid));
    } catch (const Error& error) {
      fail(SceneFault::index, node, fmt::format("sprites[{}]", i), error.what_happened());
    }
    placing.most_pattern = std::max(placing.most_pattern, list[i].pattern);
  }
  placing.sprites = std::move(map);
  return placing;
}

SceneBuilder::Block SceneBuilder::texture_block(int number) {
  const SceneNode& node = scene->nodes[static_cast<std::size_t>(number)];
  const std::string_view block = node.block->name;
  if (block == "color") return constant_texture(node, "value");
  if (block == "pack") return wang_texture(node);
  if (block == "layers") return LayersTexture{texture_inputs(node)};
  if (block == "moved")
    return MovedTexture{texture_input(node, "texture"), length_input(node, "x", made.graph.unit.width),
                        length_input(node, "y", made.graph.unit.height)};
  return std::nullopt;
}

PatternBlock SceneBuilder::wang_texture(const SceneNode& node) {
  return WangTexture{files->pack(node.find("file")->texts.front(), scene->place(node, "file")).source,
                     wang_grid(node)};
}

PatternGrid SceneBuilder::wang_grid(const SceneNode& node) const {
  const auto& pack = files->pack(node.find("file")->texts.front(), scene->place(node, "file")).pack;
  const double scale = node.number("scale");
  const double wide = static_cast<double>(scene->size[0]) / (pack.tile_size.width * scale);
  const double high = static_cast<double>(scene->size[1]) / (pack.tile_size.height * scale);
  const auto is_whole = [](double tiles) {
    return tiles >= 1 && tiles <= scene_limits::most_cells && tiles == std::floor(tiles);
  };
  if (!is_whole(wide) || !is_whole(high))
    fail(SceneFault::size, node, "file",
         fmt::format(
             "tiles of {} x {} texels at scale {} lie {:.6g} x {:.6g} times in the {} x {} texels of the "
             "scene; they "
             "must do so a whole number of times, 1 to 2^31: change the size of the scene or the scale",
             pack.tile_size.width, pack.tile_size.height, scale, wide, high, scene->size[0], scene->size[1]));
  return {static_cast<std::int64_t>(wide), static_cast<std::int64_t>(high)};
}

} // namespace tilepack
