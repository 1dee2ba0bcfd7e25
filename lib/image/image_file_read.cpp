#include "tilepack/error/error.h"
#include "tilepack/image/image_file.h"
#include "tilepack/image/image_format.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <Imath/half.h>
#include <algorithm>
#include <array>
#include <bit>
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
  std::unique_ptr<OIIO::ImageInput> input;
  OIIO::ImageSpec spec;
  ImageHeader header;
};

Error unreadable(const std::string& name, const std::string& reason) {
  std::string line = reason.substr(0, reason.find('\n'));
  return Error(ErrorKind::cannot_read, name,
               fmt::format("is truncated or damaged ({}); copy or export it again",
                           line.empty() ? "the decoder gave up" : line));
}

Depth depth_of(const Source& source) {
  switch (source.spec.format.basetype) {
  case OIIO::TypeDesc::UINT8:
    return Depth::u8;
  case OIIO::TypeDesc::UINT16:
  case OIIO::TypeDesc::UINT32:
    return Depth::u16;
  case OIIO::TypeDesc::HALF:
    return Depth::f16;
  case OIIO::TypeDesc::FLOAT:
  case OIIO::TypeDesc::DOUBLE:
    return Depth::f32;
  default:
    throw Error(ErrorKind::invalid_content, source.name,
                fmt::format("has {} samples; convert them to unsigned integers or floats",
                            source.spec.format.c_str()));
  }
}

Encoding encoding_of(const Source& source, ImageFormat format) {
  if (format == ImageFormat::exr) return Encoding::linear;
  const std::string space = source.spec.get_string_attribute("oiio:ColorSpace");
  if (OIIO::Strutil::iequals(space, "linear")) return Encoding::linear;
  if (!space.empty()) return Encoding::srgb; // also "Gamma2.2", which sRGB is close to
  return source.header.depth == Depth::f16 || source.header.depth == Depth::f32 ? Encoding::linear
                                                                                : Encoding::srgb;
}

Source open(const std::filesystem::path& file, ImageFormat format) {
  Source source;
  source.name = file.string();
  // By format, not by name: a PNG called "photo.jpg" is read, and OpenImageIO's formats without a file
  // ("x.null") are out of reach.
  source.input = OIIO::ImageInput::create(std::string(name_of(format)));
  if (!source.input) throw Error(ErrorKind::internal, source.name, OIIO::geterror());
  OIIO::ImageSpec wishes;
  wishes.attribute("oiio:UnassociatedAlpha", 1); // alpha as stored
  if (!source.input->open(source.name, source.spec, wishes))
    throw unreadable(source.name, source.input->geterror());

  const OIIO::ImageSpec& spec = source.spec;
  if (spec.deep)
    throw Error(ErrorKind::invalid_content, source.name, "holds deep samples; flatten it to one layer");
  if (spec.nchannels < 1 || spec.nchannels > 4)
    throw Error(ErrorKind::invalid_content, source.name,
                fmt::format("has {} channels; 1 to 4 are allowed: keep the ones that belong to one map",
                            spec.nchannels));
  if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || spec.width > max_image_side ||
      spec.height > max_image_side)
    throw Error(ErrorKind::invalid_content, source.name,
                fmt::format("is {} x {} x {} texels; each side may be 1 to {}, and the depth 1", spec.width,
                            spec.height, spec.depth, max_image_side));
  source.header.size = {spec.width, spec.height};
  source.header.channels = spec.nchannels;
  source.header.depth = depth_of(source);
  source.header.encoding = encoding_of(source, format);
  return source;
}

// Dividing, not multiplying by a rounded reciprocal: 255 codes of 8 bits would differ in their last bit.
void append_as_floats(std::span<const std::byte> raw, OIIO::TypeDesc::BASETYPE type, std::vector<float>& to) {
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
  case OIIO::TypeDesc::UINT8:
    return append(std::uint8_t{}, [](std::uint8_t v) { return static_cast<float>(v) / 255.0f; });
  case OIIO::TypeDesc::UINT16:
    return append(std::uint16_t{}, [](std::uint16_t v) { return static_cast<float>(v) / 65535.0f; });
  case OIIO::TypeDesc::UINT32: // to the nearest 16-bit code
    return append(std::uint32_t{}, [](std::uint32_t v) {
      const std::uint64_t code = (std::uint64_t{v} * 65535u + 0x7FFFFFFFu) / 0xFFFFFFFFu;
      return static_cast<float>(code) / 65535.0f;
    });
  case OIIO::TypeDesc::HALF:
    return append(std::uint16_t{}, [](std::uint16_t v) {
      half h;
      h.setBits(v);
      return static_cast<float>(h);
    });
  case OIIO::TypeDesc::DOUBLE:
    return append(double{}, [](double v) { return static_cast<float>(v); });
  default:
    return append(float{}, [](float v) { return v; });
  }
}

