#pragma once

#include "tilepack/sampler/address.h"
#include "tilepack/sampler/corner_blend.h"
#include "tilepack/sampler/filter.h"
#include "tilepack/sampler/footprint.h"
#include "tilepack/sampler/pack_texels.h"

#include <cstdint>
#include <optional>
#include <span>

namespace tilepack {

/// The virtual texture's extent, and how it goes on beyond.
struct VirtualEdge {
  VirtualSize size; ///< in tiles
  WrapMode border = WrapMode::wrap;
};

/// A point of the virtual texture whose tile has been found: `place` is that of the cell that holds it, the
/// fractions (0 <= fraction < 1) tell where it lies in it.
struct TilePoint {
  std::int64_t cell_x = 0; ///< within the virtual texture unless that wraps
  std::int64_t cell_y = 0;
  PackTexels::Place place;
  double x = 0; ///< fractions of the tile's sides
  double y = 0;
};

/// Filters at points whose tiles have been found: what ReferenceSampler does after that. A view of texels that
/// others own.
struct TileReader {
  const PackTexels& texels;
  const CornerTexels* corners = nullptr; ///< null: none
  VirtualEdge edge;

  /// Linear values, texels.channels() of them. As ReferenceSampler::sample.
  void sample(const TilePoint& point, const LevelBlend& levels, Filter filter, std::span<double> out) const;
  void sample(const TilePoint& point, const LevelBlend& levels, const FootprintEllipse& ellipse,
              std::span<double> out) const;
};

/// Looks a pack up in double precision along one obvious path: slow, and what everything fast is held
/// against.
///
/// Filtering is that of graphics hardware on the packed texture: the tile of the cell that holds the point is
/// found, its place in the pack, and the filter reads the pack's texels around it, wrapping at the pack's
/// borders. So across a tile's border it reads the pack's neighbour, which matches along edges but not at the
/// corners of an edge-colored set. There the corner pack is blended in, if the pack has one.
///
/// What is averaged:
///   * sRGB values are decoded to linear light first (to floats, as everywhere in tilepack; weights and sums
///     are doubles);
///   * color with an alpha channel (2 or 4 channels) is weighed by alpha, so that what lies under transparent
///     texels doesn't bleed; where the alpha of all texels read is 0, the colors are averaged plainly;
///   * normals are averaged as vectors and come back as stored, n * 0.5 + 0.5, not renormalised: the length
///     lost tells how much they vary;
///   * everything else is averaged as it is.
///
/// Defined for any coordinate, level and footprint: see within(), level_blend() and ellipse_of().
class ReferenceSampler {
public:
  /// `pack` must outlive the sampler. map: index into pack.maps (Error, usage, if there is none such).
  /// corner_width: see corner_weight; 0 leaves the corner pack aside. Beyond the virtual texture it goes on
  /// as `border` says: a filter that meets a border which doesn't wrap reads nothing beyond it.
  ReferenceSampler(const Pack& pack, int map, double corner_width = default_corner_width,
                   WrapMode border = WrapMode::wrap);

  int channels() const { return texels.channels(); }
  int levels() const { return texels.levels(); }             ///< of tiles
  int chain_levels() const { return texels.chain_levels(); } ///< with far levels

  /// The linear value at (x, y). `level` 0 is the finest. `out` has channels() entries. Past the levels of tiles
  /// bilinear and trilinear lookups read the far levels of packs that have a full chain.
  void sample(TileCoordinate x, TileCoordinate y, double level, Filter filter, std::span<double> out) const;

  /// Anisotropic: the mean over the ellipse that a pixel covers, in the two levels next to level_of() it,
  /// blended. Constant time: at most about 51500 texels a level, and that only of the coarsest.
  void sample(TileCoordinate x, TileCoordinate y, const Footprint& footprint, std::span<double> out) const;

private:
  TilePoint point_at(TileCoordinate x, TileCoordinate y) const;
  TileReader reader() const { return {texels, corners ? &*corners : nullptr, edge}; }

  PackTexels texels;
  std::optional<CornerTexels> corners;
  VirtualEdge edge;
};

} // namespace tilepack
