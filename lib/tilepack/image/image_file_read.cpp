#include "tilepack/error/error.h"
#include "tilepack/image/channel_choice.h"
#include "tilepack/image/icc_profile.h"
#include "tilepack/image/image_file.h"
#include "tilepack/image/image_format.h"
#include "tilepack/image/openimageio_module.h"
#include "tilepack/image/orientation.h"
#include "tilepack/image/png_file.h"

#include <fmt/format.h>

#include <Imath/half.h>
#include <algorithm>
#include <array>
#include <cerrno>
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
  ChannelChoice choice;
  ImageHeader header;
};

// Beyond this, rows of all channels would take more memory than the image.
constexpr int most_file_channels = 1024;

Error unreadable(const std::string& name, const std::string& reason) {
  std::string line = reason.substr(0, reason.find('\n'));
  for (const int lack : {EMFILE, ENFILE, ENOMEM}) // of what the process may have, and no fault of the file
    if (line.find(std::strerror(lack)) != std::string::npos)
      return Error(ErrorKind::internal, name, "can't be opened: " + line);
  if (line.find("ubsampled channels") != std::string::npos) // OpenImageIO's word for it
    return Error(
        ErrorKind::invalid_content, name,
        "stores channels at a lower resolution than others (luminance and chroma, as a rule); convert "
        "it to R, G and B");
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

ChannelChoice chosen_channels(const std::string& name, const RasterInfo& info, const ReadOptions& options) {
  if (info.deep) throw Error(ErrorKind::invalid_content, name, "holds deep samples; flatten it to one layer");
  if (info.channels < 1 || info.channels > most_file_channels)
    throw Error(ErrorKind::invalid_content, name,
                fmt::format("has {} channels; 1 to 4 are allowed: keep the ones that belong to one map",
                            info.channels));
  if (!options.channels.empty()) return channels_asked(options.channels, info.channel_names, name);
  if (info.names_are_free) return channels_by_name(info.channel_names, name);
  if (info.channels > 4)
    throw Error(ErrorKind::invalid_content, name,
                fmt::format("has {} channels; 1 to 4 are allowed: choose those of one map with {}",
                            info.channels, field("channels", "R,G,B")));
  ChannelChoice choice;
  for (int c = 0; c < info.channels; ++c) choice.from.push_back(c);
  choice.alpha = info.alpha_channel;
  return choice;
}

ImageHeader checked_header(const std::string& name, const RasterInfo& info, const ChannelChoice& choice,
                           const ReadOptions& options) {
  if (info.width < 1 || info.height < 1 || info.depth > 1 || info.width > max_image_side ||
      info.height > max_image_side)
    throw Error(ErrorKind::invalid_content, name,
                fmt::format("is {} x {} x {} texels; each side may be 1 to {}, and the depth 1", info.width,
                            info.height, info.depth, max_image_side));
  ImageHeader header;
  header.size = {static_cast<int>(info.width), static_cast<int>(info.height)};
  if (swaps_sides(info.orientation)) std::swap(header.size.width, header.size.height);
  header.channels = static_cast<int>(choice.from.size());
  header.depth = depth_of(name, info);
  for (const int c : info.whole_numbers)
    if (std::find(choice.from.begin(), choice.from.end(), c) != choice.from.end())
      throw Error(
          ErrorKind::invalid_content, name,
          fmt::format("holds whole numbers in channel {}, which count or name things and have no mean; "
                      "convert it to floats",
                      info.channel_names[static_cast<std::size_t>(c)]));
  header.encoding = info.encoding.value_or(is_float(header.depth) ? Encoding::linear : Encoding::srgb);
  if (const auto stated = encoding_of_profile(info.profile)) header.encoding = *stated;
  header.encoding = options.encoding.value_or(header.encoding);
  return header;
}

void check_texel_count(const std::string& name, const AnnouncedSize& size, int channels,
                       const ReadOptions& options) {
  if (size.width <= options.most_texels / std::max<std::int64_t>(1, size.height)) return;
  constexpr std::int64_t million = 1000000;
  const double texels = static_cast<double>(size.width) * static_cast<double>(size.height);
  throw Error(ErrorKind::invalid_content, name,
              fmt::format("has {} x {} texels, which would take {:.3g} GB of memory; at most {} million are "
                          "read: crop or shrink it, or raise the limit ({})",
                          size.width, size.height, texels * 4e-9 * channels, options.most_texels / million,
                          field("max-texels", fmt::format("{:.0f}", texels))));
}

Source open(const std::filesystem::path& file, ImageFormat format, const ReadOptions& options) {
  Source source;
  source.name = file.string();
  if (const auto size = size_before_decoding(file, format)) check_texel_count(source.name, *size, 3, options);
  source.reader = format == ImageFormat::png ? open_png(file) : openimageio<ImageIo>().open(file, format);
  source.choice = chosen_channels(source.name, source.reader.info, options);
  source.header = checked_header(source.name, source.reader.info, source.choice, options);
  return source;
}

// White as 0, which no decoder of the wider samples turns round.
void invert(std::span<std::byte> raw, SampleType type) {
  const auto each = [&]<typename T>(T) {
    for (std::size_t at = 0; at + sizeof(T) <= raw.size(); at += sizeof(T)) {
      T value;
      std::memcpy(&value, raw.data() + at, sizeof(T));
      value = 1 - value;
      std::memcpy(raw.data() + at, &value, sizeof(T));
    }
  };
  if (type == SampleType::f32) return each(float{});
  if (type == SampleType::f64) return each(double{});
  if (type == SampleType::f16) return;
  for (std::byte& b : raw) b = ~b;
}

// The chosen channels of `raw`, packed to its front.
std::span<const std::byte> picked(std::span<std::byte> raw, const Source& source) {
  const std::vector<int>& from = source.choice.from;
  const auto channels = static_cast<std::size_t>(source.reader.info.channels);
  bool all = from.size() == channels;
  for (std::size_t c = 0; c < from.size(); ++c) all = all && from[c] == static_cast<int>(c);
  if (all) return raw;
  const std::size_t bytes = size_of(source.reader.info.samples), texels = raw.size() / bytes / channels;
  std::array<std::byte, 4 * sizeof(double)> texel{};
  for (std::size_t t = 0; t < texels; ++t) {
    for (std::size_t c = 0; c < from.size(); ++c)
      std::memcpy(texel.data() + c * bytes,
                  raw.data() + (t * channels + static_cast<std::size_t>(from[c])) * bytes, bytes);
    std::memcpy(raw.data() + t * from.size() * bytes, texel.data(), from.size() * bytes);
  }
  return raw.first(texels * from.size() * bytes);
}

// Color that was multiplied by alpha, as it was before: R / A for the nearest value of the depth.
void divide_by_alpha(Image& image, Depth depth) {
  const auto channels = static_cast<std::size_t>(image.channels());
  for (std::size_t at = 0; at + channels <= image.data().size(); at += channels) {
    const float alpha = image.data()[at + channels - 1];
    if (!(alpha > 0.0f)) continue;
    for (std::size_t c = 0; c + 1 < channels; ++c) {
      const float straight = quantised(image.data()[at + c] / alpha, depth);
      if (std::isfinite(straight)) image.data()[at + c] = straight;
    }
  }
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
  const auto width = static_cast<std::size_t>(source.reader.info.width);
  const auto channel = static_cast<std::size_t>(source.choice.from[index % channels]);
  throw Error(ErrorKind::invalid_content, source.name,
              fmt::format("channel {} of texel ({}, {}) is {}; only finite values are allowed: repair or "
                          "repaint it",
                          source.reader.info.channel_names[channel], index / channels % width,
                          index / channels / width, *bad));
}

int rows_per_band(const Source& source, std::size_t row_bytes) {
  const RasterInfo& info = source.reader.info;
  const bool tiled = info.tile_width > 0;
  // Compressed files are decoded in strips; a band of whole strips decodes none twice.
  const int height = static_cast<int>(info.height);
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
  const Size size{static_cast<int>(info.width), static_cast<int>(info.height)}; // not yet upright
  const std::size_t row_bytes =
      static_cast<std::size_t>(size.width) * static_cast<std::size_t>(info.channels) * size_of(info.samples);
  const int band_rows = rows_per_band(source, row_bytes);

  Texels values;
  values.reserve(static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height) *
                 static_cast<std::size_t>(header.channels)); // address space, not yet memory
  std::vector<std::byte> band(row_bytes * static_cast<std::size_t>(band_rows));
  for (int y = 0; y < size.height; y += band_rows) {
    const int rows = std::min(band_rows, size.height - y);
    const auto texels = std::span(band).first(row_bytes * static_cast<std::size_t>(rows));
    source.reader.read(y, rows, texels);
    if (info.white_is_zero) invert(texels, info.samples);
    const std::size_t before = values.size();
    append_as_floats(picked(texels, source), info.samples, values);
    if (is_float(header.depth)) check_finite(source, values, before);
  }
  return Image(size, header.channels, std::move(values));
}

