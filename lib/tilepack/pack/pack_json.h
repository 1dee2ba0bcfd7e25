#pragma once

#include "tilepack/pack/pack.h"
#include "tilepack/pack/texture_file.h"

#include <string>
#include <string_view>
#include <vector>

namespace tilepack {

/// A pack as pack.json alone describes it: everything but the values of its images.
struct PackDescription {
  Pack pack;                                          ///< levels of its maps and mapping.ids empty
  std::vector<std::vector<TextureFile>> map_files;    ///< map → its files
  std::vector<std::vector<TextureFile>> corner_files; ///< map of the corner pack → its files
  std::string index_file;                             ///< of an index mapping, else empty

  /// All of the above, pack.json not counted.
  std::vector<std::string> all_files() const;
};

/// The description under which `pack` is written: levels are named NAME_LEVEL.png (or .exr), those of a
/// corner pack corner.NAME_LEVEL.png, the index map index.png. Levels may be left out of the result's pack.
PackDescription described(const Pack& pack);

/// The text of pack.json. The same description gives the same bytes: fixed order of fields, options of the
/// generator in alphabetical order, integers as they are, other numbers in their shortest exact form.
std::string pack_json(const PackDescription& description);

/// Reads such a text back. Throws Error (invalid_content) for anything that is not as FORMAT.md says, or
/// that a sampler could not look up safely; what is merely wrong (two tiles in one cell, a table that is no
/// permutation) is left to check_folder(). `file` is how messages name the text.
PackDescription parsed_pack_json(std::string_view text, const std::string& file);

} // namespace tilepack
