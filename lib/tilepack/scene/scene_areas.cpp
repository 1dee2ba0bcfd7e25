// Nodes that join areas, and those that change with time.

#include "tilepack/pattern/transition_tiles.h"
#include "tilepack/scene/scene_builder.h"
#include "tilepack/scene/scene_limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <variant>

namespace tilepack {

SceneBuilder::Block SceneBuilder::transition_block(int number) {
  const SceneNode& node = scene->nodes[static_cast<std::size_t>(number)];
  const std::string_view block = node.block->name;
  if (block == "pixel-map") return pixel_index(number);
  if (block == "transition-tiles") return transition_texture(node);
  if (block == "border-tiles") return border_texture(node);
  if (block == "height-blend") return blend_texture(node);
  return std::nullopt;
}

PatternBlock SceneBuilder::pixel_index(int number) {
  const auto at = static_cast<std::size_t>(number);
  const SceneNode& node = scene->nodes[at];
  const SceneValue* outlines = node.find("outlines");
  const SceneValue* map = node.find("map");
  if ((outlines == nullptr) == (map == nullptr))
    fail(SceneFault::field, node, "", "needs either \"map\", a picture, or \"outlines\", polygons");
  if (map != nullptr) {
    constexpr float most_materials = 16;
    const Grid<float>& numbers = map_input(node, true)->all();
    Grid<std::uint8_t> pixels(numbers.size());
    float most = 0;
    for (std::size_t i = 0; i < pixels.values.size(); ++i) {
      most = std::max(most, numbers.values[i]);
      pixels.values[i] = static_cast<std::uint8_t>(std::clamp(numbers.values[i], 0.0f, most_materials - 1));
    }
    if (most >= most_materials)
      fail(SceneFault::index, node, "map",
           fmt::format("holds {}; the materials of a pixel map are 0 to 15", static_cast<int>(most)));
    highest[at] = static_cast<std::int64_t>(most);
    return PixelIndex{std::make_shared<PixelMap>(pixels, static_cast<int>(most) + 1)};
  }
  const SceneValue* pixels = node.find("pixels");
  if (pixels == nullptr)
    fail(SceneFault::field, node, "", "needs \"pixels\", the size of the map that its outlines are drawn in");
  const int ground = static_cast<int>(node.number("ground"));
  int most = ground;
  std::vector<MaterialOutline> drawn;
  for (const SceneOutline& outline : outlines->outlines) {
    most = std::max(most, outline.material);
    drawn.push_back({outline.material, outline.points});
  }
  highest[at] = most;
  return PixelIndex{std::make_shared<PixelMap>(static_cast<std::int64_t>(pixels->numbers[0]),
                                               static_cast<std::int64_t>(pixels->numbers[1]), most + 1,
                                               ground, drawn)};
}

std::vector<int> SceneBuilder::tiles_by_corners(const SceneNode& node, int materials, int variants) const {
  const SceneValue* given = node.find("pack");
  if (given == nullptr) return {};
  const auto& pack = files->pack(given->texts.front(), scene->place(node, "pack")).pack;
  const auto* tiles = std::get_if<std::vector<CornerTile>>(&pack.tiles);
  if (tiles == nullptr)
    fail(SceneFault::file_kind, node, "pack",
         "has edge colors; the corner colors of its tiles must be the materials");
  const auto codes = static_cast<std::size_t>(std::pow(materials, 4));
  std::vector<int> chosen(codes * static_cast<std::size_t>(variants), -1);
  std::vector<int> found(codes, 0);
  for (std::size_t id = 0; id < tiles->size(); ++id) {
    const CornerTile& tile = (*tiles)[id];
    if (std::max({tile.nw, tile.ne, tile.sw, tile.se}) >= materials) continue;
    const auto code =
        static_cast<std::size_t>(transition_code({tile.nw, tile.ne, tile.sw, tile.se}, materials));
    if (found[code] < variants)
      chosen[code + static_cast<std::size_t>(found[code]++) * codes] = static_cast<int>(id);
  }
  const std::size_t step = (codes - 1) / (static_cast<std::size_t>(materials) - 1); // 1 1 1 1 in digits
  const auto is_plain = [&](std::size_t code) { return code % step == 0; };
  for (std::size_t code = 0; code < codes; ++code)
    if (found[code] < variants && !(is_plain(code) && node.find("textures") != nullptr))
      fail(SceneFault::index, node, "pack",
           fmt::format("has {} of the {} tiles that combination {} of {} materials needs; bake it with as "
                       "many materials and variants",
                       found[code], variants, code, materials));
  for (int& tile : chosen) tile = std::max(tile, 0); // of one material all round: passed through
  return chosen;
}

int SceneBuilder::variants_of(const SceneNode& node) const {
  const SceneValue* given = node.find("pack");
  if (node.find("variants") != nullptr || given == nullptr) return static_cast<int>(node.number("variants"));
  return files->pack(given->texts.front(), scene->place(node, "pack")).pack.colors.variants;
}

// All tiles of a pack whose corner colors are materials, those of one material all round among them, so that all join.
// Of a pack that names its materials, each may have several colors, which corners take by hash.
PatternBlock SceneBuilder::corner_tiles(const SceneNode& node) {
  const SceneValue* given = node.find("pack");
  if (given == nullptr)
    fail(SceneFault::field, node, "",
         "needs \"textures\", one a material, where it has pictures and no pack");
  const auto& pack = files->pack(given->texts.front(), scene->place(node, "pack")).pack;
  const int colors = pack.colors.corner;
  if (colors < 2)
    fail(SceneFault::file_kind, node, "pack", "has no two corner colors; they must be the materials");
  const auto names = static_cast<int>(std::set(pack.materials.begin(), pack.materials.end()).size());
  const int materials = names > 0 ? names : colors;
  const int variants = variants_of(node);
  const std::vector<int> tiles = tiles_by_corners(node, colors, variants);
  check_choice(node, "material", materials, "materials");
  MaterialIndex choice;
  const auto codes = static_cast<std::size_t>(std::pow(colors, 4));
  for (std::size_t code = 0; code < codes; ++code) {
    std::vector<int>& some = choice.table.materials.emplace_back();
    for (std::size_t i = 0; i < static_cast<std::size_t>(variants); ++i)
      some.push_back(tiles[code + i * codes]);
  }
  PatternsTexture texture;
  texture.source = patterns_input(node);
  texture.grid = grid_input(node, "grid");
  NodeId color = index_input(node, "material");
  if (const int each = colors / materials; each > 1) {
    MaterialIndex of_material;
    for (int m = 0; m < materials; ++m) {
      std::vector<int>& some = of_material.table.materials.emplace_back();
      for (int i = 0; i < each; ++i) some.push_back(m * each + i);
    }
    of_material.material = color;
    of_material.index =
        add(node.name + ".choice", RandomIndex{texture.grid, each, seed_input(node), 1, HashKind::mix});
    color = add(node.name + ".color", std::move(of_material));
  }
  choice.material = add(node.name + ".corners", CornerIndex{color, texture.grid, colors});
  choice.index =
      add(node.name + ".variant", RandomIndex{texture.grid, variants, seed_input(node), 0, HashKind::mix});
  texture.index = add(node.name + ".tile", std::move(choice));
  return texture;
}

PatternBlock SceneBuilder::transition_texture(const SceneNode& node) {
  if (node.find("textures") == nullptr) return corner_tiles(node);
  TransitionTexture texture;
  texture.textures = texture_inputs(node);
  const auto materials = static_cast<int>(texture.textures.size());
  if (materials < 2 || materials > 16)
    fail(SceneFault::field, node, "textures",
         fmt::format("names {}; transitions are between 2 to 16 materials", materials));
  texture.source = patterns_input(node);
  texture.variants = variants_of(node);
  texture.tiles = tiles_by_corners(node, materials, texture.variants);
  const double wanted = std::pow(materials, 4) * texture.variants;
  if (texture.tiles.empty() && wanted > texture.source->facts().tiles)
    fail(SceneFault::index, node, "patterns",
         fmt::format("are {}; {} materials at 4 corners and {} variants need {}",
                     texture.source->facts().tiles, materials, texture.variants, wanted));
  check_choice(node, "material", materials, "textures");
  texture.grid = grid_input(node, "grid");
  texture.material = index_input(node, "material");
  texture.seed = seed_input(node);
  return texture;
}

PatternBlock SceneBuilder::border_texture(const SceneNode& node) {
  BorderTexture texture;
  texture.source = patterns_input(node);
  texture.variants = variants_of(node);
  if (16 * texture.variants > texture.source->facts().tiles)
    fail(SceneFault::index, node, node.find("patterns") != nullptr ? "patterns" : "pack",
         fmt::format("has {} tiles; a border at 4 corners and {} variants need {}",
                     texture.source->facts().tiles, texture.variants, 16 * texture.variants));
  texture.material = index_input(node, "material");
  texture.family = static_cast<std::int64_t>(node.number("family"));
  texture.grid = grid_input(node, "grid");
  texture.seed = seed_input(node);
  texture.inside = texture_input(node, "inside");
  texture.below = texture_input(node, "below");
  return texture;
}

PatternBlock SceneBuilder::blend_texture(const SceneNode& node) {
  HeightBlendTexture texture;
  texture.textures = texture_inputs(node);
  if (texture.textures.size() < 2 || texture.textures.size() > 16)
    fail(SceneFault::field, node, "textures",
         fmt::format("names {}; 2 to 16 materials are joined", texture.textures.size()));
  texture.grid = coarse_grid(node, "areas");
  check_choice(node, "areas", static_cast<std::int64_t>(texture.textures.size()), "textures");
  texture.areas = index_input(node, "areas");
  if (const SceneValue* height = node.find("height")) {
    const auto& maps = scene->maps;
    const auto found = std::find_if(maps.begin(), maps.end(),
                                    [&](const SceneMap& map) { return map.name == height->texts.front(); });
    if (found == maps.end())
      fail(SceneFault::unknown_node, node, "height",
           fmt::format("\"{}\" is no map of the scene; name it in \"maps\"", height->texts.front()));
    texture.height = static_cast<int>(found - maps.begin());
  }
  texture.width = node.number("width");
  texture.relief = node.number("relief");
  return texture;
}

SceneBuilder::Block SceneBuilder::animation_block(int number) {
  const auto at = static_cast<std::size_t>(number);
  const SceneNode& node = scene->nodes[at];
  const std::string_view block = node.block->name;
  if (block == "animation-map") return animation_index(number);
  if (block == "animation-sequence") {
    TableIndex table;
    for (const double entry : node.find("timeline")->numbers)
      table.entries.push_back(static_cast<int>(entry));
    highest[at] = *std::max_element(table.entries.begin(), table.entries.end());
    if (node.node_at("index") >= 0) grids[at] = grids[static_cast<std::size_t>(node.node_at("index"))];
    table.index = index_input(node, "index");
    return table;
  }
  if (block == "floor") {
    highest[at] = static_cast<std::int64_t>(node.number("count")) - 1;
    return FlooredIndex{number_input(node, "number", true), static_cast<int>(node.number("count")),
                        node.flag("wrap")};
  }
  if (block == "time") return TimeNumber{};
  if (block == "distance") {
    const NodeId units =
        add(node.name + ".units", DistanceNumber{length_input(node, "x", made.graph.unit.width),
                                                 length_input(node, "y", made.graph.unit.height)});
    const NodeId unit = add(node.name + ".unit", ConstantNumber{static_cast<double>(made.graph.unit.width)});
    return ArithmeticNumber{NumberOperation::multiply, units, unit};
  }
  if (block == "number-map") {
    return StoredNumber{map_input(node, false), node.flag("smooth"), node.number("scale"),
                        node.number("offset")};
  }
  if (block == "arithmetic")
    return ArithmeticNumber{*enum_named<NumberOperation>(node.word("operation")),
                            number_input(node, "a", true), number_input(node, "b", true)};
  return std::nullopt;
}

PatternBlock SceneBuilder::animation_index(int number) {
  const auto at = static_cast<std::size_t>(number);
  const SceneNode& node = scene->nodes[at];
  AnimationIndex animation;
  animation.grid = grids[at] = grid_input(node, "grid");
  animation.length = static_cast<int>(node.number("frames"));
  highest[at] = animation.length - 1;
  animation.phase = number_input(node, "phase");
  animation.rest = number_input(node, "rest");
  animation.density = number_input(node, "density");
  animation.changes = node.find("changed-at") != nullptr;
  if (!animation.changes) return animation;
  animation.changed = static_cast<std::int64_t>(node.number("changed-at"));
  animation.rest_before =
      node.find("rest-before") != nullptr ? number_input(node, "rest-before") : animation.rest;
  animation.density_before =
      node.find("density-before") != nullptr ? number_input(node, "density-before") : animation.density;
  return animation;
}

} // namespace tilepack
