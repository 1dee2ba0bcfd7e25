#include "tilepack/bake/text_file.h"
#include "tilepack/json/json_schema.h"
#include "tilepack/scene/scene_blocks.h"
#include "tilepack/scene/scene_file.h"
#include "tilepack/scene/scene_schema.h"

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <set>

using namespace tilepack;
using Catch::Matchers::Contains;

namespace {

std::string scene_with(const std::string& nodes, const std::string& output = "look") {
  return fmt::format(R"({{"format": "tilepack-scene", "version": 1, "size": [1024, 512],
"nodes": {{
{}}},
"output": "{}"}})",
                     nodes, output);
}

const std::string cells = R"("cells": {"block": "tile-map", "cells": [16, 8]})";
const std::string which = R"("which": {"block": "virtual-indirection-map", "grid": "cells", "count": 2})";
const std::string look =
    R"("look": {"block": "reference-texture", "patterns": ["a.png", "b.png"], "pattern": "which", "place": "cells"})";
const std::string good_scene = scene_with(cells + ",\n" + which + ",\n" + look);

// The one problem of a scene whose nodes are these, as an error says it.
std::string refused(const std::string& nodes, const std::string& output = "look") {
  const SceneReading reading = scene_reading(scene_with(nodes, output), "art/s.json");
  CAPTURE(nodes);
  std::string all;
  int errors = 0;
  for (const SceneProblem& problem : reading.problems) {
    if (problem.fault == SceneFault::unused) continue;
    ++errors;
    all += error_of(problem, "art/s.json").what();
  }
  CHECK(errors == 1);
  try {
    parsed_scene(scene_with(nodes, output), "art/s.json");
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::invalid_content);
    CHECK(std::string(error.what()) == all);
  }
  return all;
}

} // namespace

TEST_CASE("nodes come before those that use them, with what their inputs hold") {
  const SceneFile scene = parsed_scene(good_scene, "art/s.json");
  CHECK(scene.size == std::array<std::int64_t, 2>{1024, 512});
  CHECK(scene.seed == 1);
  REQUIRE(scene.nodes.size() == 3);
  std::set<std::string> seen;
  for (const SceneNode& node : scene.nodes) {
    for (const auto& [name, value] : node.inputs)
      if (value.node >= 0) CHECK(seen.contains(scene.nodes[static_cast<std::size_t>(value.node)].name));
    seen.insert(node.name);
  }
  const SceneNode& shown = scene.nodes[static_cast<std::size_t>(scene.output)];
  CHECK(shown.name == "look");
  CHECK(shown.gives == SceneKind::texture);
  CHECK(shown.find("patterns")->texts == std::vector<std::string>{"a.png", "b.png"});
  CHECK(scene.nodes[static_cast<std::size_t>(shown.node_at("pattern"))].name == "which");
  CHECK(shown.number("seamless") == 1);
  CHECK(scene.nodes[static_cast<std::size_t>(shown.node_at("pattern"))].word("hash") == "mix");
  CHECK(scene.resolved("a.png") == "art/a.png");
  CHECK(scene.place(shown, "pattern") == "art/s.json:5: nodes.look.pattern");
}

