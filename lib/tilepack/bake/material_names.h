#pragma once

#include "tilepack/bake/map_kinds.h"

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace tilepack {

/// The words of a name in small letters. They end at everything that is no letter or digit, and where capitals
/// begin ("rockAlbedo", "NormalGL", but "2K"); what says nothing of the material (a resolution, a depth, the name
/// of a format) is left out.
std::vector<std::string> material_words(std::string_view name);

/// The words without anything between them: names of one material have it in common, however they are spelled
/// ("Rock_01", "rock-01", "Rock01_2K").
std::string material_key(std::string_view name);

/// The resolution that a name states, "2k" or "2048x1024"; empty if it states none.
std::string resolution_in(std::string_view name);

/// What the name of an image file says when its last words are read as the ending of a kind of map.
struct NameReading {
  std::string key;     ///< of the material, see material_key(); `numbers` are its end
  std::string numbers; ///< that stand behind the ending: "02" of "rock_albedo_02"
  std::string shown;   ///< the material as it is written there
  KindNamed kind;
  std::string resolution; ///< see resolution_in()
  /// The word that names the kind is run together with the material's ("rockalbedo") or stands before it
  /// ("albedo_rock"): it counts only if other files bear it out.
  bool weak = false;
  bool one_letter = false; ///< "rock_n": counts in a folder, but says little of a single file
  /// Of two files for one map of one material that with the lesser list is taken: the ending's rank, a copy
  /// ("rock_albedo (1)"), the variant ("VAR2"), fewer bits, fewer texels, a format that loses more.
  std::array<int, 6> preference{};
};

/// All readings of the name of a file, the one with the longest ending first: "metal_roughness.png" is a packed
/// map without a name and the roughness of "metal". None for names that begin with a dot.
std::vector<NameReading> readings_of(std::string_view file_name);

/// Whether a name ends as those of the image formats that are read do.
bool has_readable_ending(std::string_view file_name);

/// Whether it ends as those of other image formats do.
bool has_other_image_ending(std::string_view file_name);

} // namespace tilepack
