#pragma once

#include "tilepack/pack/pack.h"
#include "tilepack/sampler/address.h"

#include <span>

namespace tilepack {

enum class Filter { nearest, bilinear, trilinear };

/// Looks a pack up in double precision along one obvious path: slow, and what everything fast is held
/// against.
///
/// Filtering is that of graphics hardware on the packed texture: the tile of the cell that holds the point is
/// found, its place in the pack, and the filter reads the pack's texels around it, wrapping at the pack's
/// borders. So across a tile's border it reads the pack's neighbour, which matches along edges but not at the
/// corners of an edge-colored set. Colors are filtered in linear light.
class ReferenceSampler {
public:
  /// `pack` must outlive the sampler. map: index into pack.maps.
  ReferenceSampler(const Pack& pack, int map);

  int channels() const;

  /// Linear-light value at (x, y); `level` 0 is the finest, clamped to the levels stored; nearest and
  /// bilinear round it, trilinear interpolates between the two levels around it. `out` has channels()
  /// entries.
  void sample(TileCoordinate x, TileCoordinate y, double level, Filter filter, std::span<double> out) const;

private:
  const Pack* pack;
  const PackedMap* map;
};

} // namespace tilepack
