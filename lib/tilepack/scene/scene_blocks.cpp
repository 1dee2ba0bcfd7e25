#include "tilepack/scene/scene_blocks.h"

#include "tilepack/scene/scene_limits.h"

#include <algorithm>

namespace tilepack {
namespace {

using enum SceneKind;
using enum SceneForm;

SceneInput from(std::string_view name, std::vector<SceneKind> kinds, std::string_view what) {
  return {.name = name, .form = node, .kinds = std::move(kinds), .what = what};
}

SceneInput optional(SceneInput input, double fallback = 0) {
  input.is_required = false;
  input.fallback = fallback;
  return input;
}

// A constant in the range given, or a node that gives a number or an index.
SceneInput amount(std::string_view name, double lowest, double highest, double fallback,
                  std::string_view what) {
  SceneInput input = optional(from(name, {number, index}, what), fallback);
  input.lowest = lowest;
  input.highest = highest;
  return input;
}

SceneInput whole_number(std::string_view name, double lowest, double highest, std::string_view what) {
  return {.name = name, .form = whole, .lowest = lowest, .highest = highest, .what = what};
}

SceneInput real_number(std::string_view name, double lowest, double highest, std::string_view what) {
  return {.name = name, .form = real, .lowest = lowest, .highest = highest, .what = what};
}

SceneInput word(std::string_view name, std::vector<std::string_view> choices, std::string_view what) {
  return {.name = name, .form = choice, .is_required = false, .choices = std::move(choices), .what = what};
}

SceneInput list(std::string_view name, SceneForm form, std::string_view what,
                std::vector<SceneKind> kinds = {}) {
  return {.name = name, .form = form, .kinds = std::move(kinds), .what = what};
}

constexpr double most = scene_limits::most_indices;

// Where random numbers come from: two inputs of every block that draws some.
SceneBlock drawing(SceneBlock block) {
  block.inputs.push_back(word("hash", {"mix", "chain"},
                              "mix: a hash without table and period; chain: permutations looked up in turn"));
  block.inputs.push_back(optional(whole_number(
      "seed", 0, 9007199254740992.0, "of its numbers; unset, each node draws others, by its name")));
  return block;
}

std::vector<SceneBlock> choice_blocks() {
  const SceneInput grid_of_cells = from("grid", {grid}, "the cells");
  const SceneInput probabilities{.name = "probabilities",
                                 .form = numbers,
                                 .lowest = 0,
                                 .highest = 1,
                                 .what = "of numbers 0, 1, 2 …, which sum to 1"};
  const SceneInput entries =
      optional(whole_number("entries", 1, most, "of the table, so steps of the probabilities"), 256);
  const SceneInput blank = optional(list("blank", flag, "the last probability is that of nothing: of -1"));
  return {
      {"tile-map",
       grid,
       "virtual tile map: a grid of equal cells over the whole texture",
       {{.name = "cells",
         .form = pair,
         .lowest = 1,
         .highest = scene_limits::most_cells,
         .what = "columns and rows"}}},
      {"indirection-map",
       index,
       "explicit indirection map: the number stored for each cell",
       {grid_of_cells, list("map", map, "a number a cell of the grid")}},
      drawing({"virtual-indirection-map",
               index,
               "a number computed for each cell, all equally often",
               {grid_of_cells, whole_number("count", 1, most, "numbers are 0 to count - 1")}}),
      drawing({"random-map",
               number,
               "virtual random map: a real number computed for each cell",
               {grid_of_cells, optional({.name = "range",
                                         .form = range,
                                         .lowest = -1e9,
                                         .highest = 1e9,
                                         .what = "of the numbers; unset: 0 to 1"})}}),
      {"tile-transform",
       place,
       "the pattern of a cell moved, turned and scaled",
       {grid_of_cells, amount("x", 0, 1, 0.5, "where its middle lies in the cell, west to east"),
        amount("y", 0, 1, 0.5, "the same, north to south"),
        amount("scale", 1e-3, scene_limits::largest_scale, 1, "side of the pattern in cells"),
        amount("rotate", -1e6, 1e6, 0, "turns, clockwise"),
        word("fit", {"shrink", "overflow"},
             "shrink: all of it stays in the cell; overflow: its middle does")}},
      {"explicit-positioning",
       place,
       "sprites anywhere, several in a cell",
       {grid_of_cells, list("sprites", sprites, "their places are in cells of the grid")}},
      {"reference-texture",
       texture,
       "a pattern of several in each cell",
       {optional(list("patterns", files, "pictures of one size; these or a pack")),
        optional(list("pack", file, "a pack whose tiles are the patterns")),
        optional(from("pattern", {index}, "which of them; sprites have their own")),
        from("place", {grid, place}, "in which cell, and where in the pattern"),
        optional(
            list("seamless", flag, "filters read on in the neighbours' patterns, which continue each other"),
            1)}},
      drawing({"probability-map",
               index,
               "a number a cell, drawn with probabilities of one's own",
               {grid_of_cells, probabilities, blank, entries}}),
      drawing({"materials-map",
               index,
               "the same, with the probabilities of the material at the cell",
               {grid_of_cells,
                from("material", {index}, "which of the lists"),
                {.name = "materials",
                 .form = lists,
                 .lowest = 0,
                 .highest = 1,
                 .what = "probabilities, a list a material"},
                blank,
                entries}}),
      {"areas-map",
       index,
       "the material of an area of many cells",
       {list("map", map, "a number an area; areas are as large as they divide the texture")}},
      drawing({"dithered-areas-map",
               index,
               "areas mixed with their neighbours cell by cell",
               {from("areas", {index}, "constant in the cells of a coarser grid"), grid_of_cells}}),
      {"select",
       texture,
       "materials: one of several textures, by a number",
       {from("index", {index}, "which of them"), list("textures", nodes, "one a number", {texture})}},
  };
}

std::vector<SceneBlock> transition_blocks() {
  const SceneInput grid_of_cells = from("grid", {grid}, "the cells");
  const SceneInput patterns = optional(list("patterns", files, "a picture a combination; these or a pack"));
  const SceneInput pack = optional(list("pack", file, "a pack whose corner colors are the materials"));
  return {
      {"pixel-map",
       index,
       "the material of a place, sharp; stored along the boundary alone",
       {optional(list("map", map, "a number a pixel of the map; this or outlines")),
        optional({.name = "pixels",
                  .form = pair,
                  .lowest = 1,
                  .highest = 16777216,
                  .what = "size of a map of outlines"}),
        optional(list("outlines", outlines, "polygons, later ones over earlier ones")),
        optional(whole_number("ground", 0, 15, "the material where no outline is"))}},
      {"transition-tiles",
       texture,
       "tiles that lead from material to material, where neighbours differ",
       {grid_of_cells, from("material", {index}, "at the corners of the cells"),
        optional(list("textures", nodes,
                      "one a material, where all corners are of it; unset: tiles of the pack", {texture})),
        patterns, pack,
        optional(whole_number("variants", 1, 64, "tiles a combination; those of the pack, else 1"), 1)}},
      {"border-tiles",
       texture,
       "the border of one material on clear ground, over whatever lies below",
       {grid_of_cells, from("material", {index}, "at the corners of the cells"),
        optional(whole_number("family", 0, 15, "the material that has the border"), 1), patterns, pack,
        optional(whole_number("variants", 1, 64, "tiles a combination; those of the pack, else 1"), 1),
        from("inside", {texture}, "within the border"), from("below", {texture}, "beyond it")}},
      {"height-blend",
       texture,
       "materials joined by which of them stands out",
       {from("areas", {index}, "constant in the cells of a coarse grid"),
        list("textures", nodes, "one a material", {texture}),
        optional(list("height", text, "the map of the scene that has heights; unset: all are equally high")),
        optional(real_number("width", 0, 1e6, "of the blend, in texels"), 16),
        optional(real_number("relief", 0, 1, "how far heights bend the border, of the distance of areas"),
                 0.5)}},
  };
}

std::vector<SceneBlock> animation_blocks() {
  const SceneInput grid_of_cells = from("grid", {grid}, "the cells");
  return {
      {"animation-map",
       index,
       "the frame of a sequence that a cell shows now",
       {grid_of_cells, whole_number("frames", 1, most, "pictures of the sequence; 0 is that at rest"),
        amount("phase", -1e9, 1e9, 0, "steps"),
        amount("rest", 0, 1e9, 0, "Z: steps at rest before the sequence, times density"),
        amount("density", 0, 1e9, 1, "a: rest is multiplied by it"),
        amount("rest-before", 0, 1e9, 0, "Z before the change; unset: as rest"),
        amount("density-before", 0, 1e9, 1, "a before the change; unset: as density"),
        optional(whole_number("changed-at", -1e12, 1e12,
                              "the step at which rest and density change, without a jump"))}},
      {"animation-sequence",
       index,
       "a time line, or any table: the number that stands at a number",
       {from("index", {index}, "taken modulo the length of the list"),
        {.name = "timeline",
         .form = wholes,
         .lowest = -1,
         .highest = most - 1,
         .what = "a number an entry; -1: none"}}},
      {"floor",
       index,
       "a number as an index",
       {from("number", {number}, "rounded down"),
        whole_number("count", 1, most, "indices are 0 to count - 1"),
        optional(list("wrap", flag, "numbers beyond begin again, and are not held at the end"))}},
      {"time", number, "the time, in steps", {}},
      {"distance",
       number,
       "how far a place is from a point, in texels",
       {amount("x", -1e12, 1e12, 0, "texels from the west"),
        amount("y", -1e12, 1e12, 0, "texels from the north")}},
      {"number-map",
       number,
       "explicit map of numbers",
       {list("map", levels, "a number an area"),
        optional(list("smooth", flag, "interpolated between areas' middles")),
        optional(real_number("scale", -1e9, 1e9, "values are multiplied by it"), 1),
        optional(real_number("offset", -1e9, 1e9, "and then added to it"))}},
      {"arithmetic",
       number,
       "two numbers made one",
       {word("operation", {"add", "subtract", "multiply", "divide", "minimum", "maximum", "modulo", "sine"},
             "sine: of a turns, times b"),
        amount("a", -1e12, 1e12, 0, "the first"), amount("b", -1e12, 1e12, 1, "the second")}},
  };
}

std::vector<SceneBlock> texture_blocks() {
  return {
      {"color",
       texture,
       "the same everywhere",
       {{.name = "value",
         .form = numbers,
         .lowest = 0,
         .highest = 65504,
         .what = "of the first map, linear, one a channel"}}},
      {"pack",
       texture,
       "a tile pack, laid without seams by its own hash",
       {list("file", file, "the pack"),
        optional(real_number("scale", 1e-6, 1e6, "texels of the scene a texel of the pack"), 1)}},
      {"layers",
       texture,
       "textures over each other, by their alpha",
       {list("textures", nodes, "the lowest first", {texture})}},
      {"moved",
       texture,
       "a texture that is moved",
       {from("texture", {texture}, "what is moved"), amount("x", -1e12, 1e12, 0, "texels to the east"),
        amount("y", -1e12, 1e12, 0, "texels to the south")}},
  };
}

std::vector<SceneBlock> all_blocks() {
  std::vector<SceneBlock> blocks = choice_blocks();
  for (auto some : {transition_blocks(), animation_blocks(), texture_blocks()})
    blocks.insert(blocks.end(), some.begin(), some.end());
  return blocks;
}

} // namespace

const SceneInput* SceneBlock::find(std::string_view input) const {
  const auto found =
      std::find_if(inputs.begin(), inputs.end(), [&](const SceneInput& one) { return one.name == input; });
  return found == inputs.end() ? nullptr : &*found;
}

std::span<const SceneBlock> scene_blocks() {
  static const std::vector<SceneBlock> blocks = all_blocks();
  return blocks;
}

const SceneBlock* scene_block_called(std::string_view name) {
  const auto blocks = scene_blocks();
  const auto found =
      std::find_if(blocks.begin(), blocks.end(), [&](const SceneBlock& block) { return block.name == name; });
  return found == blocks.end() ? nullptr : &*found;
}

std::vector<std::string> scene_block_names() {
  std::vector<std::string> names;
  for (const SceneBlock& block : scene_blocks()) names.emplace_back(block.name);
  return names;
}

} // namespace tilepack
