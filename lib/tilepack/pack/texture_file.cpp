#include "tilepack/pack/texture_file.h"

#include "tilepack/pack/image_header_check.h"

#include <fmt/format.h>

#include <stdexcept>

namespace tilepack {
namespace {

void require_one_level(std::size_t levels) {
  if (levels != 1) throw std::logic_error("a PNG or EXR file holds one level");
}

} // namespace

ReadOptions pack_reading(Encoding encoding) {
  ReadOptions options;
  options.encoding = encoding;
  options.alpha = AlphaReading::as_stored;
  return options;
}

int levels_in(std::span<const TextureFile> files) {
  std::size_t levels = 0;
  for (const TextureFile& file : files) levels += file.levels.size();
  return static_cast<int>(levels);
}

std::vector<Size> level_sizes(std::span<const TextureFile> files) {
  std::vector<Size> sizes;
  for (const TextureFile& file : files) sizes.insert(sizes.end(), file.levels.begin(), file.levels.end());
  return sizes;
}

std::vector<TextureFile> texture_files(const std::string& stem, std::span<const Size> levels,
                                       ImageContainer container) {
  std::vector<TextureFile> files;
  for (const Size& size : levels)
    files.push_back({fmt::format("{}_{}.{}", stem, files.size(), name_of(container)), {size}});
  return files;
}

void check_texture_file(const std::filesystem::path& path, const TextureFile& announced, int channels,
                        Depth depth) {
  require_one_level(announced.levels.size());
  check_image_header(path, announced.levels.front(), channels, std::span(&depth, 1));
}

void read_texture_file(const std::filesystem::path& path, Encoding encoding, std::span<Image> levels) {
  require_one_level(levels.size());
  levels.front() = read_image(path, pack_reading(encoding)).image;
}

void write_texture_file(const std::filesystem::path& path, std::span<const Image> levels,
                        const StoredFormat& format) {
  require_one_level(levels.size());
  write_image(path, levels.front(), format);
}

} // namespace tilepack
