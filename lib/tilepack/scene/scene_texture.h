#pragma once

#include "tilepack/image/image.h"
#include "tilepack/sampler/texture.h"

namespace tilepack {

/// A scene's texture in the unit of views: tiles of view_tile texels a side, whatever units its graph has.
class SceneTexture final : public Texture {
public:
  static constexpr int view_tile = 256;

  /// `of`: a texture in units of `unit` texels; it must outlive this.
  SceneTexture(const Texture& of, Size of_unit) : texture(&of), unit(of_unit) {}

  int channels() const override { return texture->channels(); }
  void sample(TileCoordinate u, TileCoordinate v, const Footprint& footprint,
              std::span<double> out) const override {
    const double wide = static_cast<double>(view_tile) / unit.width;
    const double high = static_cast<double>(view_tile) / unit.height;
    texture->sample(in_units(u, unit.width), in_units(v, unit.height),
                    {footprint.u_across * wide, footprint.v_across * high, footprint.u_down * wide,
                     footprint.v_down * high},
                    out);
  }

private:
  static TileCoordinate in_units(const TileCoordinate& tiles, int texels) {
    constexpr std::int64_t farthest = std::int64_t{1} << 50; // beyond, a double has no fraction anyway
    const TileCoordinate at = normalised(tiles);
    if (at.tile > farthest || at.tile < -farthest) return {};
    return normalised(from_texels(at.tile * view_tile, at.fraction * view_tile, texels));
  }

  const Texture* texture;
  Size unit;
};

} // namespace tilepack
