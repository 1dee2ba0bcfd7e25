#pragma once

#include "tilepack/bake/material_files.h"
#include "tilepack/image/image_file.h"
#include "tilepack/tileset/tile_set.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tilepack {

/// Reads the colors of tiles drawn by hand: a JSON list with one entry a tile, in the order in which the
/// tiles are given, either all of edges or all of corners:
///
///   [ {"north": 0, "east": 1, "south": 0, "west": 0}, … ]      edges: 0 to 7, horizontal and vertical apart
///   [ {"nw": 0, "ne": 1, "sw": 0, "se": 0}, … ]                corners: 0 to 3
///
/// Throws Error (invalid_content) naming the place, the value and the range. `file` is how messages name it.
TileColors parsed_color_list(std::string_view text, const std::string& file);

/// One drawing and the file it came from.
struct HandDrawnTile {
  std::string file;
  ImageFile image;
};

/// Brings drawings of normals into the form that is averaged (complete_normals()). Returns what was done, a
/// sentence once with the file it is true of first. Drawings of other roles stay as they are.
std::vector<std::string> complete_drawings(std::vector<HandDrawnTile>& drawings, Role role);

/// The drawings as a tile set with one map, called and meaning what `map` says, whose file doesn't count; their guard
/// measured. All must have one size, 4 to 4096 texels a
/// side, and one number of channels, and there must be as many as colors; the depth and encoding are those of
/// the first (Error, invalid_content). A complete set is brought into the usual order of its colors, so that
/// hashes find its tiles; `tiles` otherwise keep their order. Whether borders agree is not looked at: see
/// border_differences.
TileSet drawn_set(std::span<const HandDrawnTile> drawings, const TileColors& tiles, const MaterialFile& map);

} // namespace tilepack
