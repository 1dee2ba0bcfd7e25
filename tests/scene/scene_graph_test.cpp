#include "support/images.h"
#include "support/small_pack.h"
#include "support/scratch_folder.h"

#include "tilepack/image/image_file.h"
#include "tilepack/pack/pack_write.h"
#include "tilepack/pattern/pattern_texture.h"
#include "tilepack/scene/scene_graph.h"
#include "tilepack/scene/scene_render.h"
#include "tilepack/scene/scene_report.h"
#include "tilepack/scene/scene_texture.h"

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <catch2/catch.hpp>
#include <map>

using namespace tilepack;
using namespace tilepack::test;
using Catch::Matchers::Contains;

namespace {

constexpr RenderTarget bytes_target{Encoding::srgb, Depth::u8};

// A folder with pictures, maps and a pack for scenes to name.
struct SceneFolder {
  ScratchFolder folder;

  SceneFolder() {
    for (int i = 0; i < 4; ++i)
      picture(fmt::format("p{}.png", i), noise(16, 16, 3, 10 + static_cast<std::uint64_t>(i)));
    picture("wide.png", noise(32, 16, 3, 1));
    picture("clear.png", noise(16, 16, 4, 3));
    Image areas(4, 4, 1);
    for (int y = 0; y < 4; ++y)
      for (int x = 0; x < 4; ++x) areas.texel(x, y)[0] = static_cast<float>(x < 2 ? 0 : 1) / 255;
    picture("areas.png", areas);
    write_pack(small_pack(), folder / "a.pack");
  }
  void picture(const std::string& name, const Image& image) const {
    write_image(folder / name, image, Depth::u8, image.channels() == 1 ? Encoding::linear : Encoding::srgb);
  }
  SceneFile scene(const std::string& nodes, std::int64_t side = 1024,
                  const std::string& output = "look") const {
    return parsed_scene(
        fmt::format(
            "{{\"format\": \"tilepack-scene\", \"version\": 1, \"size\": [{0}, {0}],\n\"nodes\": {{\n{1}}},\n"
            "\"output\": \"{2}\"}}",
            side, nodes, output),
        (folder / "s.json").string());
  }
  // What is wrong with it, as compose says; the same as validate lists.
  std::string refused(const std::string& nodes, std::int64_t side = 1024) const {
    const SceneFile read = scene(nodes, side);
    SceneFiles files(read);
    const auto problems = scene_graph_problems(read, files);
    CHECK(problems.size() == 1);
    try {
      scene_graph(read, files);
    } catch (const Error& error) {
      if (!problems.empty()) CHECK(std::string(error.what()) == error_of(problems.front(), read.file).what());
      const std::string message = error.what();
      CHECK_THAT(message, Contains("s.json:"));
      return message.substr(message.find("s.json:"));
    }
    return "";
  }
};

Image window(const SceneFile& scene, SceneFiles& files, const SceneView& view, int band = 1 << 20) {
  const SceneGraph made = scene_graph(scene, files);
  const PatternTexture texture(made.graph, 0);
  const SceneWindow drawn(texture, made.graph, scene.size, view, bytes_target);
  Image whole(drawn.size().width, drawn.size().height, drawn.channels());
  for (int y = 0; y < drawn.size().height; y += band) {
    const Image rows = drawn.rows(y, std::min(band, drawn.size().height - y));
    for (int r = 0; r < rows.height(); ++r)
      std::copy(rows.row(r).begin(), rows.row(r).end(), whole.row(y + r).begin());
  }
  return whole;
}

std::map<std::string, int> openings(const SceneFiles& files) {
  std::map<std::string, int> found;
  for (const SceneFileUse& use : files.uses()) found[use.file] = use.openings;
  return found;
}

const std::string cells = R"("cells": {"block": "tile-map", "cells": [64, 64]}, )";
const std::string tiles = R"("patterns": ["p0.png", "p1.png", "p2.png", "p3.png"])";
const std::string two = R"("a": {"block": "reference-texture", "patterns": ["p0.png"], "place": "cells"},
  "b": {"block": "reference-texture", "patterns": ["p1.png"], "place": "cells"}, )";

} // namespace

