#pragma once

#include "tilepack/tileset/material_map.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tilepack {

/// A kind of map that a material may have: what it is called in a pack, what its values mean, and how files that
/// hold it are called. One table of all kinds decides how the maps of a folder are recognised, what --map takes,
/// and what help and README say about both.
struct MapKind {
  std::string_view name; ///< of the map in a pack, and a word for --map: "normal", "orm"
  Role role;
  std::vector<ChannelContent> contents; ///< of a packed map, one a channel; else empty
  /// What stands behind the name of the material, in small letters without separators. Those before '|' are
  /// taken where a material has both, as of displacement and bump.
  std::string_view endings;
  std::string_view values; ///< for help: what is stored and how it is averaged
};

/// All kinds; color, normal, roughness and height first.
std::span<const MapKind> map_kinds();

/// A kind and what else a word says.
struct KindNamed {
  const MapKind* kind;
  int rank = 0;                         ///< of two maps of one kind that of the lower rank is taken
  std::optional<NormalY> normal_y = {}; ///< "normalgl", "nordx"
};

/// The kind that a word in small letters, without separators, is an ending or the name of. The words gl, ogl and
/// opengl behind (or before) one of normals say that green points up, dx, directx and d3d that it points down.
std::optional<KindNamed> kind_called(std::string_view word);

/// "color, normal, …": the names of all kinds.
std::string listed_kinds();

/// The table for people, a kind a paragraph.
std::string kinds_text();

/// The names of all kinds with their endings alone, a line each or more of 100 columns: for help.
std::string kind_lines();

/// What the table says of the channels of a packed map, for a file that has `channels` of them: cut, or filled up
/// with ChannelContent::other. One content is that of all channels, none stays none.
std::vector<ChannelContent> filled_contents(std::vector<ChannelContent> contents, int channels);

} // namespace tilepack
