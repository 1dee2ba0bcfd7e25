#pragma once

#include "tilepack/image/resample.h"
#include "tilepack/image/stored_format.h"
#include "tilepack/layout/layout.h"
#include "tilepack/mapping/mapping.h"
#include "tilepack/mip/mip_mode.h"
#include "tilepack/tileset/limits.h"
#include "tilepack/tileset/set_figures.h"
#include "tilepack/tileset/tile_set.h"
#include "tilepack/tileset/value_space.h"

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tilepack {

using limits::largest_seed;
using limits::most_texels_a_level;

/// What storing tiles turned costs: level 0 of a map stored with `filter` and read back as tiles_at_level
/// does, held against the tiles as they were.
struct RoundTrip {
  ResampleFilter filter = ResampleFilter::lanczos;
  std::optional<double> psnr =
      {}; ///< decibels in hundredths, of stored values against full scale; unset: no loss
  bool operator==(const RoundTrip&) const = default;
};

/// One map of a pack: its levels as placed images, finest first, values as stored (rounded to `depth`).
struct PackedMap : MapFormat {
  int channels = 0;
  std::vector<Image> levels;               ///< of tiles
  std::vector<Image> far_levels;           ///< past those, of packs with a full chain (mip/far_levels.h)
  std::vector<RoundTrip> round_trips;      ///< rotated layouts: one a filter, in the order of ResampleFilter
  std::optional<ImageContainer> container; ///< unset: the usual one of the depth

  StoredFormat stored() const { return {container.value_or(usual_container(depth)), depth, encoding}; }

  PackedMap() = default;
  PackedMap(MapFormat format, int channel_count, std::vector<Image> images = {},
            std::vector<RoundTrip> losses = {})
      : MapFormat(std::move(format)), channels(channel_count), levels(std::move(images)),
        round_trips(std::move(losses)) {}
  PackedMap(std::string name_of_map, Role meaning, Encoding encoded, Depth stored, int channel_count,
            std::vector<Image> images, std::vector<RoundTrip> losses = {})
      : PackedMap(MapFormat{std::move(name_of_map), meaning, encoded, stored}, channel_count,
                  std::move(images), std::move(losses)) {}
};

inline ValueSpace value_space(const PackedMap& map) {
  return {map.role, map.encoding, map.channels};
}

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
  int columns = 0;  ///< Kh²
  int rows = 0;     ///< Kv²
  double width = 0; ///< the widest it may be blended in round lattice points, texels of level 0
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
  MipMode mip_mode = MipOptions{}.mode;
  std::optional<int> jump_weight; ///< least_squares: MipOptions::jump_weight, where it was recorded
  int guard = 0;
  int tile_levels = 0;     ///< number of levels of tiles, level 0 counted
  bool full_chain = false; ///< maps have far levels after those, down to one texel
  std::vector<std::string>
      materials; ///< of a transition: the names of its materials, by corner color; else none
  std::optional<SetFigures> synthesis; ///< of a set made from a sample; nothing here is needed to sample it
};

} // namespace tilepack
