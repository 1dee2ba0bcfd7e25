#include "tilepack/numeric/random.h"

namespace tilepack {

std::uint64_t mixed(std::uint64_t word) {
  word ^= word >> 30;
  word *= 0xbf58476d1ce4e5b9u;
  word ^= word >> 27;
  word *= 0x94d049bb133111ebu;
  word ^= word >> 31;
  return word;
}

std::uint64_t random_bits(std::uint64_t seed, std::string_view purpose, std::uint64_t index) {
  std::uint64_t word = 0x9e3779b97f4a7c15u;
  for (const char letter : purpose) word = mixed(word ^ static_cast<unsigned char>(letter));
  word = mixed(word ^ seed);
  return mixed(mixed(word + 0x9e3779b97f4a7c15u) ^ mixed(index + 0x9e3779b97f4a7c15u));
}

std::uint32_t random_below(std::uint64_t seed, std::string_view purpose, std::uint64_t index,
                           std::uint32_t count) {
  const std::uint64_t high = random_bits(seed, purpose, index) >> 32;
  return static_cast<std::uint32_t>((high * count) >> 32);
}

} // namespace tilepack
