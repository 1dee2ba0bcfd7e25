// pack.json: any text is a pack description or an Error.

#include "tilepack/pack/pack_json.h"

#include "tilepack/error/error.h"

#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const auto pack = tilepack::parsed_pack_json({reinterpret_cast<const char*>(data), size}, "pack.json");
    for (const auto& map : pack.map_files)
      for (const auto& texture : map)
        if (texture.file.empty() || texture.file.front() == '/') __builtin_trap(); // leads out of the folder
  } catch (const tilepack::Error&) {
  }
  return 0;
}
