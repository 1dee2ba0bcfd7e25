#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace tilepack {

/// The image formats that are read.
enum class ImageFormat { png, jpeg, tiff, exr, tga, bmp, webp, hdr, jpeg2000, dds, psd };

/// Their names as messages list them: "PNG, JPEG, … or PSD".
std::string_view readable_formats();

/// What the name of a file ends in, ".png", in small letters; empty if it has no ending. Outputs are known by it.
std::string file_ending(const std::filesystem::path& file);

/// The format of `file` by its first bytes; an old TGA, which has no mark, by its name and header. Throws Error (cannot_read) if it is missing, no regular file,
/// unreadable, empty or none of the formats.
ImageFormat image_format(const std::filesystem::path& file);

struct AnnouncedSize {
  std::int64_t width = 0, height = 0;
};

/// The size of a JPEG 2000, whose decoder takes memory for all of it as soon as it opens a file; unset for the
/// other formats, and if the header doesn't say.
std::optional<AnnouncedSize> size_before_decoding(const std::filesystem::path& file, ImageFormat format);

/// Throws Error (cannot_read) if bytes are missing from `file` or, for PNG, changed.
///
/// Decoders fill up what a cut file lacks with grey, some without a word, so the structure is walked before
/// decoding: PNG chunks with their checksums up to IEND, JPEG segments up to the end marker, TIFF directories
/// with the strips and tiles they point to, BMP by its rows, WebP and JPEG 2000 by their boxes and end marks. EXR
/// files hold a table of their blocks, which the decoder checks; the decoders of the others report what is
/// missing.
void check_complete(const std::filesystem::path& file, ImageFormat format);

} // namespace tilepack
