// pack.json: any text is a pack description or an Error.

#include "tilepack/pack/pack_json.h"

#include "tilepack/error/error.h"

#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const auto pack = tilepack::parsed_pack_json({reinterpret_cast<const char*>(data), size}, "pack.json");
    for (const std::string& file : pack.all_files())
      if (file.empty() || file.front() == '/') __builtin_trap(); // leads out of the folder
  } catch (const tilepack::Error&) {
  }
  return 0;
}
