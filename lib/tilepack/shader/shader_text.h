#pragma once

#include "tilepack/pack/pack.h"
#include "tilepack/sampler/address.h"
#include "tilepack/shader/shader_language.h"

#include <cstdint>
#include <filesystem>
#include <string>

namespace tilepack {

/// What is asked of a lookup's text.
struct ShaderSettings {
  ShaderLanguage language = ShaderLanguage::glsl;
  std::string name = "tilepack"; ///< what all names in the text begin with: a letter, then letters and digits
  WrapMode border = WrapMode::wrap; ///< what lies beyond the virtual texture
  bool has_head = true;             ///< comments: what made it, of which pack, how it is used; and of GLSL, precisions for ES
};

/// The lookup of a pack, to be included in a shader: constants and functions of lookup_description.h and nothing that
/// this pack does not need. The same pack and settings give the same bytes.
///
/// `pack` needs no texels. `made_by` is the command that makes the text, `content` pack_content_hash(); both stand
/// at its head. Error (invalid_content), which says what to bake instead, for what the language can't express;
/// Error (usage, field "name") for a name that is none.
std::string shader_text(const Pack& pack, const ShaderSettings& settings, const std::string& made_by,
                        std::uint64_t content);

/// A number of 64 bits that changes with any byte of pack.json and the files that it names. Error (cannot_read).
std::uint64_t pack_content_hash(const std::filesystem::path& folder_or_json);

} // namespace tilepack