TEST_CASE("a scene's window shows the texels of its patterns, wherever it lies and however it is cut") {
  const SceneFolder folder;
  const SceneFile scene =
      folder.scene(cells + R"("which": {"block": "virtual-indirection-map", "grid": "cells", "count": 4},
    "look": {"block": "reference-texture", )" +
                   tiles + R"(, "pattern": "which", "place": "cells"})");
  SceneFiles files(scene);
  const SceneGraph made = scene_graph(scene, files);
  const SceneView view{{-40, 1000, 100, 70}, 0, 1};
  const Image drawn = window(scene, files, view);
  std::vector<Image> patterns;
  for (int i = 0; i < 4; ++i) patterns.push_back(read_image(folder.folder / fmt::format("p{}.png", i)).image);
  int wrong = 0;
  for (int y = 0; y < drawn.height(); ++y)
    for (int x = 0; x < drawn.width(); ++x) {
      const std::int64_t u = (-40 + x + 1024) % 1024, v = (1000 + y) % 1024;
      const auto pattern =
          index_at(made.graph,
                   made.node_of[static_cast<std::size_t>(
                       scene.nodes[static_cast<std::size_t>(scene.output)].node_at("pattern"))],
                   {{u / 16, 0.5}, {v / 16, 0.5}});
      const auto texel = patterns[static_cast<std::size_t>(pattern)].texel(static_cast<int>(u % 16),
                                                                           static_cast<int>(v % 16));
      for (std::size_t c = 0; c < 3; ++c)
        wrong += std::abs(drawn.texel(x, y)[c] - texel[c]) > 0.5f / 255 ? 1 : 0;
      wrong += drawn.texel(x, y)[3] == 1 ? 0 : 1;
    }
  CHECK(wrong == 0);
  for (const int band : {1, 7, 64}) CHECK(window(scene, files, view, band).data() == drawn.data());
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  CHECK(window(scene, files, view).data() == drawn.data());
  CHECK(window(scene, files, {{-40 - 1024, 1000 + (std::int64_t{1} << 40), 100, 70}, 0, 1}).data() ==
        drawn.data());
}

TEST_CASE("only what pixels need is opened") {
  const SceneFolder folder;
  const std::string nodes = cells + R"("land": {"block": "areas-map", "map": "areas.png"},
    "look": {"block": "select", "index": "land", "textures": ["a", "b"]},
    "a": {"block": "reference-texture", "patterns": ["p0.png"], "place": "cells"},
    "b": {"block": "pack", "file": "a.pack", "scale": 1}, "c": {"block": "pack", "file": "none.pack"})";
  const SceneFile scene = folder.scene(nodes);
  SceneFiles files(scene);
  const SceneGraph made =
      scene_graph(scene, files); // "c" is no part of the output: its missing file is no matter
  CHECK(openings(files) == std::map<std::string, int>{{"a.pack", 0}, {"areas.png", 0}, {"p0.png", 0}});
  const PatternTexture texture(made.graph, 0);
  // Trilinear filtering reaches half a texel beyond the window: the west half has numbers 0.
  const auto rows = [&](const SceneView& view) {
    SceneWindow(texture, made.graph, scene.size, view, bytes_target).rows(0, 8);
  };
  rows({{8, 0, 64, 8}, 0, 1});
  CHECK(openings(files) == std::map<std::string, int>{{"a.pack", 0}, {"areas.png", 1}, {"p0.png", 1}});
  rows({{300, 500, 64, 8}, 0, 1});
  CHECK(openings(files) == std::map<std::string, int>{{"a.pack", 0}, {"areas.png", 1}, {"p0.png", 1}});
  // The east half at level 1: the pack from level 1 on, which is less than all of it.
  rows({{300, 100, 64, 8}, 1, 1});
  CHECK(openings(files) == std::map<std::string, int>{{"a.pack", 1}, {"areas.png", 1}, {"p0.png", 1}});
  std::size_t coarse = 0, whole = 0;
  for (const SceneFileUse& use : files.uses())
    if (use.file == "a.pack") coarse = use.bytes;
  rows({{600, 100, 64, 8}, 0, 1});
  rows({{700, 200, 64, 8}, 0, 1});
  CHECK(openings(files)["a.pack"] == 2);
  for (const SceneFileUse& use : files.uses())
    if (use.file == "a.pack") whole = use.bytes;
  CHECK(coarse > 0);
  CHECK(whole > 2 * coarse);
  const auto told = scene_report_nodes(scene, made, texture.used_nodes());
  for (const auto& node : told) CHECK(node.is_used == (node.name != "c"));
}

