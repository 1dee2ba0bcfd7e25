#include "tilepack/json/json_value.h"
#include "tilepack/report/scene_picture.h"

#include <fmt/format.h>

namespace tilepack {
namespace {

// What stands at an input, for people: a name, a number, how many.
std::string shown(const SceneFile& scene, const SceneValue& value) {
  const auto name_of_node = [&](int node) { return scene.nodes[static_cast<std::size_t>(node)].name; };
  if (value.node >= 0) return name_of_node(value.node);
  std::string text;
  for (const int node : value.nodes) text += (text.empty() ? "" : ", ") + name_of_node(node);
  if (!text.empty()) return text;
  if (!value.texts.empty())
    return value.texts.size() == 1
               ? value.texts.front()
               : fmt::format("{} and {} more", value.texts.front(), value.texts.size() - 1);
  if (!value.cells.empty()) return fmt::format("{} x {} numbers", value.cells.width, value.cells.height);
  if (!value.sprites.empty()) return fmt::format("{} sprites", value.sprites.size());
  if (!value.outlines.empty()) return fmt::format("{} outlines", value.outlines.size());
  if (!value.lists.empty()) return fmt::format("{} lists", value.lists.size());
  if (value.numbers.size() > 4) return fmt::format("{} numbers", value.numbers.size());
  for (const double number : value.numbers) text += fmt::format("{}{}", text.empty() ? "" : ", ", number);
  return text;
}

} // namespace

std::string scene_summary_text(const SceneFile& scene) {
  std::string maps;
  for (const SceneMap& map : scene.maps)
    maps += fmt::format("{}{} ({}, {} channels)", maps.empty() ? "" : ", ", map.name, name_of(map.role),
                        map.channels);
  std::string text = fmt::format("{}: scene of {} x {} texels, {} nodes\n  maps    {}\n  output  {}\n\n",
                                 scene.file, scene.size[0], scene.size[1], scene.nodes.size(), maps,
                                 scene.nodes[static_cast<std::size_t>(scene.output)].name);
  for (const SceneNode& node : scene.nodes) {
    text += fmt::format("  {} ({}) gives {} {}\n", node.name, node.block->name,
                        node.gives == SceneKind::index ? "an" : "a", name_of(node.gives));
    for (const auto& [name, value] : node.inputs)
      text += fmt::format("    {}: {}\n", name, shown(scene, value));
  }
  return text;
}

std::string scene_summary_json(const SceneFile& scene) {
  JsonValue maps = JsonValue::array();
  for (const SceneMap& map : scene.maps)
    maps.push_back({{"name", map.name}, {"role", name_of(map.role)}, {"channels", map.channels}});
  JsonValue nodes = JsonValue::array();
  for (const SceneNode& node : scene.nodes) {
    JsonValue inputs = JsonValue::object();
    JsonValue from = JsonValue::array();
    for (const auto& [name, value] : node.inputs) {
      inputs[name] = shown(scene, value);
      if (value.node >= 0) from.push_back(scene.nodes[static_cast<std::size_t>(value.node)].name);
      for (const int listed : value.nodes) from.push_back(scene.nodes[static_cast<std::size_t>(listed)].name);
    }
    nodes.push_back({{"name", node.name},
                     {"block", node.block->name},
                     {"gives", name_of(node.gives)},
                     {"from", std::move(from)},
                     {"inputs", std::move(inputs)}});
  }
  return json_text({{"scene", scene.file},
                    {"size", JsonValue::array({scene.size[0], scene.size[1]})},
                    {"maps", std::move(maps)},
                    {"output", scene.nodes[static_cast<std::size_t>(scene.output)].name},
                    {"nodes", std::move(nodes)}});
}

} // namespace tilepack
