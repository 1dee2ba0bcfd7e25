#pragma once

#include "tilepack/image/image.h"
#include "tilepack/image/image_file.h"
#include "tilepack/image/stored_format.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace tilepack {

/// One file of a map: some of its levels, one after another, each of so many layers. The files of a map hold
/// its levels in order. A PNG or EXR holds one level of one layer.
struct TextureFile {
  std::string file;         ///< relative to the folder of pack.json
  std::vector<Size> levels; ///< finest first: the texels of a layer
  int layers = 1;
  bool operator==(const TextureFile&) const = default;
};

/// How many levels `files` hold together.
int levels_in(std::span<const TextureFile> files);

/// The sizes of these levels, finest first.
std::vector<Size> level_sizes(std::span<const TextureFile> files);

/// The files for levels of these sizes, each named STEM_LEVEL.ENDING.
std::vector<TextureFile> texture_files(const std::string& stem, std::span<const Size> levels,
                                       ImageContainer container);

/// Checks the header of `path` against what pack.json announces, before texels take any memory. Throws Error:
/// cannot_read if it is truncated or no image, invalid_content if size, channels or depth differ.
void check_texture_file(const std::filesystem::path& path, const TextureFile& announced, int channels,
                        Depth depth);

/// How files of a pack are read, of this encoding: alpha in them is never associated, also in EXR.
ReadOptions pack_reading(Encoding encoding);

/// Reads the levels of a file, values as stored in `encoding`, into as many images. Throws as read_image does.
void read_texture_file(const std::filesystem::path& path, Encoding encoding, std::span<Image> levels);

/// Writes as many levels as one file of this kind holds. Throws as write_image does.
void write_texture_file(const std::filesystem::path& path, std::span<const Image> levels,
                        const StoredFormat& format);

} // namespace tilepack
