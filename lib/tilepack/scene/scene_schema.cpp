#include "tilepack/scene/scene_schema.h"

#include "tilepack/json/json_value.h"
#include "tilepack/scene/scene_blocks.h"
#include "tilepack/scene/scene_limits.h"
#include "tilepack/tileset/material_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tilepack {
namespace {

JsonValue bound(double value) {
  return value == std::floor(value) ? JsonValue(static_cast<std::int64_t>(value)) : JsonValue(value);
}

JsonValue ranged(std::string_view type, double lowest, double highest) {
  return {{"type", type}, {"minimum", bound(lowest)}, {"maximum", bound(highest)}};
}

JsonValue referred(std::string_view definition) {
  return {{"$ref", fmt::format("#/definitions/{}", definition)}};
}

JsonValue list_of(JsonValue items, std::size_t lowest, std::size_t highest) {
  return {{"type", "array"}, {"items", std::move(items)}, {"minItems", lowest}, {"maxItems", highest}};
}

JsonValue rows(JsonValue value) {
  return list_of(list_of(std::move(value), 1, scene_limits::most_written_cells), 1,
                 scene_limits::most_written_cells);
}

JsonValue node_or_constant(const SceneInput& input) {
  const auto takes = [&](SceneKind kind) {
    return std::find(input.kinds.begin(), input.kinds.end(), kind) != input.kinds.end();
  };
  JsonValue ways = JsonValue::array({referred("node-name")});
  if (takes(SceneKind::number))
    ways.push_back(ranged("number", input.lowest, input.highest));
  else if (takes(SceneKind::index))
    ways.push_back(ranged("integer", -1, scene_limits::most_indices - 1));
  if (takes(SceneKind::texture)) ways.push_back(list_of(ranged("number", 0, 65504), 1, 4));
  if (ways.size() == 1) return referred("node-name");
  return {{"oneOf", std::move(ways)}};
}

JsonValue schema_of(const SceneInput& input) {
  switch (input.form) {
  case SceneForm::node:
    return node_or_constant(input);
  case SceneForm::nodes:
    return list_of(referred("node-name"), 1, scene_limits::most_nodes);
  case SceneForm::whole:
    return ranged("integer", input.lowest, input.highest);
  case SceneForm::real:
    return ranged("number", input.lowest, input.highest);
  case SceneForm::flag:
    return {{"type", "boolean"}};
  case SceneForm::pair:
    return list_of(ranged("integer", input.lowest, input.highest), 2, 2);
  case SceneForm::range:
    return list_of(ranged("number", input.lowest, input.highest), 2, 2);
  case SceneForm::numbers:
    return list_of(ranged("number", input.lowest, input.highest), 1, scene_limits::most_listed);
  case SceneForm::wholes:
    return list_of(ranged("integer", input.lowest, input.highest), 1, scene_limits::most_listed);
  case SceneForm::lists:
    return list_of(list_of(ranged("number", input.lowest, input.highest), 1, scene_limits::most_listed), 1,
                   scene_limits::most_listed);
  case SceneForm::choice: {
    JsonValue words = JsonValue::array();
    for (const std::string_view word : input.choices) words.push_back(word);
    return {{"enum", std::move(words)}};
  }
  case SceneForm::text:
    return {{"type", "string"}, {"maxLength", 256}};
  case SceneForm::file:
    return referred("path");
  case SceneForm::files:
    return list_of(referred("path"), 1, scene_limits::most_listed);
  case SceneForm::map:
    return {{"oneOf", JsonValue::array(
                          {referred("path"), rows(ranged("integer", -1, scene_limits::most_indices - 1))})}};
  case SceneForm::levels:
    return {{"oneOf", JsonValue::array({referred("path"), rows(ranged("number", -1e9, 1e9))})}};
  case SceneForm::sprites:
    return list_of(referred("sprite"), 0, scene_limits::most_listed);
  case SceneForm::outlines:
    return list_of(referred("outline"), 0, scene_limits::most_listed);
  }
  return {};
}

// What a node of one block has, for nodes that say they are of it.
JsonValue rule_of(const SceneBlock& block) {
  JsonValue required = JsonValue::array({"block"});
  JsonValue properties{{"block", {{"const", block.name}}}};
  for (const SceneInput& input : block.inputs) {
    if (input.is_required) required.push_back(input.name);
    JsonValue schema = schema_of(input);
    schema["description"] = input.what;
    properties[input.name] = std::move(schema);
  }
  return {{"if",
           {{"required", JsonValue::array({"block"})}, {"properties", {{"block", {{"const", block.name}}}}}}},
          {"then",
           {{"description", block.summary},
            {"additionalProperties", false},
            {"required", std::move(required)},
            {"properties", std::move(properties)}}}};
}

JsonValue node_schema() {
  JsonValue names = JsonValue::array();
  JsonValue rules = JsonValue::array();
  for (const SceneBlock& block : scene_blocks()) {
    names.push_back(block.name);
    rules.push_back(rule_of(block));
  }
  return {{"type", "object"},
          {"required", JsonValue::array({"block"})},
          {"properties", {{"block", {{"enum", std::move(names)}}}}},
          {"allOf", std::move(rules)}};
}

JsonValue definitions() {
  const JsonValue point =
      list_of(ranged("number", -scene_limits::most_cells, scene_limits::most_cells), 2, 2);
  return {{"node-name", {{"type", "string"}, {"minLength", 1}, {"maxLength", scene_limits::longest_name}}},
          {"path", {{"type", "string"}, {"minLength", 1}, {"maxLength", scene_limits::longest_path}}},
          {"outline",
           {{"type", "object"},
            {"additionalProperties", false},
            {"required", JsonValue::array({"material", "points"})},
            {"properties",
             {{"material", ranged("integer", 0, 15)},
              {"points", list_of(point, 3, scene_limits::most_listed)}}}}},
          {"map",
           {{"type", "object"},
            {"additionalProperties", false},
            {"required", JsonValue::array({"name", "role", "channels"})},
            {"properties",
             {{"name", referred("node-name")},
              {"role", {{"enum", JsonValue(names_of<Role>())}}},
              {"channels", ranged("integer", 1, 4)}}}}},
          {"sprite",
           {{"type", "object"},
            {"additionalProperties", false},
            {"properties",
             {{"at", point},
              {"path", list_of(point, 2, scene_limits::most_listed)},
              {"period", ranged("number", 1e-6, 1e9)},
              {"start", ranged("number", 0, 1)},
              {"pattern", ranged("integer", 0, scene_limits::most_indices - 1)},
              {"rotate", ranged("number", -1e6, 1e6)},
              {"scale", ranged("number", 1e-3, 1)},
              {"follows", {{"type", "boolean"}}}}}}},
          {"node", node_schema()}};
}

} // namespace

std::string scene_schema() {
  return filled_json_text(
      {{"$schema", "http://json-schema.org/draft-07/schema#"},
       {"title", "Scene of `tilepack compose`, version 1"},
       {"description", "A texture as a graph of blocks. Paths are meant from the folder of the scene."},
       {"type", "object"},
       {"additionalProperties", false},
       {"required", JsonValue::array({"format", "version", "size", "nodes", "output"})},
       {"properties",
        {{"format", {{"const", "tilepack-scene"}}},
         {"version", {{"const", 1}}},
         {"size", list_of(ranged("integer", 1, scene_limits::most_texels), 2, 2)},
         {"seed", ranged("integer", 0, 9007199254740992.0)},
         {"maps", list_of(referred("map"), 1, scene_limits::most_maps)},
         {"nodes", {{"type", "object"}, {"additionalProperties", referred("node")}}},
         {"output", referred("node-name")}}},
       {"definitions", definitions()}},
      240);
}

} // namespace tilepack
