#pragma once

#include "tilepack/image/encoding.h"
#include "tilepack/image/image.h"

#include <filesystem>
#include <memory>
#include <optional>

namespace tilepack {

/// An image with what its file said about it.
struct ImageFile {
  Image image; ///< 1 to 4 channels, values as stored (see Image); alpha not premultiplied
  Encoding encoding =
      Encoding::srgb;      ///< asked for, else from the file, else srgb for integers and linear for floats
  Depth depth = Depth::u8; ///< as stored; 1- to 8-bit integers count as u8, 32-bit integers as u16
};

/// Reads PNG, JPEG, TIFF or EXR (any format of OpenImageIO) of 1 to 4 channels.
///
/// Throws Error: cannot_read if the file is missing, empty, truncated or no image; invalid_content if it has
/// more than 4 channels, a side over 65536, or a value that is NaN or infinite (names the first texel).
ImageFile read_image(const std::filesystem::path& file, std::optional<Encoding> asked = {});

/// The file formats written: 8- and 16-bit PNG, half and float EXR. Chosen by the depth: integers as PNG,
/// floats as EXR. "png" or "exr".
const char* extension_for(Depth depth);

/// Writes the whole image, rounded to `depth`. The bytes depend on the arguments alone: no date, no host
/// name, and for any number of threads. `file` must end in extension_for(depth). The file appears complete or
/// not at all: it is written under a temporary name beside `file` and renamed. Throws Error (cannot_write).
void write_image(const std::filesystem::path& file, const Image& image, Depth depth, Encoding encoding);

/// The same in bands from top to bottom, for images that do not fit in memory.
///
///   ImageWriter writer(file, size, channels, depth, encoding);
///   while (…) writer.write(band);   // any number of whole rows, width and channels as announced
///   writer.finish();                // all rows are there: the file gets its name
///
/// Destroyed without finish(), it leaves nothing behind.
class ImageWriter {
public:
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