TEST_CASE("what is wrong with a scene is said with file, line, node and input") {
  CHECK_THAT(
      refused(cells + "," + which + R"(, "look": {"block": "reference-texture", "patterns": ["a.png"]})"),
      Contains("art/s.json:3: nodes.look: the input \"place\" is missing"));
  CHECK_THAT(refused(cells + ",\n" +
                     R"("look": {"block": "reference-textures", "patterns": ["a.png"], "place": "cells"})"),
             Contains("art/s.json:4: nodes.look.block: \"reference-textures\" is no block; did you mean "
                      "\"reference-texture\"?"));
  CHECK_THAT(
      refused(cells + R"(, "look": {"block": "reference-texture", "patterns": ["a.png"], "place": "cell"})"),
      Contains("nodes.look.place: \"cell\" is no node of the scene; did you mean \"cells\"?"));
  CHECK_THAT(refused(cells + "," + which +
                     R"(, "look": {"block": "reference-texture", "patterns": ["a.png"], "place": "which"})"),
             Contains("nodes.look.place: takes a grid or a place, and \"which\" (virtual-indirection-map) "
                      "gives an index"));
  CHECK_THAT(
      refused(cells + R"(, "look": {"block": "reference-texture", "patterns": "a.png", "place": "cells"})"),
      Contains("nodes.look.patterns: must be an array, and is \"a.png\""));
  CHECK_THAT(
      refused(
          cells +
          R"(, "look": {"block": "reference-texture", "patterns": ["a.png"], "pattern": 1.5, "place": "cells"})"),
      Contains("nodes.look.pattern: must be the name of a node or a whole number, and is 1.5"));
  CHECK_THAT(
      refused(
          cells +
          R"(, "look": {"block": "reference-texture", "patterns": ["a.png"], "place": "cells", "seemless": true})"),
      Contains("nodes.look.seemless: unknown field; did you mean \"seamless\"?"));
  CHECK_THAT(
      refused(
          R"("cells": {"block": "tile-map", "cells": [16, 4294967296]}, "look": {"block": "pack", "file": "a.pack"})"),
      Contains("nodes.cells.cells[1]: 4294967296 is out of range; it must be 1 to 2147483648"));
  CHECK_THAT(refused(cells, "cells"),
             Contains("output: takes a texture, and \"cells\" (tile-map) gives a grid"));
  CHECK_THAT(
      refused(R"("l.k": {"block": "pack", "file": "a.pack"}, "look": {"block": "pack", "file": "a.pack"})"),
      Contains("a node's name is 1 to 64 letters, digits, - and _"));
  CHECK_THAT(scene_reading(scene_with(""), "s.json").problems.at(0).what, Contains("holds no node"));
}

TEST_CASE("a node made from itself is told with the way round") {
  CHECK_THAT(
      refused(R"("a": {"block": "layers", "textures": ["b"]}, "b": {"block": "layers", "textures": ["c"]},
                        "c": {"block": "layers", "textures": ["a"]}, "look": {"block": "layers", "textures": ["a"]})"),
      Contains("nodes.a: is made from itself: \"a\" from \"b\" from \"c\" from \"a\""));
  CHECK_THAT(refused(R"("look": {"block": "layers", "textures": ["look"]})"),
             Contains("nodes.look: is made from itself: \"look\" from \"look\""));
}

TEST_CASE("constants stand where nodes may, of the kind that the input takes") {
  const SceneFile scene = parsed_scene(
      scene_with(cells +
                 R"(, "look": {"block": "border-tiles", "grid": "cells", "material": 1, "patterns": ["a.png"],
        "inside": [0.5, 0.25, 1, 1], "below": [0.5]})"),
      "s.json");
  const SceneNode& look = scene.nodes[static_cast<std::size_t>(scene.output)];
  CHECK(look.node_at("material") == -1);
  CHECK(look.number("material") == 1);
  CHECK(look.find("inside")->numbers == std::vector<double>{0.5, 0.25, 1, 1});
  CHECK(look.number("variants") == 1);
  CHECK_THAT(
      refused(cells +
              R"(, "look": {"block": "border-tiles", "grid": "cells", "material": 1, "patterns": ["a.png"],
        "inside": [0.5, 0.25, 1, 1, 1], "below": [0.5]})"),
      Contains("nodes.look.inside: has 5 entries; it must have 1 to 4"));
  CHECK_THAT(refused(cells + R"(, "t": {"block": "tile-transform", "grid": "cells", "scale": 0},
        "look": {"block": "reference-texture", "patterns": ["a.png"], "place": "t"})"),
             Contains("nodes.t.scale: 0 is out of range; it must be 0.001 to 1024"));
}

