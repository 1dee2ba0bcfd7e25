#include "image_functions.h"
#include "texture_functions.h"

// What the program looks up by name; all else in this library is hidden.
#define TILEPACK_MODULE_SYMBOL extern "C" [[gnu::visibility("default")]]

TILEPACK_MODULE_SYMBOL const char tilepack_module_version[];
TILEPACK_MODULE_SYMBOL const tilepack::ImageIo tilepack_image_io;
TILEPACK_MODULE_SYMBOL const tilepack::TextureSystem tilepack_texture_system;
TILEPACK_MODULE_SYMBOL int tilepack_warm_up() noexcept;

const char tilepack_module_version[] = TILEPACK_VERSION;
const tilepack::ImageIo tilepack_image_io{tilepack::open_image, tilepack::create_exr};
const tilepack::TextureSystem tilepack_texture_system{tilepack::texture_maker, tilepack::maketx,
                                                      tilepack::open_texture};

// Starts what reading and writing start, and takes the memory a small image does. 0 if all went well.
int tilepack_warm_up() noexcept {
  try {
    tilepack::warm_up();
    return 0;
  } catch (...) {
    return 1;
  }
}

namespace tilepack {

std::string_view openimageio_name(ImageFormat format) {
  switch (format) {
  case ImageFormat::png:
    return "png";
  case ImageFormat::jpeg:
    return "jpeg";
  case ImageFormat::tiff:
    return "tiff";
  case ImageFormat::tga:
    return "targa";
  case ImageFormat::bmp:
    return "bmp";
  case ImageFormat::webp:
    return "webp";
  case ImageFormat::hdr:
    return "hdr";
  case ImageFormat::jpeg2000:
    return "jpeg2000";
  case ImageFormat::dds:
    return "dds";
  case ImageFormat::psd:
    return "psd";
  case ImageFormat::exr:
    break;
  }
  return "openexr";
}

} // namespace tilepack
