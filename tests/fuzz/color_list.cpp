// The colors of tiles drawn by hand: any text is a list or an Error.

#include "tilepack/bake/hand_drawn_set.h"
#include "tilepack/error/error.h"

#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    tilepack::parsed_color_list({reinterpret_cast<const char*>(data), size}, "colors.json");
  } catch (const tilepack::Error&) {
  }
  return 0;
}
