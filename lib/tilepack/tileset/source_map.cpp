#include "tilepack/tileset/source_map.h"

#include <algorithm>

namespace tilepack {
namespace {

Image gathered(const std::vector<SourceTexel>& texels, Size size, const Image& sample) {
  Image tile(size.width, size.height, sample.channels());
  std::size_t i = 0;
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x, ++i) {
      const auto from = sample.texel(texels[i].x, texels[i].y);
      std::copy(from.begin(), from.end(), tile.texel(x, y).begin());
    }
  return tile;
}

} // namespace

TileSet assembled(const SourceMap& sources, std::span<const SampleMap> samples) {
  TileSet set{sources.tile_size, sources.colors, sources.tiles, {}, sources.guard};
  for (const SampleMap& sample : samples) {
    TileMap map(sample, {});
    map.tiles.reserve(sources.texels.size());
    for (const auto& texels : sources.texels)
      map.tiles.push_back(gathered(texels, sources.tile_size, sample.image));
    set.maps.push_back(std::move(map));
  }
  return set;
}

} // namespace tilepack
