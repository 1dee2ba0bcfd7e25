#pragma once

#include "tilepack/tileset/material_map.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tilepack {

/// An image file of a material, and what it is in it.
struct MaterialFile {
  std::string name; ///< of the map: "color", "normal", "roughness", "height", "ao", "orm", …
  Role role = Role::color;
  std::string file; ///< as it was given
  bool operator==(const MaterialFile&) const = default;
};

/// Recognises the maps of one material among the names of files in a folder, by the usual endings:
///
///   color      _albedo _basecolor _base_color _color _col _diff _diffuse
///   normal     _normal _norm _nor _nrm, each also with gl or dx, _gl or _dx: gl is taken if both are there
///   roughness  _rough _roughness          height  _height _disp _displacement _bump
///   data       _ao _occlusion _orm _arm _rma _metal _metallic _metalness _gloss _glossiness _specular _mask
///   …
///
/// In any case of letters, also after '-' or '.', and before a resolution ("rock_diff_4k.png"). Files that
/// are no images by their extension, or have no such ending, are passed over. `prefix`, if not empty, picks
/// the material of that name. The color map comes first, then normal, roughness, height, the others by name.
///
/// Throws Error (invalid_content): no color map, two files for one map, or several materials to choose from
/// (all are named). `folder` is how messages name the place.
std::vector<MaterialFile> material_files(std::span<const std::string> file_names, const std::string& prefix,
                                         const std::string& folder);

/// The map that such an ending says this file is; none if it has none.
std::optional<MaterialFile> map_by_name(const std::string& file);

} // namespace tilepack
