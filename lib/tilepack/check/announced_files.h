#pragma once

#include "tilepack/image/encoding.h"
#include "tilepack/image/image.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tilepack {

/// An image that pack.json names, with what it says about it.
struct AnnouncedFile {
  enum class Kind { map, corner_map, index_map };
  Kind kind = Kind::map;
  int map = 0;       ///< which of the maps, of the pack or of its corner pack
  int level = 0;     ///<
  std::string where; ///< the place of the name in pack.json: "maps[0].levels[2].file"
  std::string file;
  std::optional<Size> size; ///< these are absent where pack.json has nothing sound to say
  std::optional<int> channels;
  std::optional<Depth> depth;
};

/// The files named in a pack.json, sound or not: whatever looks like a name where a name belongs, so that
/// missing files are found even if a field elsewhere is broken. Empty if the text is no JSON.
std::vector<AnnouncedFile> announced_files(std::string_view pack_json);

} // namespace tilepack
