#pragma once

#include "tilepack/image/stored_format.h"
#include "tilepack/tileset/material_map.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tilepack {

/// How the values of a material's maps are to be taken.
struct MaterialOptions {
  std::optional<NormalY> normal_y;        ///< which way green shall point; unset: as it does
  std::optional<ValueRange> height_range; ///< heights that are stored as 0 and 1
  bool fit_height_range = false;          ///< from the least to the greatest height there is
};

/// What is done to the maps of a material between reading and baking:
///
///   normals   complete_normals(); which way green points is found out, by the name of the file
///             (MapFormat::normal_y as it comes) or by green_evidence() with the first height map, and turned if
///             `options` ask for the other
///   heights   of floats: with a range, v becomes (v - low) / (high - low), and the range is kept with the map.
///             Integers are taken to fill the range given already, and have none of their own
///   one value a texel (roughness, height, ao, metallic, opacity): alpha that is 1 everywhere goes; opacity that
///             lies in alpha alone is taken from there
///
/// Returns what there is to tell, "FILE: sentence" with marked fields. Throws Error (invalid_content) as
/// complete_normals() does, and for heights outside the range given.
std::vector<std::string> prepare_maps(std::vector<SampleMap>& maps, const MaterialOptions& options);

/// Values that can't be stored: integers hold 0 to 1. Throws Error (invalid_content) if they are to be stored as
/// `depth` and more than rounding lies beyond; but light may, as highlights are clipped everywhere: then the result
/// is a note that tells, else empty. The message names the way out.
std::string check_storable(const SampleMap& map, Depth depth);

} // namespace tilepack
