#include "tilepack/image/icc_profile.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace tilepack {
namespace {

std::uint32_t number(std::span<const std::byte> bytes, std::size_t at, std::size_t count) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < count; ++i) value = value << 8 | std::to_integer<std::uint32_t>(bytes[at + i]);
  return value;
}

std::string_view text(std::span<const std::byte> bytes, std::size_t at) {
  return {reinterpret_cast<const char*>(bytes.data()) + at, 4};
}

// "curv" with no entry is the identity, with one an exponent in 8.8, with many samples of 16 bits; "para" of
// type 0 an exponent in 15.16.
bool is_identity(std::span<const std::byte> curve) {
  if (curve.size() < 12) return false;
  if (text(curve, 0) == "para")
    return curve.size() >= 16 && number(curve, 8, 2) == 0 && number(curve, 12, 4) == 0x10000;
  if (text(curve, 0) != "curv") return false;
  const std::size_t count = number(curve, 8, 4);
  if (count == 0) return true;
  if (count == 1) return curve.size() >= 14 && number(curve, 12, 2) == 0x100;
  if (count > (curve.size() - 12) / 2) return false;
  const std::uint32_t middle = number(curve, 12 + (count - 1) / 2 * 2, 2);
  const double expected = 65535.0 * static_cast<double>((count - 1) / 2) / static_cast<double>(count - 1);
  return middle > expected - 256 && middle < expected + 256;
}

} // namespace

std::optional<Encoding> encoding_of_profile(std::span<const std::byte> profile) {
  constexpr std::size_t header = 128;
  if (profile.size() < header + 4 || text(profile, 36) != "acsp") return {};
  const std::size_t tags = number(profile, header, 4);
  for (std::size_t i = 0; i < tags && header + 4 + (i + 1) * 12 <= profile.size(); ++i) {
    const std::size_t entry = header + 4 + i * 12;
    const std::string_view tag = text(profile, entry);
    if (tag != "rTRC" && tag != "kTRC") continue;
    const std::size_t at = number(profile, entry + 4, 4), length = number(profile, entry + 8, 4);
    if (at > profile.size() || length > profile.size() - at) return {};
    return is_identity(profile.subspan(at, length)) ? Encoding::linear : Encoding::srgb;
  }
  return {};
}

} // namespace tilepack