void check_finite(const Source& source, const std::vector<float>& values, std::size_t from) {
  const auto bad = std::find_if(values.begin() + static_cast<std::ptrdiff_t>(from), values.end(),
                                [](float v) { return !std::isfinite(v); });
  if (bad == values.end()) return;
  const std::size_t index = static_cast<std::size_t>(bad - values.begin());
  const std::size_t channels = static_cast<std::size_t>(source.header.channels);
  const std::size_t width = static_cast<std::size_t>(source.header.size.width);
  throw Error(ErrorKind::invalid_content, source.name,
              fmt::format("channel {} of texel ({}, {}) is {}; only finite values are allowed: repair or "
                          "repaint it",
                          source.spec.channelnames[index % channels], index / channels % width,
                          index / channels / width, *bad));
}

int rows_per_band(const Source& source, std::size_t row_bytes) {
  const OIIO::ImageSpec& spec = source.spec;
  const bool tiled = spec.tile_width > 0;
  // Compressed files are decoded in strips; a band of whole strips decodes none twice.
  const int strip =
      std::clamp(tiled ? spec.tile_height : spec.get_int_attribute("tiff:RowsPerStrip", 32), 1, spec.height);
  const std::size_t strip_bytes = row_bytes * static_cast<std::size_t>(strip);
  if (tiled) {
    const std::size_t tile_bytes = static_cast<std::size_t>(spec.tile_width) *
                                   static_cast<std::size_t>(spec.tile_height) * spec.pixel_bytes();
    if (std::max(strip_bytes, tile_bytes) > max_band_bytes)
      throw Error(ErrorKind::invalid_content, source.name,
                  fmt::format("is stored in tiles of {} x {}; a row of tiles may take {} MiB: store it in "
                              "smaller tiles",
                              spec.tile_width, spec.tile_height, max_band_bytes >> 20));
  }
  std::size_t rows = std::max<std::size_t>(1, band_bytes / row_bytes);
  if (tiled || strip_bytes <= max_strip_bytes)
    rows = std::max<std::size_t>(1, band_bytes / strip_bytes) * static_cast<std::size_t>(strip);
  return static_cast<int>(std::min<std::size_t>(static_cast<std::size_t>(spec.height), rows));
}

Image decode(Source& source) {
  const OIIO::ImageSpec& spec = source.spec;
  const OIIO::TypeDesc type(static_cast<OIIO::TypeDesc::BASETYPE>(spec.format.basetype));
  const std::size_t row_values =
      static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.nchannels);
  const std::size_t row_bytes = row_values * type.size();
  const int band_rows = rows_per_band(source, row_bytes);

  std::vector<float> values;
  values.reserve(row_values * static_cast<std::size_t>(spec.height)); // address space, not yet memory
  std::vector<std::byte> band(row_bytes * static_cast<std::size_t>(band_rows));
  const bool floats = source.header.depth == Depth::f16 || source.header.depth == Depth::f32;
  for (int y = 0; y < spec.height; y += band_rows) {
    const int rows = std::min(band_rows, spec.height - y);
    const int top = spec.y + y, bottom = top + rows;
    const bool ok =
        spec.tile_width > 0
            ? source.input->read_tiles(0, 0, spec.x, spec.x + spec.width, top, bottom, spec.z, spec.z + 1, 0,
                                       spec.nchannels, type, band.data())
            : source.input->read_scanlines(0, 0, top, bottom, spec.z, 0, spec.nchannels, type, band.data());
    // A decoder may report a cut file and yet call the reading a success.
    if (!ok || source.input->has_error()) throw unreadable(source.name, source.input->geterror());
    const std::size_t before = values.size();
    append_as_floats(std::span(band).first(row_bytes * static_cast<std::size_t>(rows)),
                     static_cast<OIIO::TypeDesc::BASETYPE>(type.basetype), values);
    if (floats) check_finite(source, values, before);
  }
  return Image(source.header.size, source.header.channels, std::move(values));
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
    Source source = open(file, format);
    Image image = decode(source);
    return ImageFile{std::move(image), asked.value_or(source.header.encoding), source.header.depth};
  });
}

} // namespace tilepack
