#include "image_functions.h"
#include "texture_functions.h"

// What the program looks up by name; all else in this library is hidden.
#define TILEPACK_MODULE_SYMBOL extern "C" [[gnu::visibility("default")]]

TILEPACK_MODULE_SYMBOL const char tilepack_module_version[];
TILEPACK_MODULE_SYMBOL const tilepack::ImageFunctions tilepack_image_functions;
TILEPACK_MODULE_SYMBOL const tilepack::TextureFunctions tilepack_texture_functions;

const char tilepack_module_version[] = TILEPACK_VERSION;
const tilepack::ImageFunctions tilepack_image_functions{tilepack::open_image, tilepack::create_exr};
const tilepack::TextureFunctions tilepack_texture_functions{tilepack::texture_maker, tilepack::maketx,
                                                            tilepack::open_texture};

namespace tilepack {

std::string_view openimageio_name(ImageFormat format) {
  switch (format) {
  case ImageFormat::png:
    return "png";
  case ImageFormat::jpeg:
    return "jpeg";
  case ImageFormat::tiff:
    return "tiff";
  case ImageFormat::exr:
    break;
  }
  return "openexr";
}

} // namespace tilepack
