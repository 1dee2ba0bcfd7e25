#pragma once

#include "tilepack/image/encoding.h"
#include "tilepack/image/image.h"
#include "tilepack/numeric/enum_names.h"

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tilepack {

/// What the values of a map mean, which decides how they are compared, averaged and stored.
enum class Role {
  color,     ///< light; averaged in linear light, weighted by alpha where there is one
  normal,    ///< unit vector, stored as n * 0.5 + 0.5; averaged as vectors, renormalised
  roughness, ///< 0..1, plain average, which takes up the spread of normals
  height,    ///< plain average
  data,      ///< anything else: masks, packed channels (see ChannelContent); plain average
  ao,        ///< ambient occlusion, the share of the sky that is seen, 0..1; plain average
  metallic,  ///< 0..1, plain average
  emissive,  ///< light, as color
  opacity,   ///< 0..1, plain average
};

template <>
inline constexpr auto enum_names<Role> =
    std::array{EnumName{Role::color, "color"},         EnumName{Role::normal, "normal"},
               EnumName{Role::roughness, "roughness"}, EnumName{Role::height, "height"},
               EnumName{Role::data, "data"},           EnumName{Role::ao, "ao"},
               EnumName{Role::metallic, "metallic"},   EnumName{Role::emissive, "emissive"},
               EnumName{Role::opacity, "opacity"}};

/// Values are light: they have an encoding, and are averaged in linear light.
constexpr bool is_light(Role role) {
  return role == Role::color || role == Role::emissive;
}

/// Whether a map of that many channels has alpha, its last, which weighs what it stands beside.
constexpr bool has_alpha(Role role, int channels) {
  return is_light(role) && color_channels(channels) != channels;
}

/// What one channel of a map that several maps were packed into holds.
enum class ChannelContent {
  ao,        ///<
  roughness, ///< takes up the spread of normals, as a map of roughness does
  gloss,     ///< 1 - roughness
  metallic,  ///<
  height,    ///<
  other,     ///< something else, or nothing
};

template <>
inline constexpr auto enum_names<ChannelContent> =
    std::array{EnumName{ChannelContent::ao, "ao"},         EnumName{ChannelContent::roughness, "roughness"},
               EnumName{ChannelContent::gloss, "gloss"},   EnumName{ChannelContent::metallic, "metallic"},
               EnumName{ChannelContent::height, "height"}, EnumName{ChannelContent::other, "other"}};

/// Which way the second component of a normal map, its green, points in the picture.
enum class NormalY {
  up,   ///< north, as OpenGL, glTF and Blender have it
  down, ///< south, as DirectX and Unreal have it
};

template <>
inline constexpr auto enum_names<NormalY> =
    std::array{EnumName{NormalY::up, "up"}, EnumName{NormalY::down, "down"}};

/// What stored values stand for: 0 for `low`, 1 for `high`.
struct ValueRange {
  double low = 0;
  double high = 1;
  bool operator==(const ValueRange&) const = default;
};

/// What a map is called, what its values mean and how they are stored: the same whether it is a sample, cut
/// into tiles or laid out in a pack.
struct MapFormat {
  std::string name;                          ///< file-name-safe, unique in its set: "color", "normal", …
  Role role = Role::color;                   ///<
  Encoding encoding = Encoding::srgb;        ///< of the values held
  Depth depth = Depth::u8;                   ///< what the values are rounded to
  std::vector<ChannelContent> contents = {}; ///< of a packed map (role data), one a channel; else empty
  std::optional<NormalY> normal_y = {};      ///< of normals, where it is known
  std::optional<ValueRange> range = {}; ///< of heights, where stored values are not the heights themselves

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

  /// What messages call it: the file, or the name of what came from none.
  const std::string& label() const { return file.empty() ? name : file; }
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