TEST_CASE("what a scene asks of files and sizes and can't have is said with node and input") {
  const SceneFolder folder;
  const auto look = [](const std::string& more) {
    return R"("look": {"block": "reference-texture", "place": "cells", )" + more + "}";
  };
  CHECK_THAT(folder.refused(cells + look(R"("patterns": ["p0.png", "none.png"])")),
             Contains("nodes.look.patterns: ") && Contains("none.png: cannot be opened"));
  CHECK_THAT(folder.refused(cells + look(R"("patterns": ["s.pack"])")),
             Contains("s.json:3: nodes.look.patterns: "));
  CHECK_THAT(folder.refused(cells + look(R"("patterns": ["a.pack"])")),
             Contains("nodes.look.patterns: ") && Contains("a.pack"));
  CHECK_THAT(folder.refused(cells + look(R"("pack": "p0.png")")),
             Contains("nodes.look.pack: ") && Contains("p0.png: is no pack"));
  CHECK_THAT(folder.refused(cells + look("\"seamless\": true")),
             Contains("nodes.look: needs either \"patterns\", a list of pictures, or \"pack\""));
  CHECK_THAT(folder.refused(R"("cells": {"block": "tile-map", "cells": [64, 60]}, )" + look(tiles)),
             Contains("nodes.cells.cells: 60 rows don't divide the 1024 texels of the scene"));
  CHECK_THAT(folder.refused(R"("look": {"block": "pack", "file": "a.pack", "scale": 0.3})"),
             Contains("nodes.look.file: tiles of") && Contains("a whole number of times"));
  CHECK_THAT(
      folder.refused(cells +
                     R"("p": {"block": "probability-map", "grid": "cells", "probabilities": [0.5, 0.4]}, )" +
                     look(tiles + R"(, "pattern": "p")")),
      Contains("nodes.p.probabilities: the 2 probabilities sum to 0.9; they must sum to 1"));
  CHECK_THAT(
      folder.refused(
          cells +
          R"("m": {"block": "materials-map", "grid": "cells", "material": 0, "materials": [[1], [0.2, 0.2]]}, )" +
          look(tiles + R"(, "pattern": "m")")),
      Contains("nodes.m.materials[1]: the 2 probabilities sum to 0.4"));
  CHECK_THAT(folder.refused(
                 cells + R"("which": {"block": "virtual-indirection-map", "grid": "cells", "count": 5}, )" +
                 look(tiles + R"(, "pattern": "which")")),
             Contains("nodes.look.pattern: gives numbers up to 4, and there are 4 patterns, counted from 0"));
  CHECK_THAT(folder.refused(cells +
                            R"("map": {"block": "indirection-map", "grid": "cells", "map": "p0.png"}, )" +
                            look(tiles + R"(, "pattern": "map")")),
             Contains("nodes.map.map: ") && Contains("p0.png: has 3 channels; a map of numbers has one"));
  CHECK_THAT(folder.refused(cells +
                            R"("map": {"block": "indirection-map", "grid": "cells", "map": "areas.png"}, )" +
                            look(tiles + R"(, "pattern": "map")")),
             Contains("nodes.map.map: has 4 x 4 numbers, and the grid 64 x 64 cells"));
  CHECK_THAT(
      folder.refused(
          R"("cells": {"block": "tile-map", "cells": [1048576, 1048576]}, "map": {"block": "indirection-map", "grid": "cells", "map": "areas.png"}, )" +
              look(tiles + R"(, "pattern": "map")"),
          std::int64_t{1} << 24),
      Contains("nodes.map.grid: 1048576 x 1048576 cells would be stored, and 2^28 are the most"));
  CHECK_THAT(folder.refused(cells + R"("d": {"block": "dithered-areas-map", "areas": "f", "grid": "cells"},
    "f": {"block": "floor", "number": "t", "count": 2}, "t": {"block": "time"}, )" +
                            look(tiles + R"(, "pattern": "d")")),
             Contains("nodes.d.areas: is not constant in cells"));
  CHECK_THAT(folder.refused(cells + R"("land": {"block": "areas-map", "map": [[0, 2]]}, )" + two +
                            R"("look": {"block": "select", "index": "land", "textures": ["a", "b"]})"),
             Contains("nodes.look.index: gives numbers up to 2, and there are 2 textures"));
  CHECK_THAT(
      folder.refused(
          cells +
          R"("s": {"block": "explicit-positioning", "grid": "cells", "sprites": [{"at": [1, 1], "pattern": 4}]},
    "look": {"block": "reference-texture", "place": "s", )" +
          tiles + "}"),
      Contains("nodes.look.place: has sprites of patterns up to 4"));
  CHECK_THAT(
      folder.refused(
          cells + two +
          R"("look": {"block": "transition-tiles", "grid": "cells", "material": 0, "textures": ["a", "b"], )" +
          tiles + "}"),
      Contains("nodes.look.patterns: are 4; 2 materials at 4 corners and 1 variants need 16"));
  CHECK_THAT(
      folder.refused(
          cells + two +
          R"("look": {"block": "transition-tiles", "grid": "cells", "material": 0, "textures": ["a", "b"], "pack": "a.pack"})"),
      Contains("nodes.look.pack: has edge colors"));
  // Found when the texels are read, by whichever thread: told as of the place all the same.
  const SceneFile mixed = folder.scene(cells + look(R"("patterns": ["p0.png", "wide.png"])"));
  SceneFiles files(mixed);
  CHECK_THROWS_WITH(window(mixed, files, {{0, 0, 64, 64}, 0, 1}),
                    Contains("s.json:3: nodes.look.patterns: ") &&
                        Contains("wide.png: has 32 x 16 texels, and the patterns before it 16 x 16"));
}

