#pragma once

#include "tilepack/pattern/pattern_graph.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace tilepack {

/// A texture that a GraphProgram reads. Texels are linear light where the map's encoding is sRGB; where the map has alpha
/// its colors are multiplied by it.
struct GraphSampler {
  enum class Kind {
    patterns, ///< array, a layer a tile, clamped to its edge: PatternSource::stored_pack() of patterns
    tiles,    ///< the pack's texture: repeating, or of the layout `array` an array clamped to its edge
    corners,  ///< that of its corner pack, repeating
    ids,      ///< the index map: whole numbers of 16 bits
  };
  std::string name; ///< of the uniform
  Kind kind = Kind::patterns;
  std::shared_ptr<const PatternSource> source;
  int map = 0; ///< of the graph
  bool is_array = false;
};

/// The part of a GraphProgram that is for one map of the graph.
struct GraphMapText {
  std::string text;          ///< ends with `vec4 scene_MAP(Place p, vec4 d)`
  std::vector<int> needs;    ///< maps whose texts must stand before this one
  std::vector<int> samplers; ///< numbers in GraphProgram::samplers, those of `needs` not among them
};

/// Sprites in GraphProgram::words, for who moves them with time.
struct GraphSprites {
  NodeId node = no_node;    ///< a SpritesTexture
  std::size_t first = 0;    ///< the first word of the first sprite
  std::vector<int> numbers; ///< of its SpriteMap, in the order of the words
};
/// Cell x, y, pattern; bits of floats: x, y within the cell, scale, cosine, sine.
inline constexpr std::size_t words_of_sprite = 8;

/// A pattern graph as functions of GLSL ES 3.00, evaluated where they are asked:
///
///   struct Place { uvec2 cell; vec2 part; }   a unit of the scene and the fraction within it
///   vec4 scene_MAP(Place p, vec4 d)           the map MAP at a place: its values (of grey ones the same thrice) times how
///                                             much of it is covered, and that cover; d: derivatives, units a pixel,
///                                             (du/dx, dv/dx, du/dy, dv/dy)
///   Place place_at(uvec2 from, vec2 p)        p units from the unit `from`, round the scene
///
/// Indices and random numbers are those of PatternValues, cell by cell; numbers are floats, so that a place within a few
/// 2^-24 (of a unit, and of how far place_at() goes) of where an index changes may have the other one. Patterns and packs
/// are read as FastSampler does, by the texture units. No place is filtered beyond the tiles that lie there: who draws
/// pixels of several cells asks several times.
///
/// Uniforms, beside the samplers: `isampler2D tables`, of rows of 2048 words; `float now`, the time in steps; `int filter_mode`, 2 for nearest texels; `float aniso`, the anisotropy of samplers.
struct GraphProgram {
  std::string common;             ///< before all texts of maps
  std::vector<GraphMapText> maps; ///< by map of the graph
  std::vector<GraphSampler> samplers;
  std::vector<std::int32_t> words; ///< of `tables`
  std::vector<GraphSprites> sprites;
  PatternGrid finest{1, 1}; ///< the most cells of all grids with patterns and packs
  bool moves = false;       ///< some block depends on the time

  static constexpr int row_words = 2048;
};

/// Error (invalid_content), naming the node, for what is beyond a program: packs that no shader of a page can look up
/// (shader_text()), more than 2^24 words of maps and tables, more than 1024 sprites or 2048 patterns in a set, maps of 4
/// channels without alpha. Opens the stored maps that the output needs, and packs that a WangTexture shows.
GraphProgram graph_program(const PatternGraph& graph);

} // namespace tilepack