TEST_CASE("a scene has the maps it names, and color with alpha where it names none") {
  const std::string nodes = R"("look": {"block": "pack", "file": "a.pack"})";
  CHECK(parsed_scene(scene_with(nodes), "s.json").maps.size() == 1);
  const auto maps_of = [&](const std::string& maps) {
    std::string text = scene_with(nodes);
    text.insert(1, R"("maps": )" + maps + ", ");
    return scene_reading(text, "s.json");
  };
  const SceneReading good = maps_of(
      R"([{"name": "color", "role": "color", "channels": 3}, {"name": "height", "role": "height", "channels": 1}])");
  CHECK(good.problems.empty());
  CHECK(good.scene.maps.at(1).role == Role::height);
  CHECK_THAT(maps_of(R"([{"name": "n", "role": "normal", "channels": 2}])").problems.at(0).what,
             Contains("normals have 3 channels"));
  CHECK_THAT(
      maps_of(
          R"([{"name": "n", "role": "data", "channels": 2}, {"name": "n", "role": "data", "channels": 2}])")
          .problems.at(0)
          .what,
      Contains("\"n\" stands twice"));
}

TEST_CASE("all that is wrong is listed in one go, and nodes that nothing is made from are named") {
  const SceneReading reading = scene_reading(
      R"({"format": "tilepack-scene", "version": 2, "size": [0, 4], "nodes": {"a": {"block": "x"}, "b": 3,
          "c": {"block": "pack", "file": "a.pack"}, "d": {"block": "pack"}}, "output": "c"})",
      "s.json");
  std::vector<std::string> places;
  for (const SceneProblem& problem : reading.problems)
    if (problem.fault != SceneFault::unused) places.push_back(problem.place);
  CHECK(places == std::vector<std::string>{"version", "size[0]", "nodes.a.block", "nodes.b", "nodes.d"});
  const auto unused = [](const SceneReading& read) {
    return std::count_if(read.problems.begin(), read.problems.end(),
                         [](const SceneProblem& p) { return p.fault == SceneFault::unused; });
  };
  CHECK(unused(reading) == 0); // what a node that can't be read was to be made from is not known
  CHECK(unused(scene_reading(R"({"format": "tilepack-scene", "version": 1, "size": [4, 4], "nodes": {
          "a": {"block": "pack", "file": "a.pack"}, "b": {"block": "pack", "file": "b.pack"},
          "c": {"block": "pack", "file": "c.pack"}}, "output": "c"})",
                             "s.json")) == 2);
  CHECK(scene_reading("{", "s.json").problems.front().fault == SceneFault::not_json);
  CHECK(scene_reading("[]", "s.json").problems.front().fault == SceneFault::field);
}

TEST_CASE("the schema that is shipped is that of the blocks, and takes what the reader takes") {
  const std::string shipped =
      read_text_file(TILEPACK_SOURCE_DIR "/lib/tilepack/scene/scene.schema.json", "the schema");
  if (shipped != scene_schema()) write_text_file("/tmp/tilepack.scene.schema.json", scene_schema());
  INFO("the schema as it would be lies at /tmp/tilepack.scene.schema.json");
  CHECK(shipped == scene_schema());
  CHECK(schema_problems(good_scene, scene_schema()).empty());
  for (const std::string& nodes :
       {cells + R"(, "look": {"block": "reference-texture", "patterns": "a.png", "place": "cells"})",
        cells + R"(, "look": {"block": "reference-texture", "patterns": ["a.png"]})",
        std::string(R"("look": {"block": "x"})"),
        cells + R"(, "look": {"block": "pack", "file": "a.pack", "more": 1})"}) {
    CHECK(schema_problems(scene_with(nodes), scene_schema()).size() == 1);
  }
}

TEST_CASE("the page on scenes tells of every block and every input") {
  const std::string page = read_text_file(TILEPACK_SOURCE_DIR "/lib/tilepack/scene/SCENES.md", "the page");
  for (const SceneBlock& block : scene_blocks()) {
    CHECK_THAT(page, Contains(fmt::format("`{}`", block.name)));
    for (const SceneInput& input : block.inputs) CHECK_THAT(page, Contains(fmt::format("`{}`", input.name)));
  }
}
