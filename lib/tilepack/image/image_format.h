#pragma once

#include <filesystem>

namespace tilepack {

/// The image formats that are read.
enum class ImageFormat { png, jpeg, tiff, exr };

/// The format of `file` by its first bytes. Throws Error (cannot_read) if it is missing, no regular file,
/// unreadable, empty or none of the formats.
ImageFormat image_format(const std::filesystem::path& file);

/// Throws Error (cannot_read) if bytes are missing from `file` or, for PNG, changed.
///
/// Decoders fill up what a cut file lacks with grey, some without a word, so the structure is walked before
/// decoding: PNG chunks with their checksums up to IEND, JPEG segments up to the end marker, TIFF directories
/// with the strips and tiles they point to. EXR files hold a table of their blocks which the decoder checks.
void check_complete(const std::filesystem::path& file, ImageFormat format);

} // namespace tilepack
