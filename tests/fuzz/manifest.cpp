// A manifest: any text is a list of entries or an Error with its line. Patterns look into an empty folder.

#include "tilepack/batch/manifest.h"

#include "tilepack/error/error.h"
#include "tilepack/json/json_line.h"

#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string>
#include <unistd.h>

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  std::string folder = "/tmp/tilepack_fuzz_" + std::string(6, 'X');
  return mkdtemp(folder.data()) != nullptr && chdir(folder.c_str()) == 0 && rmdir(folder.c_str()) == 0 ? 0
                                                                                                       : 1;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  if (text.find("..") != std::string::npos || text.find("\"/") != std::string::npos ||
      text.find("\\u") != std::string::npos)
    return 0; // would look through the folders of this machine
  try {
    const tilepack::Manifest manifest = tilepack::parsed_manifest(text, "m.json");
    for (const tilepack::BatchEntry& entry : manifest.entries) {
      if (entry.output.empty() || entry.name.empty()) __builtin_trap();
      tilepack::place_in(manifest, entry.at);
      try {
        if (entry.verb->name == "bake") tilepack::bake_job_of(manifest, entry);
      } catch (const tilepack::Error&) {
      }
    }
  } catch (const tilepack::Error& error) {
    const auto lines = std::make_shared<const tilepack::JsonLines>(text);
    tilepack::place_in({"m.json", text, {}, {}, lines}, error.what_happened());
  }
  return 0;
}
