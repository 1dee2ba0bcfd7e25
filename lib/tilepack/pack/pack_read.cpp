#include "tilepack/pack/pack_read.h"

#include "tilepack/error/error.h"
#include "tilepack/image/image_file.h"
#include "tilepack/pack/image_header_check.h"
#include "tilepack/pack/pack_json.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <cmath>

namespace tilepack {

namespace fs = std::filesystem;

namespace {

struct Load {
  std::string name; // as pack.json has it
  fs::path file;
  std::span<Image> into;
  Encoding encoding;
};

// Whatever `work` throws about the file names it as the user knows it.
template <typename Work>
auto naming(const PackFolder& folder, const std::string& name, Work work) {
  try {
    return work();
  } catch (const Error& error) {
    throw folder.named(error, name);
  }
}

void plan_reading(std::vector<Load>& loads, std::vector<PackedMap>& maps,
                  const std::vector<std::vector<TextureFile>>& files, int tile_levels,
                  const PackFolder& folder, int first_level) {
  for (std::size_t m = 0; m < maps.size(); ++m) {
    PackedMap& map = maps[m];
    map.levels.resize(static_cast<std::size_t>(tile_levels));
    map.far_levels.resize(static_cast<std::size_t>(levels_in(files[m]) - tile_levels));
    std::span<Image> left(map.levels);
    int level = 0;
    for (const TextureFile& texture : files[m]) {
      if (left.empty()) left = map.far_levels;
      const auto count = texture.levels.size();
      level += static_cast<int>(count);
      if (level <= first_level) {
        left = left.subspan(count);
        continue;
      }
      const fs::path file = folder.file(texture.file);
      naming(folder, texture.file, [&] { check_texture_file(file, texture, map.channels, map.depth); });
      loads.push_back({texture.file, file, left.first(count), map.encoding});
      left = left.subspan(count);
    }
  }
}

std::vector<int> read_index_map(const fs::path& file, VirtualSize size, int tiles) {
  const Depth depths[] = {Depth::u8, Depth::u16};
  const Size cells{static_cast<int>(size.width), static_cast<int>(size.height)};
  check_image_header(file, cells, 1, depths);
  const ImageFile stored = read_image(file, Encoding::linear);
  const float top = stored.depth == Depth::u8 ? 255.0f : 65535.0f;
  std::vector<int> ids;
  ids.reserve(stored.image.data().size());
  for (const float value : stored.image.data()) {
    const int id = static_cast<int>(std::lround(value * top));
    if (id >= tiles) {
      const int cell = static_cast<int>(ids.size());
      throw Error(ErrorKind::invalid_content, file.string(),
                  fmt::format("cell ({}, {}) holds tile {}; the tiles are 0 to {}", cell % cells.width,
                              cell / cells.width, id, tiles - 1));
    }
    ids.push_back(id);
  }
  return ids;
}

void read_index(Pack& pack, const std::string& name, const PackFolder& folder) {
  if (pack.mapping.kind != MappingKind::index) return;
  pack.mapping.ids = naming(folder, name, [&, file = folder.file(name)] {
    return read_index_map(file, pack.mapping.size, tile_count(pack.tiles));
  });
}

void read_textures(const std::vector<Load>& loads, const PackFolder& folder) {
  tbb::parallel_for(std::size_t{0}, loads.size(), [&](std::size_t i) {
    const Load& load = loads[i];
    naming(folder, load.name, [&] { read_texture_file(load.file, load.encoding, load.into); });
  });
}

} // namespace

PackDescription read_pack_description(const fs::path& folder_or_json) {
  return PackFolder(folder_or_json).description();
}

Pack read_pack(const fs::path& folder_or_json) {
  return reading_pack(folder_or_json, [](const PackFolder& folder) { return read_pack(folder); });
}

Pack read_pack(const PackFolder& folder) {
  PackDescription description = folder.description();
  Pack pack = std::move(description.pack);
  std::vector<Load> loads;
  plan_reading(loads, pack.maps, description.map_files, pack.tile_levels, folder, 0);
  if (pack.corner_pack)
    plan_reading(loads, pack.corner_pack->maps, description.corner_files, pack.tile_levels, folder, 0);
  read_index(pack, description.index_file, folder);
  read_textures(loads, folder);
  return pack;
}

Pack read_pack_levels(const PackFolder& folder, int map, int first_level) {
  PackDescription description = folder.description();
  Pack pack = std::move(description.pack);
  const auto at = static_cast<std::size_t>(map);
  pack.maps = std::vector<PackedMap>{pack.maps.at(at)};
  pack.corner_pack.reset();
  std::vector<Load> loads;
  plan_reading(loads, pack.maps, {description.map_files[at]}, pack.tile_levels, folder, first_level);
  read_index(pack, description.index_file, folder);
  read_textures(loads, folder);
  return pack;
}

} // namespace tilepack
