#include "tilepack/error/error.h"
#include "tilepack/numeric/random.h"
#include "tilepack/pack/pack_folder.h"
#include "tilepack/shader/shader_text.h"

#include <array>
#include <cstring>
#include <fstream>
#include <sstream>

namespace tilepack {
namespace {

void hash_stream(std::uint64_t& hash, std::istream& stream, const std::string& name) {
  std::array<char, 65536> bytes{};
  std::uint64_t length = 0;
  while (stream) {
    bytes.fill(0);
    stream.read(bytes.data(), bytes.size());
    const auto count = static_cast<std::size_t>(stream.gcount());
    for (std::size_t at = 0; at < count; at += 8) {
      std::uint64_t word = 0;
      for (std::size_t i = 0; i < 8; ++i) // the same on machines of either order of bytes
        word |= std::uint64_t{static_cast<unsigned char>(bytes[at + i])} << (8 * i);
      hash = mixed(hash ^ word) + 1;
    }
    length += count;
  }
  if (!stream.eof()) throw Error(ErrorKind::cannot_read, name, "can't be read");
  hash = mixed(hash ^ length) + 1;
}

} // namespace

std::uint64_t pack_content_hash(const std::filesystem::path& folder_or_json) {
  return reading_pack(folder_or_json, [](const PackFolder& folder) {
    std::uint64_t hash = 0;
    std::istringstream json(folder.json_text());
    hash_stream(hash, json, folder.json_path().string());
    for (const std::string& name : folder.description().all_files()) {
      std::ifstream file(folder.file(name), std::ios::binary);
      hash_stream(hash, file, name);
    }
    return hash;
  });
}

} // namespace tilepack