TEST_CASE("all that is wrong with files and sizes is listed in one go, and not what follows from it") {
  const SceneFolder folder;
  const SceneFile scene =
      folder.scene(cells + R"("p": {"block": "probability-map", "grid": "cells", "probabilities": [0.5, 0.4]},
    "a": {"block": "reference-texture", "patterns": ["none.png"], "pattern": "p", "place": "cells"},
    "b": {"block": "reference-texture", "patterns": ["gone.png"], "place": "cells"}, "look": {"block": "layers", "textures": ["a", "b"]})");
  SceneFiles files(scene);
  std::vector<std::string> places;
  for (const SceneProblem& problem : scene_graph_problems(scene, files)) places.push_back(problem.place);
  std::sort(places.begin(), places.end());
  CHECK(places == std::vector<std::string>{"nodes.b.patterns", "nodes.p.probabilities"});
}

TEST_CASE("sprites move with time, and numbers between scenes of one seed stay") {
  const SceneFolder folder;
  const std::string nodes = cells + R"("walk": {"block": "explicit-positioning", "grid": "cells", "sprites": [
    {"path": [[8, 8], [16, 8], [16, 16], [8, 16]], "period": 40, "scale": 0.5}]},
    "look": {"block": "reference-texture", "patterns": ["clear.png"], "place": "walk"})";
  const SceneFile scene = folder.scene(nodes);
  SceneFiles files(scene);
  const auto alpha_at = [&](double time, double x, double y) {
    const SceneGraph made = scene_graph(scene, files, time);
    const PatternTexture texture(made.graph, 0);
    std::array<double, 4> value{};
    texture.sample({static_cast<std::int64_t>(x), x - std::floor(x)},
                   {static_cast<std::int64_t>(y), y - std::floor(y)}, {0.001, 0, 0, 0.001}, value);
    return value[3];
  };
  CHECK(alpha_at(0, 8.05, 8.05) > 0);
  CHECK(alpha_at(0, 16.05, 8.05) == 0);
  CHECK(alpha_at(10, 16.05, 8.05) > 0);
  CHECK(alpha_at(10, 8.05, 8.05) == 0);
  CHECK(alpha_at(40, 8.05, 8.05) > 0);
}

TEST_CASE("memory and units do not grow with the size of the scene") {
  const SceneFolder folder;
  std::size_t least = 0, most = 0;
  for (int power = 10; power <= 30; power += 10) {
    const std::int64_t side = std::int64_t{16} << power;
    const SceneFile scene = folder.scene(fmt::format(R"("cells": {{"block": "tile-map", "cells": [{0}, {0}]}},
      "which": {{"block": "virtual-indirection-map", "grid": "cells", "count": 4}},
      "look": {{"block": "reference-texture", {1}, "pattern": "which", "place": "cells"}})",
                                                     std::int64_t{1} << power, tiles),
                                         side);
    SceneFiles files(scene);
    const SceneGraph made = scene_graph(scene, files);
    CHECK(made.graph.unit == Size{16, 16});
    const PatternTexture texture(made.graph, 0);
    const SceneWindow drawn(texture, made.graph, scene.size, {{side / 2, side / 3, 256, 64}, 0, 1},
                            bytes_target);
    drawn.rows(0, 64);
    std::size_t held = texture.bytes();
    for (const SceneFileUse& use : files.uses()) held += use.bytes;
    if (power == 10) least = held;
    most = std::max(most, held);
  }
  CHECK(most <= least + least / 10);
}

TEST_CASE("a view counts in tiles of 256 texels, whatever units the graph has") {
  struct Places final : Texture {
    int channels() const override { return 4; }
    void sample(TileCoordinate u, TileCoordinate v, const Footprint& footprint,
                std::span<double> out) const override {
      out[0] = static_cast<double>(u.tile) + u.fraction;
      out[1] = static_cast<double>(v.tile) + v.fraction;
      out[2] = footprint.u_across;
      out[3] = footprint.v_down;
    }
  };
  const Places places;
  const SceneTexture seen(places, {64, 512});
  std::array<double, 4> value{};
  seen.sample({3, 0.125}, {-3, 0.5}, {0.5, 0, 0, 0.5}, value);
  CHECK(value == std::array<double, 4>{12.5, -1.25, 2, 0.25});
}
