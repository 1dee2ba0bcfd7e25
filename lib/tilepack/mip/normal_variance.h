#pragma once

#include "tilepack/image/image.h"
#include "tilepack/tileset/material_map.h"

#include <cstddef>
#include <span>
#include <vector>

namespace tilepack {

/// A channel whose values are a roughness, or 1 minus one.
struct RoughnessChannel {
  std::size_t channel = 0;
  bool gloss = false;
  bool operator==(const RoughnessChannel&) const = default;
};

/// Those of a map of `channels` channels: of role roughness all but alpha (last of 2 or 4), of a packed map
/// the channels that it says hold roughness or gloss.
std::vector<RoughnessChannel> roughness_channels(const MapFormat& map, int channels);

/// Puts into a roughness level what the normal level of the same texels lost by averaging.
///
/// A texel of a coarse level stands for many unit normals n; their mean is stored as a unit vector, so their
/// spread would be lost and the surface would shine more with distance. The length of the mean before it is
/// made a unit vector tells the spread: for a Gaussian one of variance s², |mean n| = 1 / (1 + s²), hence
/// s² = (1 - |mean n|) / |mean n|   [Toksvig05]. There it is added to the variance 1 / power of a Blinn-Phong
/// lobe; a microfacet lobe of width a = roughness² has power 2 / a² - 2, near enough 2 / a², so
///
///   a'² = a² + 2 s²,     roughness' = a'^(1/2), at most 1.
///
/// `level`: plain values, of which only `channels` change. `mean_normals`: same size, 3 or 4 channels, means of
/// unit vectors, not renormalised. Means of equal vectors change nothing.
void add_normal_variance(Image& level, const Image& mean_normals, std::span<const RoughnessChannel> channels);

} // namespace tilepack
