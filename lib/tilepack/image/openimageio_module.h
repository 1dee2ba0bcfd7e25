#pragma once

#include "tilepack/image/image_format.h"
#include "tilepack/image/raster.h"

#include <filesystem>

namespace tilepack {

/// The file name of the private shared library that holds all of tilepack that stands on OpenImageIO: image
/// files other than PNG, and what other rooms ask of it. It is built with the same compiler and flags as the
/// program, and exports tables of functions.
///
/// OpenImageIO brings some 250 shared libraries, whose loading takes longer than baking a pack from PNG to
/// PNG. So it is loaded when first needed, by this name alone: the loader looks along the RUNPATH of the
/// program (the build tree's, the installed program's, and the one that find_package(tilepack) gives to what
/// links with it), then in LD_LIBRARY_PATH and the system's folders.
constexpr const char* openimageio_module_name = "libtilepack_openimageio.so";

/// A symbol of the module, which is loaded on the first call, by any thread. Throws Error (internal) if it is
/// not found, of another version, or can't start in the memory and with the processes that are allowed.
const void* openimageio_symbol(const char* name);

/// A table of the module by its type, which names its symbol as Table::symbol.
template <typename Table>
const Table& openimageio() {
  return *static_cast<const Table*>(openimageio_symbol(Table::symbol));
}

/// What the module can do with image files.
struct ImageIo {
  static constexpr const char* symbol = "tilepack_image_io";

  RasterReader (*open)(const std::filesystem::path& file, ImageFormat format);
  /// An EXR of half or float (f16, f32), in linear light.
  RasterWriter (*create_exr)(ByteSink sink, Size size, int channels, Depth depth);
};

} // namespace tilepack
