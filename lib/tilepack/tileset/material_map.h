#pragma once

#include "tilepack/image/encoding.h"
#include "tilepack/image/image.h"
#include "tilepack/numeric/enum_names.h"

#include <string>
#include <string_view>
#include <utility>
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

template <>
inline constexpr auto enum_names<Role> =
    std::array{EnumName{Role::color, "color"}, EnumName{Role::normal, "normal"},
               EnumName{Role::roughness, "roughness"}, EnumName{Role::height, "height"},
               EnumName{Role::data, "data"}};

/// Whether a map of that many channels has alpha, its last, which weighs what it stands beside.
constexpr bool has_alpha(Role role, int channels) {
  return role == Role::color && color_channels(channels) != channels;
}

/// What a map is called, what its values mean and how they are stored: the same whether it is a sample, cut
/// into tiles or laid out in a pack.
struct MapFormat {
  std::string name;                   ///< file-name-safe, unique in its set: "color", "normal", …
  Role role = Role::color;            ///<
  Encoding encoding = Encoding::srgb; ///< of the values held
  Depth depth = Depth::u8;            ///< what the values are rounded to

  bool operator==(const MapFormat&) const = default;
};

/// One image of a material: the exemplar, or one of several registered maps of equal size. Its depth is as
/// read, and that of the pack unless told otherwise.
struct SampleMap : MapFormat {
  Image image;      ///< values as in the file (see Image)
  std::string file; ///< where it came from, for messages; may be empty

  SampleMap() = default;
  SampleMap(MapFormat format, Image values, std::string from = {})
      : MapFormat(std::move(format)), image(std::move(values)), file(std::move(from)) {}
  SampleMap(std::string name_of_map, Role meaning, Encoding encoded, Depth stored, Image values,
            std::string from = {})
      : SampleMap(MapFormat{std::move(name_of_map), meaning, encoded, stored}, std::move(values),
                  std::move(from)) {}
};

/// One map of a tile set: the tiles' images in the order of their ids, all of one size.
struct TileMap : MapFormat {
  std::vector<Image> tiles;

  TileMap() = default;
  TileMap(MapFormat format, std::vector<Image> images)
      : MapFormat(std::move(format)), tiles(std::move(images)) {}
  TileMap(std::string name_of_map, Role meaning, Encoding encoded, Depth stored, std::vector<Image> images)
      : TileMap(MapFormat{std::move(name_of_map), meaning, encoded, stored}, std::move(images)) {}
};

} // namespace tilepack
