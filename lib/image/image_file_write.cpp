#include "tilepack/error/error.h"
#include "tilepack/image/image_file.h"
#include "tilepack/image/staged_file.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
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

/// Lets OpenImageIO write into a staged file through a buffer, since libpng hands over 8 kB at a time.
///
/// It never reports a failure: libpng would print about it. The staged file remembers it, and is asked.
class StagedProxy final : public OIIO::Filesystem::IOProxy {
public:
  StagedProxy(const std::string& name, StagedFile& staged) : IOProxy(name, Write), file(staged) {}

  const char* proxytype() const override { return "tilepack"; }
  void close() override { flush_buffer(); }
  bool seek(int64_t offset) override {
    flush_buffer();
    m_pos = offset;
    return true;
  }
  size_t write(const void* bytes, size_t count) override {
    if (buffer.size() + count > buffer_bytes) flush_buffer();
    const auto* from = static_cast<const std::byte*>(bytes);
    buffer.insert(buffer.end(), from, from + count);
    m_pos += static_cast<int64_t>(count);
    return count;
  }
  size_t pwrite(const void* bytes, size_t count, int64_t offset) override {
    flush_buffer();
    file.write(static_cast<std::uint64_t>(offset), {static_cast<const std::byte*>(bytes), count});
    return count;
  }
  size_t size() const override {
    return static_cast<size_t>(std::max<std::uint64_t>(file.size(), static_cast<std::uint64_t>(m_pos)));
  }
  void flush() const override {}

private:
  void flush_buffer() {
    if (buffer.empty()) return;
    file.write(static_cast<std::uint64_t>(m_pos) - buffer.size(), buffer);
    buffer.clear();
  }

  static constexpr std::size_t buffer_bytes = std::size_t{1} << 20;
  StagedFile& file;
  std::vector<std::byte> buffer;
};

bool is_integer(Depth depth) {
  return depth == Depth::u8 || depth == Depth::u16;
}

OIIO::TypeDesc stored_type(Depth depth) {
  switch (depth) {
  case Depth::u8:
    return OIIO::TypeDesc::UINT8;
  case Depth::u16:
    return OIIO::TypeDesc::UINT16;
  case Depth::f16:
    return OIIO::TypeDesc::HALF;
  case Depth::f32:
    break;
  }
  return OIIO::TypeDesc::FLOAT;
}

/// The codes of `values`, in the machine's byte order.
std::vector<std::byte> stored(const std::vector<float>& values, Depth depth) {
  const std::size_t value_bytes = stored_type(depth).size();
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

OIIO::ImageSpec spec_of(Size size, int channels, Depth depth, Encoding encoding) {
  OIIO::ImageSpec spec(size.width, size.height, channels, stored_type(depth));
  static const std::vector<std::string> grey = {"Y", "A"}, color = {"R", "G", "B", "A"};
  const auto& names = channels <= 2 ? grey : color;
  spec.channelnames.assign(names.begin(), names.begin() + channels);
  spec.alpha_channel = channels % 2 == 0 ? channels - 1 : -1;
  spec.attribute("oiio:UnassociatedAlpha", 1); // no multiplication by alpha on the way
  if (is_integer(depth)) {
    if (encoding == Encoding::srgb) spec.attribute("oiio:ColorSpace", "sRGB");
    // Photographs, 1200 x 1200 RGB, processor time and size by level: 8 bits 0.15 s 2.91 MB at 1, 0.23 s 2.97
    // MB at 4, 0.32 s 2.95 MB at 6; 16 bits 0.23 s 3.90 MB, 0.36 s 3.55 MB, 0.96 s 3.41 MB.
    spec.attribute("png:compressionLevel", 1);
  } else {
    spec.attribute("oiio:ColorSpace", "Linear");
    // The same photographs: half 0.17 s 3.20 MB with piz, 0.46 s 5.33 MB with zip; float 0.28 s 7.3 MB, 0.83
    // s 10.1 MB.
    spec.attribute("compression", "piz");
    spec.attribute("DateTime", ""); // else the time of writing
  }
  return spec;
}

} // namespace

