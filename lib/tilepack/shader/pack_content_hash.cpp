#include "tilepack/error/error.h"
#include "tilepack/numeric/random.h"
#include "tilepack/pack/pack_folder_read.h"
#include "tilepack/pack/pack_read.h"
#include "tilepack/shader/shader_text.h"

#include <array>
#include <cstring>
#include <fstream>

namespace tilepack {
namespace {

void hash_file(std::uint64_t& hash, const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
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
  if (!stream.eof()) throw Error(ErrorKind::cannot_read, file.string(), "can't be read");
  hash = mixed(hash ^ length) + 1;
}

} // namespace

std::uint64_t pack_content_hash(const std::filesystem::path& folder_or_json) {
  const std::filesystem::path json = pack_json_of(folder_or_json);
  std::uint64_t hash = 0;
  hash_file(hash, json);
  for (const std::string& file : read_pack_description(folder_or_json).all_files())
    hash_file(hash, folder_of(json) / file);
  return hash;
}

} // namespace tilepack
