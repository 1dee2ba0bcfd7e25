#include "tilepack/error/error.h"
#include "tilepack/image/image_file.h"
#include "tilepack/image/openimageio_module.h"
#include "tilepack/image/png_file.h"
#include "tilepack/image/staged_file.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Imath/half.h>
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <stdexcept>

namespace tilepack {
namespace {

std::size_t value_bytes_of(Depth depth) {
  return depth == Depth::u8 ? 1 : depth == Depth::f32 ? 4 : 2;
}

Image multiplied_by_alpha(Image image) {
  const auto channels = static_cast<std::size_t>(image.channels());
  for (std::size_t at = 0; at + channels <= image.data().size(); at += channels)
    for (std::size_t c = 0; c + 1 < channels; ++c) image.data()[at + c] *= image.data()[at + channels - 1];
  return image;
}

/// The codes of `values`, in the machine's byte order.
std::vector<std::byte> stored(const Texels& values, Depth depth) {
  const std::size_t value_bytes = value_bytes_of(depth);
  std::vector<std::byte> bytes(values.size() * value_bytes);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, values.size(), 1 << 16), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      std::byte* to = bytes.data() + i * value_bytes;
      const auto put = [&](auto code) { std::memcpy(to, &code, sizeof code); };
      if (depth == Depth::u8) put(static_cast<std::uint8_t>(code_of(values[i], 255)));
      if (depth == Depth::u16) put(static_cast<std::uint16_t>(code_of(values[i], 65535)));
      if (depth == Depth::f16) put(half(values[i]).bits());
      if (depth == Depth::f32) put(values[i]);
    }
  });
  return bytes;
}

void check_what_is_written(const std::string& file, Size size, int channels, const StoredFormat& format) {
  const Depth depth = format.depth;
  if (!holds(format.container, depth) || container_by_name(file) != format.container)
    throw Error(ErrorKind::usage, file,
                fmt::format("a {} image is written as .{}; change the name or the depth", name_of(depth),
                            name_of(usual_container(depth))));
  if (channels < 1 || channels > 4 || size.width < 1 || size.height < 1 || size.width > max_image_side ||
      size.height > max_image_side)
    throw Error(
        ErrorKind::usage, file,
        fmt::format("{} x {} texels of {} channels cannot be written; each side may be 1 to {}, with 1 "
                    "to 4 channels",
                    size.width, size.height, channels, max_image_side));
}

} // namespace

struct ImageWriter::State {
  State(std::unique_ptr<StagedFile> own_file, StagedFile& into, Size image_size, int channel_count,
        const StoredFormat& format)
      : size(image_size), channels(channel_count), depth(format.depth),
        multiply(format.associated_alpha && channel_count % 2 == 0), own(std::move(own_file)), file(into) {
    // A failed write is remembered by the staged file, which is asked after each step.
    const ByteSink sink = [&staged = file](std::uint64_t offset, std::span<const std::byte> bytes) {
      staged.write(offset, bytes);
    };
    encode([&] {
      writer = format.container == ImageContainer::png
                   ? create_png(sink, size, channels, depth, format.encoding)
                   : openimageio<ImageIo>().create_exr(sink, size, channels, depth);
    });
  }

  /// Runs a step of the encoder; of what goes wrong, the system's reason comes first, if it has one.
  template <typename F>
  void encode(F step) {
    try {
      step();
    } catch (const Error&) {
      throw;
    } catch (const std::runtime_error& failed) {
      file.check();
      throw Error(ErrorKind::cannot_write, file.name(),
                  *failed.what() == 0 ? "the encoder gave up" : failed.what());
    }
    file.check();
  }

  Size size;
  int channels;
  Depth depth;
  bool multiply;                   // color by alpha
  std::unique_ptr<StagedFile> own; // unless another's is written
  StagedFile& file;
  RasterWriter writer; // declared last: on destruction it may still write to the file
  int rows_written = 0;
};

ImageWriter::ImageWriter(const std::filesystem::path& file, Size size, int channels, Depth depth,
                         Encoding encoding)
    : ImageWriter(file, size, channels, usual_format(depth, encoding)) {}

ImageWriter::ImageWriter(const std::filesystem::path& file, Size size, int channels,
                         const StoredFormat& format) {
  check_what_is_written(file.string(), size, channels, format);
  auto own = std::make_unique<StagedFile>(file);
  StagedFile& into = *own;
  state = std::make_unique<State>(std::move(own), into, size, channels, format);
}

ImageWriter::ImageWriter(StagedFile& into, Size size, int channels, const StoredFormat& format) {
  check_what_is_written(into.name(), size, channels, format);
  state = std::make_unique<State>(nullptr, into, size, channels, format);
}

ImageWriter::~ImageWriter() = default;
ImageWriter::ImageWriter(ImageWriter&&) noexcept = default;
ImageWriter& ImageWriter::operator=(ImageWriter&&) noexcept = default;

void ImageWriter::write(const Image& band) {
  State& s = *state;
  if (band.width() != s.size.width || band.channels() != s.channels ||
      band.height() > s.size.height - s.rows_written)
    throw std::logic_error("a band does not fit the image that was announced");
  if (band.empty()) return;
  const std::vector<std::byte> bytes =
      stored(s.multiply ? multiplied_by_alpha(band).data() : band.data(), s.depth);
  s.encode([&] { s.writer.write(s.rows_written, band.height(), bytes); });
  s.rows_written += band.height();
}

void ImageWriter::finish() {
  State& s = *state;
  if (s.rows_written != s.size.height) throw std::logic_error("finish() before the last row was written");
  s.encode([&] { s.writer.finish(); });
  if (s.own) s.own->commit();
}

void write_image(const std::filesystem::path& file, const Image& image, const StoredFormat& format) {
  ImageWriter writer(file, image.size(), image.channels(), format);
  writer.write(image);
  writer.finish();
}

void write_image(StagedFile& into, const Image& image, const StoredFormat& format) {
  ImageWriter writer(into, image.size(), image.channels(), format);
  writer.write(image);
  writer.finish();
}

void write_image(const std::filesystem::path& file, const Image& image, Depth depth, Encoding encoding) {
  write_image(file, image, usual_format(depth, encoding));
}

} // namespace tilepack