struct ImageWriter::State {
  State(const std::filesystem::path& path, Size image_size, int channel_count, Depth stored_depth)
      : name(path.string()), size(image_size), channels(channel_count), depth(stored_depth), file(path),
        proxy(name, file) {}

  ~State() { abandon(); }

  // Closing a PNG before its first block of texels left the encoder makes libpng print an error. So
  // unfinished images get rows that do not compress until a block is out, or all their rows.
  void abandon() {
    if (!open || !is_integer(depth)) return;
    std::vector<std::uint16_t> row(static_cast<std::size_t>(size.width) * static_cast<std::size_t>(channels));
    std::uint32_t noise = 1;
    const std::int64_t start = proxy.tell();
    for (; rows_written < size.height && proxy.tell() == start; ++rows_written) {
      for (std::uint16_t& v : row)
        v = static_cast<std::uint16_t>((noise = noise * 1664525u + 1013904223u) >> 16);
      output->write_scanlines(rows_written, rows_written + 1, 0, stored_type(depth), row.data());
    }
    output->close();
  }

  [[noreturn]] void fail() {
    file.check(); // the system's reason, if it has one
    const std::string reason = output->geterror();
    throw Error(ErrorKind::cannot_write, name, reason.empty() ? "the encoder gave up" : reason);
  }

  std::string name;
  Size size;
  int channels;
  Depth depth;
  StagedFile file;
  StagedProxy proxy;
  std::unique_ptr<OIIO::ImageOutput> output; // declared last: on destruction it may still write to the proxy
  int rows_written = 0;
  bool open = false;
};

const char* extension_for(Depth depth) {
  return is_integer(depth) ? "png" : "exr";
}

ImageWriter::ImageWriter(const std::filesystem::path& file, Size size, int channels, Depth depth,
                         Encoding encoding) {
  const char* extension = extension_for(depth);
  if (file.extension() != std::string(".") + extension)
    throw Error(
        ErrorKind::usage, file.string(),
        fmt::format("a {} image is written as .{}; change the name or the depth", name_of(depth), extension));
  if (channels < 1 || channels > 4 || size.width < 1 || size.height < 1 || size.width > max_image_side ||
      size.height > max_image_side)
    throw Error(
        ErrorKind::usage, file.string(),
        fmt::format("{} x {} texels of {} channels cannot be written; each side may be 1 to {}, with 1 "
                    "to 4 channels",
                    size.width, size.height, channels, max_image_side));
  state = std::make_unique<State>(file, size, channels, depth);
  state->output = OIIO::ImageOutput::create(is_integer(depth) ? "png" : "openexr");
  if (!state->output) throw Error(ErrorKind::internal, state->name, OIIO::geterror());
  state->output->set_ioproxy(&state->proxy);
  if (!state->output->open(state->name, spec_of(size, channels, depth, encoding))) state->fail();
  state->open = true;
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
  const std::vector<std::byte> bytes = stored(band.data(), s.depth);
  if (!s.output->write_scanlines(s.rows_written, s.rows_written + band.height(), 0, stored_type(s.depth),
                                 bytes.data()))
    s.fail();
  s.file.check();
  s.rows_written += band.height();
}

void ImageWriter::finish() {
  State& s = *state;
  if (s.rows_written != s.size.height) throw std::logic_error("finish() before the last row was written");
  s.open = false;
  if (!s.output->close()) s.fail();
  s.proxy.close();
  s.file.commit();
}

void write_image(const std::filesystem::path& file, const Image& image, Depth depth, Encoding encoding) {
  ImageWriter writer(file, image.size(), image.channels(), depth, encoding);
  writer.write(image);
  writer.finish();
}

} // namespace tilepack
