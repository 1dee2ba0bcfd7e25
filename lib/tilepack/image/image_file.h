#pragma once

#include "tilepack/image/encoding.h"
#include "tilepack/image/image.h"
#include "tilepack/image/stored_format.h"

#include <filesystem>
#include <memory>
#include <optional>

namespace tilepack {

/// The longest side of an image that is read or written, in texels.
constexpr int max_image_side = 65536;

/// What a file says about its image before any texel is decoded.
struct ImageHeader {
  Size size;                          ///< both sides 1..max_image_side
  int channels = 0;                   ///< 1 to 4; palettes count as what they expand to
  Encoding encoding = Encoding::srgb; ///< from the file, else srgb for integers and linear for floats
  Depth depth = Depth::u8;            ///< as stored; 1- to 8-bit integers count as u8, 9- to 32-bit as u16,
                                      ///< doubles as f32
};

/// An image with what its file said about it.
struct ImageFile {
  Image image;                        ///< 1 to 4 channels, values and alpha as stored (see Image)
  Encoding encoding = Encoding::srgb; ///< asked for, else as in ImageHeader
  Depth depth = Depth::u8;            ///< as in ImageHeader
};

/// Reads the header alone, so that a caller can refuse a size before memory is taken for it. Whether the rest
/// of the file is there is not looked at. Throws as read_image does.
ImageHeader read_image_header(const std::filesystem::path& file);

/// Reads a PNG, JPEG, TIFF or OpenEXR file of 1 to 4 channels. The content decides the format, not the name.
///
/// Values come as stored: no color management, no change of alpha, no turning by an orientation tag. Of
/// several images in one file (parts, pages, mip levels) the first is read; of an EXR the data window.
///
/// Throws Error: cannot_read if the file is missing, empty, truncated, damaged or none of these formats;
/// invalid_content if it has more than 4 channels, a side over max_image_side, deep or signed samples, or a
/// value that is NaN or infinite (names the first texel). Memory is taken as rows arrive, so a header that
/// promises more than the file holds costs nothing.
ImageFile read_image(const std::filesystem::path& file, std::optional<Encoding> asked = {});

/// Writes the whole image, rounded to the depth of `format`. The bytes depend on the arguments alone: no date, no host
/// name, and for any number of threads. `file` must end in the name of the container, and the
/// container must hold the depth, else Error (usage). The file
/// appears complete or not at all: it is written under a temporary name beside `file` and renamed.
///
/// `srgb` marks a PNG as such. A `linear` PNG carries no mark, since browsers and importers would "correct"
/// normal maps and data by it: who reads it back must ask for linear. An EXR is linear by definition.
///
/// Throws Error: cannot_write if the folder is missing or read-only or the disk is full.
void write_image(const std::filesystem::path& file, const Image& image, const StoredFormat& format);

/// The same in the usual container of the depth.
void write_image(const std::filesystem::path& file, const Image& image, Depth depth, Encoding encoding);

/// The same in bands from top to bottom, for images that do not fit in memory.
///
///   ImageWriter writer(file, size, channels, format);
///   while (…) writer.write(band);   // any number of whole rows, width and channels as announced
///   writer.finish();                // all rows are there: the file gets its name
///
/// Destroyed without finish(), it leaves nothing behind. Rows that do not fit what was announced are a
/// programmer's mistake (std::logic_error).
class ImageWriter {
public:
  ImageWriter(const std::filesystem::path& file, Size size, int channels, const StoredFormat& format);
  ImageWriter(const std::filesystem::path& file, Size size, int channels, Depth depth, Encoding encoding);
  ~ImageWriter();
  ImageWriter(ImageWriter&&) noexcept;
  ImageWriter& operator=(ImageWriter&&) noexcept;

  void write(const Image& band);
  void finish();

private:
  struct State;
  std::unique_ptr<State> state;
};

} // namespace tilepack
