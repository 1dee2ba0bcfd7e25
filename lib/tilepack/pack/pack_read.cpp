#include "tilepack/pack/pack_read.h"

#include "tilepack/error/error.h"
#include "tilepack/image/image_file.h"
#include "tilepack/pack/file_name.h"
#include "tilepack/pack/image_header_check.h"
#include "tilepack/pack/pack_folder_read.h"
#include "tilepack/pack/pack_json.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <cmath>

namespace tilepack {

namespace fs = std::filesystem;

namespace {

struct Load {
  fs::path file;
  std::span<Image> into;
  Encoding encoding;
};

void plan_reading(std::vector<Load>& loads, std::vector<PackedMap>& maps,
               const std::vector<std::vector<TextureFile>>& files, const fs::path& folder) {
  for (std::size_t m = 0; m < maps.size(); ++m) {
    PackedMap& map = maps[m];
    map.levels.resize(static_cast<std::size_t>(levels_in(files[m])));
    std::span<Image> left(map.levels);
    for (const TextureFile& texture : files[m]) {
      const fs::path file = inside_folder(folder, texture.file);
      check_texture_file(file, texture, map.channels, map.depth);
      loads.push_back({file, left.first(texture.levels.size()), map.encoding});
      left = left.subspan(texture.levels.size());
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

} // namespace

fs::path pack_json_of(const fs::path& folder_or_json) {
  std::error_code unused;
  return fs::is_directory(folder_or_json, unused) ? folder_or_json / "pack.json" : folder_or_json;
}

PackDescription read_pack_description(const fs::path& folder_or_json) {
  const fs::path json = pack_json_of(folder_or_json);
  return parsed_pack_json(pack_json_text(json), json.string());
}

Pack read_pack(const fs::path& folder_or_json) {
  const fs::path json = pack_json_of(folder_or_json);
  const fs::path folder = folder_of(json);
  PackDescription description = read_pack_description(json);
  Pack pack = std::move(description.pack);
  std::vector<Load> loads;
  plan_reading(loads, pack.maps, description.map_files, folder);
  if (pack.corner_pack) plan_reading(loads, pack.corner_pack->maps, description.corner_files, folder);
  if (pack.mapping.kind == MappingKind::index)
    pack.mapping.ids = read_index_map(inside_folder(folder, description.index_file), pack.mapping.size,
                                      tile_count(pack.tiles));
  tbb::parallel_for(std::size_t{0}, loads.size(), [&](std::size_t i) {
    read_texture_file(loads[i].file, loads[i].encoding, loads[i].into);
  });
  return pack;
}

} // namespace tilepack
