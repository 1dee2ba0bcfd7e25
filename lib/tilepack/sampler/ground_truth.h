#pragma once

#include "tilepack/lookup/lookup_tables.h"
#include "tilepack/pack/pack.h"
#include "tilepack/sampler/address.h"
#include "tilepack/sampler/filter.h"
#include "tilepack/sampler/footprint.h"

#include <cstdint>
#include <span>
#include <vector>

namespace tilepack {

/// The virtual texture as if it had been stored whole: a filter that crosses a tile's border reads the tile
/// that lies there in the virtual texture, where ReferenceSampler reads what lies there in the pack. The
/// difference between the two is what tiles cost.
///
/// No texture of any size is ever written out: texels are looked up tile by tile.
class GroundTruth {
public:
  /// The true mip chain: each level a box of level 0, within tiles and hence within the virtual texture, not
  /// sanitized and not rounded. Normals, roughness and alpha are averaged as mip_chain does.
  static GroundTruth of_level_0(const Pack& pack, int map, WrapMode border = WrapMode::wrap);

  /// The levels as the pack stores them: all that is left to differ from ReferenceSampler is the neighbours.
  static GroundTruth of_stored_levels(const Pack& pack, int map, WrapMode border = WrapMode::wrap);

  int channels() const;
  int levels() const;

  /// As ReferenceSampler::sample: linear light, doubles, the same order of sums.
  void sample(TileCoordinate x, TileCoordinate y, double level, Filter filter, std::span<double> out) const;
  void sample(TileCoordinate x, TileCoordinate y, const Footprint& footprint, std::span<double> out) const;

private:
  GroundTruth(const Pack& pack, int map, WrapMode border, std::vector<std::vector<Image>> encoded_tiles);

  std::span<const float> texel(int level, std::int64_t x, std::int64_t y) const;

  const Pack* pack; // must outlive this
  LookupTables tables;
  WrapMode border;
  std::vector<std::vector<Image>> tiles; // level → tile id, linear light
  bool alpha = false;
};

/// The tiles of all maps of a pack at level 0, with their colors: what was packed.
TileSet tile_set_of(const Pack& pack);

} // namespace tilepack
