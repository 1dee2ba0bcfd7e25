#include "tilepack/image/openimageio_module.h"

#include "tilepack/error/error.h"

#include <fmt/format.h>

#include <cstring>
#include <dlfcn.h>

namespace tilepack {
namespace {

void* loaded_module() {
  // Never unloaded: OpenImageIO keeps threads. Its symbols are nobody else's business.
  void* module = ::dlopen(openimageio_module_name, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
  if (!module)
    throw Error(ErrorKind::internal, openimageio_module_name,
                fmt::format("reads and writes JPEG, TIFF and EXR files and cannot be loaded ({}); install "
                            "tilepack again, name the library's folder in LD_LIBRARY_PATH, or use PNG",
                            ::dlerror()));
  const auto* version = static_cast<const char*>(::dlsym(module, "tilepack_module_version"));
  if (!version || std::strcmp(version, TILEPACK_VERSION) != 0)
    throw Error(ErrorKind::internal, openimageio_module_name,
                fmt::format("is of version {}, the program of {}; install tilepack again",
                            version ? version : "unknown", TILEPACK_VERSION));
  return module;
}

} // namespace

void* openimageio_symbol(const char* name) {
  static void* const module = loaded_module();
  void* symbol = ::dlsym(module, name);
  if (!symbol)
    throw Error(ErrorKind::internal, openimageio_module_name,
                fmt::format("lacks {}; install tilepack again", name));
  return symbol;
}

} // namespace tilepack
