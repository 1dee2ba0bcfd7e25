// A preset: any text is settings within their ranges or an Error.

#include "tilepack/bake/preset.h"

#include "tilepack/error/error.h"

#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const auto preset =
        tilepack::parsed_preset({reinterpret_cast<const char*>(data), size}, "fuzzed", "fuzzed.json");
    tilepack::bake_options(preset.settings);
  } catch (const tilepack::Error&) {
  }
  return 0;
}