/// Runs `f` and turns what a decoder throws into the errors promised.
template <typename F>
auto guarded(const std::filesystem::path& file, F&& f) {
  try {
    return f();
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& e) {
    throw unreadable(file.string(), e.what());
  }
}

} // namespace

ImageHeader read_image_header(const std::filesystem::path& file, const ReadOptions& options) {
  return guarded(file, [&] { return open(file, image_format(file), options).header; });
}

ImageFile read_image(const std::filesystem::path& file, const ReadOptions& options) {
  return guarded(file, [&] {
    const ImageFormat format = image_format(file);
    check_complete(file, format);
    const Source source = open(file, format, options);
    const ImageHeader& header = source.header;
    check_texel_count(source.name, {header.size.width, header.size.height}, header.channels, options);
    const RasterInfo& info = source.reader.info;
    ImageFile result{upright(decode(source), info.orientation), source.header.encoding, source.header.depth,
                     info.notes};
    if (info.associated_alpha && source.choice.alpha >= 0 && options.alpha == AlphaReading::straight)
      divide_by_alpha(result.image, result.depth);
    if (info.alpha_is_unsaid && source.choice.alpha >= 0)
      result.notes.push_back(fmt::format(
          "doesn't say whether its last channel is alpha; it is taken for alpha that color was not "
          "multiplied by, and {} leaves it out",
          field("channels", info.channels == 4 ? "R,G,B" : info.channel_names.front())));
    if (info.doubtful_linear && !options.encoding)
      result.notes.push_back(
          fmt::format("is taken as linear because of {}; if it looks too bright, its values are sRGB: {}",
                      info.doubtful_linear, field("encoding", "srgb")));
    return result;
  });
}

ImageFile read_image(const std::filesystem::path& file, std::optional<Encoding> asked) {
  ReadOptions options;
  options.encoding = asked;
  return read_image(file, options);
}

} // namespace tilepack
