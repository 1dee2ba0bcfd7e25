#include "tilepack/mip/mip_chain.h"

#include "tilepack/mip/downsample.h"
#include "tilepack/mip/least_squares.h"
#include "tilepack/mip/shared_border.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <cstddef>

namespace tilepack {
namespace {

std::size_t as_size(int i) {
  return static_cast<std::size_t>(i);
}

// Values that may be averaged: linear light for color, vectors for normals, plain values for the rest.
Image decoded(const Image& tile, const TileMap& map) {
  if (map.role == Role::color) return to_linear(tile, map.encoding);
  if (map.role != Role::normal) return tile;
  Image result = tile;
  for (float& v : result.data()) v = v * 2.0f - 1.0f;
  return result;
}

// The mean of unit vectors is shorter than one: it is kept so through the chain, else each level would weigh
// its children differently from their area, and made a unit vector here, where a level is stored.
Image encoded(Image tile, const TileMap& map) {
  if (map.role == Role::color) return from_linear(tile, map.encoding);
  if (map.role != Role::normal) return tile;
  const std::size_t channels = as_size(tile.channels());
  auto& values = tile.data();
  if (channels >= 3)
    for (std::size_t i = 0; i < values.size(); i += channels) {
      float* n = &values[i];
      const double length = std::sqrt(static_cast<double>(n[0]) * n[0] + static_cast<double>(n[1]) * n[1] +
                                      static_cast<double>(n[2]) * n[2]);
      if (length > 0)
        for (int c = 0; c < 3; ++c) n[c] = static_cast<float>(n[c] / length);
      else
        n[2] = 1.0f;
    }
  for (float& v : values) v = v * 0.5f + 0.5f;
  return tile;
}

// The mean over the tiles of a group goes to all of them as one value, so they are equal bit for bit,
// whatever encoding and rounding follow. It is summed in double in the order of ids: a group of equal values
// keeps its value exactly.
void share(const SharedTexels& group, Weighting weighting, std::vector<Image>& tiles) {
  const std::size_t channels = as_size(tiles.front().channels());
  std::vector<double> sum(channels);
  std::vector<double> weighted(channels);
  for (const Place place : group.places) {
    sum.assign(channels, 0.0);
    weighted.assign(channels, 0.0);
    for (const int id : group.tiles) {
      const auto texel = tiles[as_size(id)].texel(place.x, place.y);
      for (std::size_t c = 0; c < channels; ++c) {
        sum[c] += static_cast<double>(texel[c]);
        weighted[c] += static_cast<double>(texel[c]) * static_cast<double>(texel[channels - 1]);
      }
    }
    const double alpha = sum[channels - 1];
    for (const int id : group.tiles) {
      const auto texel = tiles[as_size(id)].texel(place.x, place.y);
      for (std::size_t c = 0; c < channels; ++c) {
        const bool by_alpha = weighting == Weighting::by_alpha && c + 1 < channels && alpha > 0;
        texel[c] = static_cast<float>(by_alpha ? weighted[c] / alpha
                                               : sum[c] / static_cast<double>(group.tiles.size()));
      }
    }
  }
}

void sanitize(const TileColors& colors, Size size, MipMode mode, Weighting weighting,
              std::vector<Image>& tiles) {
  const std::vector<SharedTexels> groups = shared_border(colors, size, mode);
  tbb::parallel_for(std::size_t{0}, groups.size(),
                    [&](std::size_t i) { share(groups[i], weighting, tiles); });
}

} // namespace

std::string_view name_of(MipMode mode) {
  switch (mode) {
  case MipMode::none:
    return "none";
  case MipMode::box:
    return "box";
  case MipMode::edges:
    return "edges";
  case MipMode::corners:
    return "corners";
  case MipMode::least_squares:
    break;
  }
  return "least-squares";
}

int level_count(Size tile_size) {
  int count = 1;
  while (tile_size.width % 2 == 0 && tile_size.height % 2 == 0 && tile_size.width > 0 &&
         tile_size.height > 0) {
    tile_size = {tile_size.width / 2, tile_size.height / 2};
    ++count;
  }
  return count;
}

Size level_size(Size tile_size, int level) {
  return {tile_size.width >> level, tile_size.height >> level};
}

bool exact_through_guard(int guard, int level) {
  return level == 0 || (level < 31 && (1 << level) <= guard);
}

std::vector<TileMap> mip_chain(const TileSet& set, int map_index, const MipOptions& options,
                               const Layout* layout) {
  const TileMap& map = set.maps[as_size(map_index)];
  const std::size_t tiles = map.tiles.size();
  const int levels = options.mode == MipMode::none ? 1 : level_count(set.tile_size);
  const int channels = map.tiles.front().channels();
  const Weighting weighting =
      map.role == Role::color && channels % 2 == 0 ? Weighting::by_alpha : Weighting::plain;

  std::vector<TileMap> chain;
  for (int level = 0; level < levels; ++level)
    chain.push_back({map.name, map.role, map.encoding, map.depth, std::vector<Image>(level > 0 ? tiles : 0)});
  chain.front().tiles = map.tiles;
  if (levels == 1) return chain;

  tbb::parallel_for(std::size_t{0}, tiles, [&](std::size_t id) {
    chain[1].tiles[id] = halved(decoded(map.tiles[id], map), weighting);
    for (std::size_t level = 2; level < chain.size(); ++level)
      chain[level].tiles[id] = halved(chain[level - 1].tiles[id], weighting);
  });
  const PackNeighbours neighbours = layout ? pack_neighbours(*layout) : PackNeighbours{};
  tbb::parallel_for(1, levels, [&](int level) {
    if (exact_through_guard(set.guard, level)) return;
    std::vector<Image>& images = chain[as_size(level)].tiles;
    if (options.mode == MipMode::least_squares)
      fit_borders(set.tiles, neighbours, options.jump_weight, weighting, images);
    else
      sanitize(set.tiles, level_size(set.tile_size, level), options.mode, weighting, images);
  });
  tbb::parallel_for(std::size_t{0}, tiles * as_size(levels - 1), [&](std::size_t i) {
    Image& tile = chain[1 + i / tiles].tiles[i % tiles];
    tile = encoded(std::move(tile), map);
  });
  return chain;
}

} // namespace tilepack
