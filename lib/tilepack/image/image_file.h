#pragma once

#include "tilepack/image/encoding.h"
#include "tilepack/image/image.h"
#include "tilepack/image/stored_format.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tilepack {

class StagedFile;

/// The longest side of an image that is read or written, in texels.
constexpr int max_image_side = 65536;

/// The most texels an image has that is read without being asked for more: 16384 x 16384, beyond what graphics
/// hardware takes. In memory a texel is a float a channel.
constexpr std::int64_t usual_most_texels = std::int64_t{1} << 28;

/// What becomes of color that a file holds multiplied by alpha.
enum class AlphaReading {
  straight, ///< divided out, so that color and alpha are independent; where alpha is 0 color stays as it is
  as_stored ///< left: for files whose alpha is known to be straight though their format says otherwise (packs)
};

/// How a file is to be read.
struct ReadOptions {
  std::optional<Encoding> encoding; ///< unset: what the file says
  std::string channels;             ///< "R,G,B": these, by name; empty: as channel_choice.h has it
  AlphaReading alpha = AlphaReading::straight;
  std::int64_t most_texels = usual_most_texels; ///< images of more are refused before memory is taken
};

/// What a file says about its image before any texel is decoded.
struct ImageHeader {
  Size size;                          ///< both sides 1..max_image_side, of the upright picture
  int channels = 0;                   ///< 1 to 4; palettes count as what they expand to
  Encoding encoding = Encoding::srgb; ///< from the file, else srgb for integers and linear for floats
  Depth depth = Depth::u8;            ///< as stored; 1- to 8-bit integers count as u8, 9- to 32-bit as u16,
                                      ///< doubles as f32
};

/// An image with what its file said about it.
struct ImageFile {
  Image image; ///< 1 to 4 channels, values as stored (see Image), upright, straight alpha
  Encoding encoding = Encoding::srgb; ///< asked for, else as in ImageHeader
  Depth depth = Depth::u8;            ///< as in ImageHeader
  /// A sentence each: what in the file was passed over or is in doubt, and what to do. Fields are marked
  /// (error/field.h), and the file is not named: "FILE: holds several images …".
  std::vector<std::string> notes = {};
};

/// Reads the header alone, so that a caller can refuse a size before memory is taken for it. Whether the rest
/// of the file is there is not looked at. Throws as read_image does.
ImageHeader read_image_header(const std::filesystem::path& file, const ReadOptions& options = {});

/// Reads an image file of 1 to 4 channels in one of the formats of image_format.h. The content decides the
/// format, not the name.
///
/// Values come as stored, without color management. Color multiplied by alpha (EXR by definition, TIFF with
/// ExtraSamples 1) is divided again and rounded to the depth; the picture is turned upright by the orientation
/// of TIFF and Exif; white that is stored as 0 is 1. An ICC profile, or PNG's cICP, goes before other words
/// about the transfer curve. Of several images in one file (parts, pages, mip levels) the first is read, of an
/// EXR the data window; a note says so.
///
/// Throws Error: cannot_read if the file is missing, empty, truncated, damaged or none of these formats;
/// invalid_content if it has more than 4 channels, channels that no map has, a side over max_image_side, more
/// texels than asked for, deep, signed or (in EXR) integer samples, or a value that is NaN or infinite (names
/// the first texel); usage if a channel asked for is not there. Memory is taken as rows arrive, so a header
/// that promises more than the file holds costs nothing. std::bad_alloc passes.
ImageFile read_image(const std::filesystem::path& file, const ReadOptions& options);

/// The same with nothing asked for but, perhaps, the encoding.
ImageFile read_image(const std::filesystem::path& file, std::optional<Encoding> asked = {});

/// Writes the whole image, rounded to the depth of `format`. The bytes depend on the arguments alone: no date,
/// no host name, and for any number of threads. `file` must end in the name of the container, and the container
/// must hold the depth, else Error (usage). The file appears complete or not at all: it is written under a
/// temporary name beside `file` and renamed.
///
/// `srgb` marks a PNG as such. A `linear` PNG carries no mark, since browsers and importers would "correct"
/// normal maps and data by it: who reads it back must ask for linear. An EXR is linear by definition.
/// Color is multiplied by alpha on the way if the format says so.
///
/// Throws Error: cannot_write if the folder is missing or read-only or the disk is full.
void write_image(const std::filesystem::path& file, const Image& image, const StoredFormat& format);

/// The same in the usual container of the depth.
void write_image(const std::filesystem::path& file, const Image& image, Depth depth, Encoding encoding);

/// The same into a file that others get their names with.
void write_image(StagedFile& into, const Image& image, const StoredFormat& format);

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
  /// Into a file that others get their names with: finish() leaves it to whoever staged it.
  ImageWriter(StagedFile& into, Size size, int channels, const StoredFormat& format);
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
