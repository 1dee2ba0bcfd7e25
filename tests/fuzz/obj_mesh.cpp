// A Wavefront OBJ: any text is triangles with finite numbers or an Error with its line.

#include "tilepack/error/error.h"
#include "tilepack/scanline/mesh.h"

#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    if (tilepack::parse_obj({reinterpret_cast<const char*>(data), size}, "mesh.obj", 2.0).empty())
      __builtin_trap();
  } catch (const tilepack::Error&) {
  }
  return 0;
}
