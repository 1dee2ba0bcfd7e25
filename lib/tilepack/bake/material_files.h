#pragma once

#include "tilepack/bake/map_kinds.h"
#include "tilepack/tileset/material_map.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tilepack {

/// An image file of a material, and what is in it.
struct MaterialFile {
  std::string name; ///< of the map: "color", "normal", "roughness", "height", "ao", "orm", …
  Role role = Role::color;
  std::string file;                          ///< as it was given
  std::vector<ChannelContent> contents = {}; ///< of a packed map; cut to the channels there are on reading
  std::optional<NormalY> normal_y = {};      ///< as its name says
  bool operator==(const MaterialFile&) const = default;
};

/// A file that looks like a map of a material and is not taken.
struct PassedOver {
  std::string file;
  std::string why;   ///< "its format isn't read; …": what follows "FILE is passed over: "
  std::string label; ///< "normal", "cavity:data": --map LABEL=FILE takes it; empty: nothing does
  bool operator==(const PassedOver&) const = default;
};

/// The maps of one material among the files of a folder.
struct FoundMaterial {
  std::vector<MaterialFile> files; ///< color first, then normal, roughness, height, the others by name
  std::vector<PassedOver> passed_over;
  std::string name = {};                ///< of the material, as its files begin
  std::vector<std::string> unlike = {}; ///< images of the folder that nothing says to be of this material
};

/// Recognises the maps of one material among the names of files in a folder, by the endings of map_kinds():
/// in any case of letters, behind any separator or a capital ("rock_albedo", "Rock Albedo", "rockAlbedo"), in one
/// word or several ("Base_Color", "normal-ogl"), before a resolution, a depth or the name of a format
/// ("rock_diff_4k", "NRM16_2K-PNG"). Files belong together if their names without all that have the same letters
/// and digits. A file that has the name of the others alone is the color map if no other is. Names that begin
/// with a dot are not seen.
///
/// Of two files for one map the better is taken (NameReading::preference), green up before green down. What looks
/// like a map of the material and isn't taken is passed over with a reason; pictures of the material as a whole
/// (preview, thumbnail …) without one. `prefix`, if not empty, picks the material of that name, and its files of
/// one resolution if it states one ("rock_2k").
///
/// Throws Error (invalid_content): no color map (what was seen is named), two files for one map with nothing to
/// choose by, several materials (all are named), or a color map alone among images that are none of its maps, where
/// nothing says that it is the one that is meant. `folder` is how messages name the place.
FoundMaterial material_files(std::span<const std::string> file_names, const std::string& prefix,
                             const std::string& folder);

/// A line for the user on what a folder was taken for, and that its other images are passed over: for a material with
/// `unlike` images.
std::string note_on_unlike(const FoundMaterial& found, const std::string& folder);

/// The map that its ending says this file is; none if it has none, or one of a single letter.
std::optional<MaterialFile> map_by_name(const std::string& file);

} // namespace tilepack
