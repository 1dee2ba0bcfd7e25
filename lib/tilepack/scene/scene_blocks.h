#pragma once

#include "tilepack/numeric/enum_names.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tilepack {

/// What a node of a scene gives to the nodes that use it.
enum class SceneKind {
  grid,  ///< cells laid over the whole texture, and where in its cell a place lies
  place, ///< where in the pattern of a cell a place lies, if in it at all: a pattern moved, turned and scaled
  index, ///< a whole number: of a pattern, a material, a frame; -1: none
  number,  ///< a real number
  texture, ///< what is shown: a value for each map of the scene
};

template <>
inline constexpr auto enum_names<SceneKind> =
    std::array{EnumName{SceneKind::grid, "grid"}, EnumName{SceneKind::place, "place"},
               EnumName{SceneKind::index, "index"}, EnumName{SceneKind::number, "number"},
               EnumName{SceneKind::texture, "texture"}};

/// How an input is written in the file.
enum class SceneForm {
  node,     ///< the name of a node; of indices, numbers and textures also a constant
  nodes,    ///< a list of names
  whole,    ///< a whole number
  real,     ///< a number
  flag,     ///< true or false
  pair,     ///< two whole numbers, x and y
  range,    ///< two numbers, the lowest and the highest
  numbers,  ///< a list of numbers
  wholes,   ///< a list of whole numbers
  lists,    ///< a list of lists of numbers
  choice,   ///< one of some words
  text,     ///< any other word
  file,     ///< a path, from the folder of the scene
  files,    ///< a list of them
  map,      ///< whole numbers in rows: [[0, 1], [1, 0]], or the path of a picture that has them
  levels,   ///< numbers in rows, or the path of a picture whose values 0 to 1 they are
  sprites,  ///< a list of SceneSprite
  outlines, ///< a list of SceneOutline
};

/// One input of a block.
struct SceneInput {
  std::string_view name;
  SceneForm form = SceneForm::node;
  std::vector<SceneKind> kinds = {}; ///< of `node` and `nodes`: what may be given
  bool is_required = true;
  double lowest = 0, highest = 0;             ///< of numbers
  double fallback = 0;                        ///< of numbers that aren't required
  std::vector<std::string_view> choices = {}; ///< of `choice`; the first is the fallback
  std::string_view what = {};                 ///< one clause, with its unit
};

/// A kind of node: a block of [LN03, section 3], or one of ours.
struct SceneBlock {
  std::string_view name;
  SceneKind gives = SceneKind::texture;
  std::string_view summary; ///< one clause
  std::vector<SceneInput> inputs;

  const SceneInput* find(std::string_view input) const; ///< null if there is none
};

/// All of them: the one table from which the reader, the schema and the documentation are made.
std::span<const SceneBlock> scene_blocks();

const SceneBlock* scene_block_called(std::string_view name); ///< null if there is none
std::vector<std::string> scene_block_names();

} // namespace tilepack
