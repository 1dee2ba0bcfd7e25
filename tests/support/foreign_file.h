#pragma once

#include "tilepack/image/image.h"

#include <OpenImageIO/deepdata.h>
#include <OpenImageIO/imageio.h>

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

/// Writes `image` as other programs do, with whatever attributes `spec` asks for: formats, tilings and
/// compressions that tilepack itself never writes. `format`: "png", "jpeg", "tiff", "openexr".
inline void write_foreign(const std::filesystem::path& file, const std::string& format,
                          const tilepack::Image& image, OIIO::TypeDesc stored, OIIO::ImageSpec spec = {}) {
  spec.width = spec.full_width = image.width();
  spec.height = spec.full_height = image.height();
  spec.depth = spec.full_depth = 1;
  spec.nchannels = image.channels();
  spec.default_channel_names();
  spec.set_format(stored);
  auto output = OIIO::ImageOutput::create(format);
  if (!output || !output->open(file.string(), spec) ||
      !output->write_image(OIIO::TypeDesc::FLOAT, image.data().data()) || !output->close())
    throw std::runtime_error("cannot write " + file.string());
}

/// The bytes that pairs of hexadecimal digits spell.
inline std::string from_hex(std::string_view digits) {
  std::string bytes;
  for (std::size_t i = 0; i + 1 < digits.size(); i += 2)
    bytes += static_cast<char>(std::stoi(std::string(digits.substr(i, 2)), nullptr, 16));
  return bytes;
}
