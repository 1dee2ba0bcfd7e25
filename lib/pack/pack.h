#pragma once

#include "tilepack/layout/layout.h"
#include "tilepack/mapping/mapping.h"
#include "tilepack/mip/mip_chain.h"
#include "tilepack/tileset/tile_set.h"

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tilepack {

/// One map of a pack: its levels as placed images, finest first, values as stored (rounded to `depth`).
struct PackedMap {
  std::string name;
  Role role = Role::color;
  Encoding encoding = Encoding::srgb;
  Depth depth = Depth::u8;
  int channels = 0;
  std::vector<Image> levels;
};

/// Who made the pack and how, so that it can be made again. No clock and no path.
struct Generator {
  std::string name = "tilepack";
  std::string version;
  std::vector<std::pair<std::string, std::string>>
      options; ///< name → value as it would stand on the command line
  std::uint64_t seed = 0;
};

/// The corner pack of [Wei04, App. B]: one cell a combination of the four edges round a lattice point.
struct CornerPack {
  int columns = 0; ///< Kh²
  int rows = 0;    ///< Kv²
  std::vector<PackedMap> maps;
};

/// The deliverable as one value: what pack.json and its images hold.
struct Pack {
  Generator generator;
  Size tile_size;
  ColorCounts colors;
  TileColors tiles;
  Layout layout;
  std::vector<PackedMap> maps;
  Mapping mapping;
  std::optional<CornerPack> corner_pack;
  MipMode mip_mode = MipMode::edges;
  int guard = 0;
  int tile_levels = 0; ///< number of levels, level 0 counted
};

} // namespace tilepack
