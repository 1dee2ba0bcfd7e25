#pragma once

#include "tilepack/numeric/enum_names.h"
#include "tilepack/sampler/reference_sampler.h"
#include "tilepack/sampler/texture.h"

#include <array>
#include <string>

namespace tilepack {

enum class ViewFilter {
  trilinear,   ///< one lookup, blurred to the long side of a pixel's footprint
  anisotropic, ///< up to 16 trilinear lookups along the long side, each blurred to the short one
  ewa,         ///< the mean over the footprint's ellipse, texel by texel: slow, to hold the others against
};

template <>
inline constexpr auto enum_names<ViewFilter> =
    std::array{EnumName{ViewFilter::trilinear, "trilinear"}, EnumName{ViewFilter::anisotropic, "anisotropic"},
               EnumName{ViewFilter::ewa, "elliptical"}};
ViewFilter view_filter_of(const std::string& name); ///< Error (usage) for an unknown name

/// The lookups that stand for a pixel: `probes` of them, `level` coarse, at
/// ((i + 0.5)/probes - 0.5) * (u_axis, v_axis) from its place, i = 0..probes-1.
struct Probes {
  int count = 1;
  double level = 0;              ///< may lie beyond the coarsest one stored
  double u_axis = 0, v_axis = 0; ///< tiles
};

/// A pixel maps to a parallelogram of the texture; what a filter must cover is the ellipse of the same
/// Jacobian, with half axes its singular values: so the result does not depend on how the camera is turned
/// about its view, as the longer of the two derivatives would. For ViewFilter::ewa one probe, which
/// the sampler spreads over the ellipse itself.
Probes probes_for(const Footprint& footprint, Size tile, ViewFilter filter);

/// A map of a pack as a texture: tiles are its unit, lookups those of ReferenceSampler.
///
/// Past the coarsest level a pixel covers many tiles, and looking at one of them would flicker from pixel to
/// pixel. So from that level on the value fades to the mean of the map over two levels, and the mean is all
/// there is at the horizon. (A mean over the tiles of the pack: mappings use each about equally often.) Of a pack with
/// a full chain trilinear and anisotropic views read the far levels in place of that, as hardware does, whose last is the mean.
class PackTexture final : public Texture {
public:
  /// `pack` must outlive this. Throws Error (usage) for a map that isn't there.
  PackTexture(const Pack& pack, int map, ViewFilter filter, WrapMode border = WrapMode::wrap);

  int channels() const override { return sampler.channels(); }
  void sample(TileCoordinate u, TileCoordinate v, const Footprint& footprint,
              std::span<double> out) const override;

private:
  ReferenceSampler sampler;
  ViewFilter filter;
  Size tile;
  ValueSpace space;
  std::array<double, 4> mean{};
};

} // namespace tilepack
