#include "tilepack/error/error.h"
#include "tilepack/image/image_file.h"
#include "tilepack/image/image_format.h"
#include "tilepack/image/openimageio_module.h"
#include "tilepack/image/png_file.h"

#include <fmt/format.h>

#include <Imath/half.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <new>
#include <span>

namespace tilepack {
namespace {

// A band of decoded rows is held beside the image. This many bytes keep the decoder's threads busy.
constexpr std::size_t band_bytes = std::size_t{8} << 20;
// A strip beyond this is read row by row, in smaller bands.
constexpr std::size_t max_strip_bytes = std::size_t{64} << 20;
// Tiles can only be decoded in whole rows of tiles. 256 rows of 65536 RGBA floats are as much.
constexpr std::size_t max_band_bytes = std::size_t{256} << 20;

/// An open file and what is known of it.
struct Source {
  std::string name;
  RasterReader reader;
  ImageHeader header;
};

Error unreadable(const std::string& name, const std::string& reason) {
  std::string line = reason.substr(0, reason.find('\n'));
  return Error(ErrorKind::cannot_read, name,
               fmt::format("is truncated or damaged ({}); copy or export it again",
                           line.empty() ? "the decoder gave up" : line));
}

Depth depth_of(const std::string& name, const RasterInfo& info) {
  switch (info.samples) {
  case SampleType::u8:
    return Depth::u8;
  case SampleType::u16:
  case SampleType::u32:
    return Depth::u16;
  case SampleType::f16:
    return Depth::f16;
  case SampleType::f32:
  case SampleType::f64:
    return Depth::f32;
  case SampleType::other:
    break;
  }
  throw Error(ErrorKind::invalid_content, name,
              fmt::format("has {} samples; convert them to unsigned integers or floats", info.sample_name));
}

bool is_float(Depth depth) {
  return depth == Depth::f16 || depth == Depth::f32;
}

ImageHeader checked_header(const std::string& name, const RasterInfo& info) {
  if (info.deep) throw Error(ErrorKind::invalid_content, name, "holds deep samples; flatten it to one layer");
  if (info.channels < 1 || info.channels > 4)
    throw Error(ErrorKind::invalid_content, name,
                fmt::format("has {} channels; 1 to 4 are allowed: keep the ones that belong to one map",
                            info.channels));
  if (info.width < 1 || info.height < 1 || info.depth > 1 || info.width > max_image_side ||
      info.height > max_image_side)
    throw Error(ErrorKind::invalid_content, name,
                fmt::format("is {} x {} x {} texels; each side may be 1 to {}, and the depth 1", info.width,
                            info.height, info.depth, max_image_side));
  ImageHeader header;
  header.size = {static_cast<int>(info.width), static_cast<int>(info.height)};
  header.channels = info.channels;
  header.depth = depth_of(name, info);
  header.encoding = info.encoding.value_or(is_float(header.depth) ? Encoding::linear : Encoding::srgb);
  return header;
}

Source open(const std::filesystem::path& file, ImageFormat format) {
  Source source;
  source.name = file.string();
  source.reader = format == ImageFormat::png
                      ? open_png(file)
                      : static_cast<const ImageFunctions*>(openimageio_symbol("tilepack_image_functions"))
                            ->open(file, format);
  source.header = checked_header(source.name, source.reader.info);
  return source;
}

// Dividing, not multiplying by a rounded reciprocal: 255 codes of 8 bits would differ in their last bit.
void append_as_floats(std::span<const std::byte> raw, SampleType type, Texels& to) {
  const auto append = [&]<typename T>(T, auto&& as_float) {
    const std::size_t count = raw.size() / sizeof(T), start = to.size();
    to.resize(start + count);
    for (std::size_t i = 0; i < count; ++i) {
      T value;
      std::memcpy(&value, raw.data() + i * sizeof(T), sizeof(T));
      to[start + i] = as_float(value);
    }
  };
  switch (type) {
  case SampleType::u8:
    return append(std::uint8_t{}, [](std::uint8_t v) { return static_cast<float>(v) / 255.0f; });
  case SampleType::u16:
    return append(std::uint16_t{}, [](std::uint16_t v) { return static_cast<float>(v) / 65535.0f; });
  case SampleType::u32: // to the nearest 16-bit code
    return append(std::uint32_t{}, [](std::uint32_t v) {
      const std::uint64_t code = (std::uint64_t{v} * 65535u + 0x7FFFFFFFu) / 0xFFFFFFFFu;
      return static_cast<float>(code) / 65535.0f;
    });
  case SampleType::f16:
    return append(std::uint16_t{}, [](std::uint16_t v) {
      half h;
      h.setBits(v);
      return static_cast<float>(h);
    });
  case SampleType::f64:
    return append(double{}, [](double v) { return static_cast<float>(v); });
  default:
    return append(float{}, [](float v) { return v; });
  }
}

void check_finite(const Source& source, const Texels& values, std::size_t from) {
  const auto bad = std::find_if(values.begin() + static_cast<std::ptrdiff_t>(from), values.end(),
                                [](float v) { return !std::isfinite(v); });
  if (bad == values.end()) return;
  const std::size_t index = static_cast<std::size_t>(bad - values.begin());
  const std::size_t channels = static_cast<std::size_t>(source.header.channels);
  const std::size_t width = static_cast<std::size_t>(source.header.size.width);
  throw Error(ErrorKind::invalid_content, source.name,
              fmt::format("channel {} of texel ({}, {}) is {}; only finite values are allowed: repair or "
                          "repaint it",
                          source.reader.info.channel_names[index % channels], index / channels % width,
                          index / channels / width, *bad));
}

int rows_per_band(const Source& source, std::size_t row_bytes) {
  const RasterInfo& info = source.reader.info;
  const bool tiled = info.tile_width > 0;
  // Compressed files are decoded in strips; a band of whole strips decodes none twice.
  const int height = source.header.size.height;
  const int strip = std::clamp(tiled ? info.tile_height : info.strip_rows, 1, height);
  const std::size_t strip_bytes = row_bytes * static_cast<std::size_t>(strip);
  if (tiled) {
    const std::size_t tile_bytes = static_cast<std::size_t>(info.tile_width) *
                                   static_cast<std::size_t>(info.tile_height) *
                                   static_cast<std::size_t>(info.channels) * size_of(info.samples);
    if (std::max(strip_bytes, tile_bytes) > max_band_bytes)
      throw Error(ErrorKind::invalid_content, source.name,
                  fmt::format("is stored in tiles of {} x {}; a row of tiles may take {} MiB: store it in "
                              "smaller tiles",
                              info.tile_width, info.tile_height, max_band_bytes >> 20));
  }
  std::size_t rows = std::max<std::size_t>(1, band_bytes / row_bytes);
  if (tiled || strip_bytes <= max_strip_bytes)
    rows = std::max<std::size_t>(1, band_bytes / strip_bytes) * static_cast<std::size_t>(strip);
  return static_cast<int>(std::min<std::size_t>(static_cast<std::size_t>(height), rows));
}

Image decode(const Source& source) {
  const RasterInfo& info = source.reader.info;
  const ImageHeader& header = source.header;
  const std::size_t row_values =
      static_cast<std::size_t>(header.size.width) * static_cast<std::size_t>(header.channels);
  const std::size_t row_bytes = row_values * size_of(info.samples);
  const int band_rows = rows_per_band(source, row_bytes);

  Texels values;
  values.reserve(row_values * static_cast<std::size_t>(header.size.height)); // address space, not yet memory
  std::vector<std::byte> band(row_bytes * static_cast<std::size_t>(band_rows));
  for (int y = 0; y < header.size.height; y += band_rows) {
    const int rows = std::min(band_rows, header.size.height - y);
    const auto texels = std::span(band).first(row_bytes * static_cast<std::size_t>(rows));
    source.reader.read(y, rows, texels);
    const std::size_t before = values.size();
    append_as_floats(texels, info.samples, values);
    if (is_float(header.depth)) check_finite(source, values, before);
  }
  return Image(header.size, header.channels, std::move(values));
}

/// Runs `f` and turns what a decoder throws into the errors promised.
template <typename F>
auto guarded(const std::filesystem::path& file, F&& f) {
  try {
    return f();
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw Error(ErrorKind::cannot_read, file.string(), "does not fit in memory; crop or shrink it");
  } catch (const std::exception& e) {
    throw unreadable(file.string(), e.what());
  }
}

} // namespace

ImageHeader read_image_header(const std::filesystem::path& file) {
  return guarded(file, [&] { return open(file, image_format(file)).header; });
}

ImageFile read_image(const std::filesystem::path& file, std::optional<Encoding> asked) {
  return guarded(file, [&] {
    const ImageFormat format = image_format(file);
    check_complete(file, format);
    const Source source = open(file, format);
    Image image = decode(source);
    return ImageFile{std::move(image), asked.value_or(source.header.encoding), source.header.depth};
  });
}

} // namespace tilepack
