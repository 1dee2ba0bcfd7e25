#include "tilepack/pack/pack_read.h"

#include "tilepack/error/error.h"
#include "tilepack/image/image_file.h"
#include "tilepack/image/image_format.h"
#include "tilepack/pack/file_name.h"
#include "tilepack/pack/pack_folder_read.h"
#include "tilepack/pack/pack_json.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <cmath>

namespace tilepack {

namespace fs = std::filesystem;

namespace {

// What pack.json announces, against the header of the file: checked before its texels take any memory.
void check_header(const fs::path& file, Size size, int channels, std::span<const Depth> depths) {
  check_complete(file, image_format(file)); // a decoder that finds a header cut complains on stderr
  const ImageHeader header = read_image_header(file);
  const auto refuse = [&](const std::string& has, const std::string& announced) {
    throw Error(ErrorKind::invalid_content, file.string(),
                fmt::format("has {}, and pack.json announces {}", has, announced));
  };
  if (header.size != size)
    refuse(fmt::format("{} x {} texels", header.size.width, header.size.height),
           fmt::format("{} x {}", size.width, size.height));
  if (header.channels != channels)
    refuse(fmt::format("{} channels", header.channels), fmt::format("{}", channels));
  if (std::find(depths.begin(), depths.end(), header.depth) == depths.end())
    refuse(fmt::format("depth {}", name_of(header.depth)), std::string(name_of(depths.front())));
}

struct Load {
  fs::path file;
  Image* into;
  Encoding encoding;
};

void plan_maps(std::vector<Load>& loads, std::vector<PackedMap>& maps,
               const std::vector<std::vector<PackDescription::LevelFile>>& files, const fs::path& folder) {
  for (std::size_t m = 0; m < maps.size(); ++m) {
    PackedMap& map = maps[m];
    map.levels.resize(files[m].size());
    for (std::size_t l = 0; l < files[m].size(); ++l) {
      const fs::path file = inside_folder(folder, files[m][l].file);
      check_header(file, files[m][l].size, map.channels, std::span(&map.depth, 1));
      loads.push_back({file, &map.levels[l], map.encoding});
    }
  }
}

std::vector<int> read_index_map(const fs::path& file, VirtualSize size, int tiles) {
  const Depth depths[] = {Depth::u8, Depth::u16};
  const Size cells{static_cast<int>(size.width), static_cast<int>(size.height)};
  check_header(file, cells, 1, depths);
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
  plan_maps(loads, pack.maps, description.map_files, folder);
  if (pack.corner_pack) plan_maps(loads, pack.corner_pack->maps, description.corner_files, folder);
  if (pack.mapping.kind == MappingKind::index)
    pack.mapping.ids = read_index_map(inside_folder(folder, description.index_file), pack.mapping.size,
                                      tile_count(pack.tiles));
  tbb::parallel_for(std::size_t{0}, loads.size(), [&](std::size_t i) {
    *loads[i].into = read_image(loads[i].file, loads[i].encoding).image;
  });
  return pack;
}

} // namespace tilepack
