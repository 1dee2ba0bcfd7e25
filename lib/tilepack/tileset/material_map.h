#pragma once

#include "tilepack/image/encoding.h"
#include "tilepack/image/image.h"

#include <string>
#include <string_view>
#include <vector>

namespace tilepack {

/// What the values of a map mean, which decides how they are compared, averaged and stored.
enum class Role {
  color,     ///< light; averaged in linear light, weighted by alpha where there is one
  normal,    ///< unit vector, stored as n * 0.5 + 0.5; averaged as vectors, renormalised
  roughness, ///< 0..1, plain average
  height,    ///< plain average
  data,      ///< anything else: masks, packed channels, occlusion; plain average
};

std::string_view name_of(Role role);

/// One image of a material: the exemplar, or one of several registered maps of equal size.
struct SampleMap {
  std::string name;                   ///< file-name-safe, unique in its set: "color", "normal", …
  Role role = Role::color;            ///<
  Encoding encoding = Encoding::srgb; ///< of `image`
  Depth depth = Depth::u8;            ///< as read; the depth of the pack unless told otherwise
  Image image;                        ///< values as in the file (see Image)
  std::string file = {};              ///< where it came from, for messages; may be empty
};

/// One map of a tile set: the tiles' images in the order of their ids, all of one size.
struct TileMap {
  std::string name;
  Role role = Role::color;
  Encoding encoding = Encoding::srgb;
  Depth depth = Depth::u8;
  std::vector<Image> tiles;
};

} // namespace tilepack
