#pragma once

#include "tilepack/sampler/address.h"
#include "tilepack/sampler/footprint.h"

#include <span>

namespace tilepack {

/// Anything that can be looked at: it says what a pixel shows that covers `footprint` round a place. A pack is
/// one (pack_texture.h), and what views are rendered of (scanline/view_render.h) is any.
class Texture {
public:
  virtual ~Texture() = default;

  virtual int channels() const = 0; ///< 1..4

  /// The value of a pixel: linear light, normals as n * 0.5 + 0.5 of length 1, all else as it is; color with
  /// alpha not multiplied by it. (u, v): the place, in tiles or whatever the texture's unit is; `footprint`: how
  /// far it moves from pixel to pixel, in the same unit. Defined for every place and footprint: never NaN where
  /// what the texture is made of isn't. `out` has channels() entries. Called by many threads at once.
  virtual void sample(TileCoordinate u, TileCoordinate v, const Footprint& footprint,
                      std::span<double> out) const = 0;
};

} // namespace tilepack
