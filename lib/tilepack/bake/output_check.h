#pragma once

#include "tilepack/image/file_swap.h"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tilepack {

/// A file that is asked for, and who asks.
struct OutputFile {
  std::string where; ///< for messages: field("report")
  std::string file;  ///< empty: not asked for
};

/// The one absolute path of what `file` means, without links as far as it exists. Never throws.
std::filesystem::path one_spelling(const std::string& file);

/// What there is behind a name and all its links; nothing if nothing is.
std::optional<FileId> id_behind(const std::string& file);

/// The folder of the pack that `file`, which is there, is a part of: its pack.json, or named by that. Empty if it is
/// none.
std::filesystem::path pack_of_file(const std::string& file);

/// Throws Error (usage) if an output would replace one of `inputs`, which are read, another output, or a file of a
/// pack that is there; also by another spelling of the same path or through links. To be called before anything is
/// written.
void check_outputs(std::span<const OutputFile> outputs, std::span<const std::string> inputs);

/// The pack.json of `pack` (a folder or pack.json) and all files that it names. Throws Error if it can't be
/// read.
std::vector<std::string> files_of_pack(const std::string& pack);

/// check_pack_folder, and Error (usage) for the field "output" if `folder` lies in another pack, or `inputs`
/// are `folder` itself or among the files of a pack in it, which a new one replaces.
void check_pack_folder_for(const std::string& folder, std::span<const std::string> inputs);

/// What is wrong with the name of a file that does not end in one of `allowed`, for a message.
std::string without_ending(const std::string& file, const std::string& allowed);

/// Throws Error (usage) if `output`, a text without an ending of its own (a depfile), ends as images do: whoever
/// writes that has slipped, and a picture would be lost.
void check_text_name(const OutputFile& output);

/// The same, also for .json: shaders have endings enough, and pack.json is near.
void check_shader_name(const OutputFile& output);

/// Throws Error (usage) unless `output` is empty or ends in .html or .htm: a page is nothing else.
void check_page_name(const OutputFile& output);

/// Throws Error (cannot_write) if `file` can't be created in its folder. Leaves no trace.
void check_writable(const std::string& file);

} // namespace tilepack
