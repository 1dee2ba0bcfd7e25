#include "tilepack/image/image_format.h"

#include "tilepack/error/error.h"
#include "tilepack/image/file_bytes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace tilepack {
namespace {

bool stands(std::string_view magic, std::span<const unsigned char> bytes, std::size_t at = 0) {
  return at + magic.size() <= bytes.size() &&
         std::equal(magic.begin(), magic.end(), bytes.begin() + static_cast<std::ptrdiff_t>(at),
                    [](char a, unsigned char b) { return static_cast<unsigned char>(a) == b; });
}

std::optional<ImageFormat> format_by_magic(std::span<const unsigned char> head) {
  using namespace std::string_view_literals;
  struct Magic {
    std::string_view bytes;
    ImageFormat format;
  };
  static constexpr Magic magics[] = {
      {"\x89PNG\r\n\x1a\n"sv, ImageFormat::png},
      {"\xFF\xD8\xFF"sv, ImageFormat::jpeg},
      {"\x76\x2F\x31\x01"sv, ImageFormat::exr},
      {"II\x2A\0"sv, ImageFormat::tiff},
      {"MM\0\x2A"sv, ImageFormat::tiff},
      {"II\x2B\0"sv, ImageFormat::tiff},
      {"MM\0\x2B"sv, ImageFormat::tiff},
      {"#?RADIANCE"sv, ImageFormat::hdr},
      {"#?RGBE"sv, ImageFormat::hdr},
      {"\0\0\0\x0CjP  \r\n\x87\n"sv, ImageFormat::jpeg2000},
      {"\xFF\x4F\xFF\x51"sv, ImageFormat::jpeg2000},
      {"DDS "sv, ImageFormat::dds},
      {"8BPS\0\x01"sv, ImageFormat::psd},
      {"8BPS\0\x02"sv, ImageFormat::psd},
  };
  for (const Magic& magic : magics)
    if (stands(magic.bytes, head)) return magic.format;
  if (stands("RIFF", head) && stands("WEBP", head, 8)) return ImageFormat::webp;
  // "BM" alone is how many a text begins.
  if (stands("BM", head) && head.size() >= 18 && little_endian(head.subspan(6, 4)) == 0 &&
      little_endian(head.subspan(14, 4)) <= 124)
    return ImageFormat::bmp;
  return {};
}

// A TGA begins with no mark; files of version 2 end with one. The older ones are known by their name and by a
// header that makes sense.
bool is_tga(const FileBytes& file, const std::filesystem::path& path, std::span<const unsigned char> head) {
  constexpr std::string_view footer("TRUEVISION-XFILE.\0", 18);
  if (head.size() < 18) return false;
  const int palette = head[1], kind = head[2], bits = head[16];
  const bool known_kind = (kind >= 1 && kind <= 3) || (kind >= 9 && kind <= 11);
  const bool sound = palette <= 1 && known_kind &&
                     (bits == 8 || bits == 15 || bits == 16 || bits == 24 || bits == 32) &&
                     little_endian(head.subspan(12, 2)) > 0 && little_endian(head.subspan(14, 2)) > 0;
  if (!sound) return false;
  std::array<unsigned char, 18> tail{};
  if (file.size() >= 18 + 26) file.read(file.size() - tail.size(), tail);
  if (stands(footer, tail)) return true;
  const std::string ending = file_ending(path);
  return ending == ".tga" || ending == ".targa" || ending == ".vda" || ending == ".icb" || ending == ".vst";
}

} // namespace

std::string file_ending(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  for (char& c : ending) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return ending;
}

ImageFormat image_format(const std::filesystem::path& path) {
  const FileBytes file(path);
  if (file.size() == 0)
    throw Error(ErrorKind::cannot_read, path.string(), "is empty (0 bytes); copy or export it again");
  std::array<unsigned char, 32> start{};
  const auto head =
      std::span(start).first(static_cast<std::size_t>(std::min<std::uint64_t>(32, file.size())));
  file.read(0, head);
  if (const auto format = format_by_magic(head)) return *format;
  if (is_tga(file, path, head)) return ImageFormat::tga;
  throw Error(
      ErrorKind::cannot_read, path.string(),
      fmt::format("is no {} image, by its first bytes; convert it to one of these", readable_formats()));
}

std::optional<AnnouncedSize> size_before_decoding(const std::filesystem::path& path, ImageFormat format) {
  if (format != ImageFormat::jpeg2000) return {};
  const FileBytes file(path);
  std::array<unsigned char, 512> start{};
  const auto head =
      std::span(start).first(static_cast<std::size_t>(std::min<std::uint64_t>(start.size(), file.size())));
  file.read(0, head);
  const auto number = [&](std::size_t at) {
    return static_cast<std::int64_t>(big_endian(std::span(start).subspan(at, 4)));
  };
  if (stands("\xFF\x4F\xFF\x51", head)) return AnnouncedSize{number(8), number(12)};
  for (std::size_t at = 0; at + 12 <= head.size(); ++at)
    if (stands("ihdr", head, at)) return AnnouncedSize{number(at + 8), number(at + 4)};
  return {};
}

std::string_view readable_formats() {
  return "PNG, JPEG, TIFF, EXR, TGA, BMP, WebP, HDR, JPEG 2000, DDS or PSD";
}

} // namespace tilepack
