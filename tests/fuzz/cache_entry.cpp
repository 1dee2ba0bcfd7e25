// What batch keeps: heads of cached outputs and records of what was built. What is taken for one is written as it was read.

#include "tilepack/batch/build_record.h"
#include "tilepack/batch/cache_head.h"

#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string text(reinterpret_cast<const char*>(data), size);
  const auto check_head = [](const std::string& head) {
    const auto read = tilepack::parsed_cache_head(head);
    if (read && tilepack::cache_head_text(read->files) != head.substr(0, read->head_size)) __builtin_trap();
  };
  check_head(text);
  // The hash in it keeps out nearly all that is tried: a list with the hash that goes with it is read on.
  const std::string_view magic = "tilepack-cache-1\n";
  check_head(std::string(magic) + tilepack::hex(tilepack::hash_of(text)) + "\n" +
             std::to_string(text.size()) + "\n" + text);
  if (const auto record = tilepack::parsed_record(text))
    if (tilepack::parsed_record(tilepack::record_text(*record)) != record) __builtin_trap();
  return 0;
}
