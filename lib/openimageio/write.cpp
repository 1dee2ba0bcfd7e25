#include "image_functions.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

namespace tilepack {
namespace {

/// Hands what OpenImageIO writes to a sink, through a buffer: encoders write a few bytes at a time.
class SinkProxy final : public OIIO::Filesystem::IOProxy {
public:
  explicit SinkProxy(ByteSink to) : IOProxy("", Write), sink(std::move(to)) {}

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
    length = std::max(length, m_pos);
    return count;
  }
  size_t pwrite(const void* bytes, size_t count, int64_t offset) override {
    flush_buffer();
    sink(static_cast<std::uint64_t>(offset), {static_cast<const std::byte*>(bytes), count});
    length = std::max(length, offset + static_cast<int64_t>(count));
    return count;
  }
  size_t size() const override { return static_cast<size_t>(length); }
  void flush() const override {}

private:
  void flush_buffer() {
    if (buffer.empty()) return;
    sink(static_cast<std::uint64_t>(m_pos) - buffer.size(), buffer);
    buffer.clear();
  }

  static constexpr std::size_t buffer_bytes = std::size_t{1} << 20;
  ByteSink sink;
  std::vector<std::byte> buffer;
  int64_t length = 0;
};

OIIO::TypeDesc stored_type(Depth depth) {
  return depth == Depth::f16 ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::FLOAT;
}

OIIO::ImageSpec spec_of(Size size, int channels, Depth depth) {
  OIIO::ImageSpec spec(size.width, size.height, channels, stored_type(depth));
  static const std::vector<std::string> grey = {"Y", "A"}, color = {"R", "G", "B", "A"};
  const auto& names = channels <= 2 ? grey : color;
  spec.channelnames.assign(names.begin(), names.begin() + channels);
  spec.alpha_channel = channels % 2 == 0 ? channels - 1 : -1;
  spec.attribute("oiio:UnassociatedAlpha", 1); // no multiplication by alpha on the way
  spec.attribute("oiio:ColorSpace", "Linear");
  // Photographs, 1200 x 1200 RGB, processor time and size: half 0.17 s 3.20 MB with piz, 0.46 s 5.33 MB with
  // zip; float 0.28 s 7.3 MB, 0.83 s 10.1 MB.
  spec.attribute("compression", "piz");
  spec.attribute("DateTime", ""); // else the time of writing
  return spec;
}

struct CreatedFile {
  SinkProxy proxy;
  OIIO::TypeDesc type;
  std::unique_ptr<OIIO::ImageOutput> output; // after the proxy: on destruction it may still write to it

  explicit CreatedFile(ByteSink sink) : proxy(std::move(sink)) {}

  void check(bool ok) const {
    if (!ok) throw std::runtime_error(output->geterror());
  }
};

} // namespace

void warm_up() {
  constexpr int side = 256;
  const RasterWriter writer =
      create_exr([](std::uint64_t, std::span<const std::byte>) {}, {side, side}, 4, Depth::f16);
  const std::vector<std::byte> rows(std::size_t{side} * side * 4 * 2);
  writer.write(0, side, rows);
  writer.finish();
}

RasterWriter create_exr(ByteSink sink, Size size, int channels, Depth depth) {
  auto file = std::make_shared<CreatedFile>(std::move(sink));
  file->type = stored_type(depth);
  file->output = OIIO::ImageOutput::create("openexr");
  if (!file->output) throw std::runtime_error(OIIO::geterror());
  file->output->set_ioproxy(&file->proxy);
  file->check(file->output->open("memory.exr", spec_of(size, channels, depth)));
  return {[file](int top, int rows, std::span<const std::byte> texels) {
            file->check(file->output->write_scanlines(top, top + rows, 0, file->type, texels.data()));
          },
          [file] {
            file->check(file->output->close());
            file->proxy.close();
          }};
}

} // namespace tilepack
