#include "tilepack/error/error.h"
#include "tilepack/image/resample.h"
#include "tilepack/mip/mip_chain.h"
#include "tilepack/pack/pack_maps.h"
#include "tilepack/pattern/pattern_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tilepack {
namespace {

// The levels of a map from `first` on.
PackedMap coarse_part(const PackedMap& map, int first) {
  PackedMap part = map;
  part.round_trips.clear();
  part.levels.erase(part.levels.begin(), part.levels.begin() + first);
  return part;
}

} // namespace

Pack from_level(const Pack& pack, const PackRequest& request) {
  const PackedMap& map = map_at(pack, request.map);
  const int first = std::clamp(request.first_level, 0, static_cast<int>(map.levels.size()) - 1);
  Pack part;
  part.generator = pack.generator;
  part.tile_size = level_size(pack.tile_size, first);
  part.colors = pack.colors;
  part.tiles = pack.tiles;
  part.layout = pack.layout;
  part.layout.border >>= first;
  part.layout.rotated.size = level_size(pack.layout.rotated.size, first);
  part.layout.rotated.gutter >>= first;
  part.mapping = pack.mapping;
  part.mip_mode = pack.mip_mode;
  part.jump_weight = pack.jump_weight;
  part.guard = pack.guard >> first;
  part.tile_levels = pack.tile_levels - first;
  part.full_chain = pack.full_chain;
  part.maps.push_back(coarse_part(map, first));
  if (pack.corner_pack) {
    part.corner_pack = CornerPack{
        pack.corner_pack->columns, pack.corner_pack->rows, std::ldexp(pack.corner_pack->width, -first), {}};
    part.corner_pack->maps.push_back(coarse_part(map_at(pack.corner_pack->maps, request.map), first));
  }
  return part;
}

std::shared_ptr<const PatternSource> source_of(std::shared_ptr<const Pack> pack, std::string name,
                                               std::vector<int> map_of) {
  PackFacts facts;
  facts.name = std::move(name);
  facts.tile_size = pack->tile_size;
  facts.tiles = static_cast<int>(pack->layout.cells.size());
  facts.levels = pack->tile_levels;
  if (map_of.empty())
    for (std::size_t i = 0; i < pack->maps.size(); ++i) map_of.push_back(static_cast<int>(i));
  for (std::size_t i = 0; i < map_of.size() && facts.alpha_map < 0; ++i)
    if (map_of[i] >= 0 && value_space(map_at(*pack, map_of[i])).has_alpha())
      facts.alpha_map = static_cast<int>(i);
  facts.map_of = std::move(map_of);
  return std::make_shared<PatternSource>(
      std::move(facts),
      [pack = std::move(pack)](const PackRequest& request) { return from_level(*pack, request); });
}

Pack pattern_pack(const std::vector<Image>& patterns, const MapFormat& format) {
  const auto other = [&](const Image& image) {
    return image.size() != patterns[0].size() || image.channels() != patterns[0].channels();
  };
  if (patterns.empty() || patterns.size() > 65536 || std::any_of(patterns.begin(), patterns.end(), other))
    throw Error(ErrorKind::invalid_content, "patterns",
                fmt::format("{} images; a set is of 1 to 65536 images of one size and number of channels",
                            patterns.size()));
  const int count = static_cast<int>(patterns.size());
  Pack pack;
  pack.generator.version = TILEPACK_VERSION;
  pack.tile_size = patterns[0].size();
  pack.colors = {1, 1, 0};
  pack.tiles = std::vector<EdgeTile>(patterns.size());
  pack.mip_mode = MipMode::box;
  TileSet set{pack.tile_size, pack.colors, pack.tiles, {TileMap(format, patterns)}, 1};
  MipOptions box;
  box.mode = MipMode::box;
  const std::vector<TileMap> levels = mip_chain(set, 0, box);
  PackedMap map(format, patterns[0].channels());
  for (const TileMap& level : levels) {
    const Size tile = level.tiles[0].size();
    Image column(tile.width, tile.height * count, map.channels);
    std::size_t at = 0;
    for (const Image& image : level.tiles) {
      const Image stored = quantised(image, format.depth);
      std::copy(stored.data().begin(), stored.data().end(),
                column.data().begin() + static_cast<std::ptrdiff_t>(at));
      at += stored.data().size();
    }
    map.levels.push_back(std::move(column));
  }
  pack.tile_levels = static_cast<int>(levels.size());
  pack.layout.kind = LayoutKind::array;
  pack.layout.columns = 1;
  pack.layout.rows = count;
  pack.mapping.kind = MappingKind::index;
  pack.mapping.size = {count, 1};
  for (int tile = 0; tile < count; ++tile) {
    pack.layout.cells.push_back({tile, 0, tile});
    pack.mapping.ids.push_back(tile);
  }
  pack.maps.push_back(std::move(map));
  return pack;
}

} // namespace tilepack
