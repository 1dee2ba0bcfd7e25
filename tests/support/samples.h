#pragma once

#include "support/images.h"

#include "tilepack/exemplar/feature_image.h"
#include "tilepack/synth/synthesize.h"
#include "tilepack/tileset/source_map.h"

#include <cmath>

namespace tilepack::testing {

/// A sample of soft random blobs in three channels: the mean of noise over squares that reach so far from their
/// middle, so neighbours are alike.
inline Image blobs(int width, int height, std::uint64_t seed = 1, int channels = 3, int reach = 3) {
  const Image noise = test::noise(width, height, channels, seed, Depth::u8, "blobs");
  Image image(width, height, channels);
  const auto side = static_cast<float>(2 * reach + 1);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < channels; ++c) {
        float sum = 0.0f;
        for (int dy = -reach; dy <= reach; ++dy)
          for (int dx = -reach; dx <= reach; ++dx)
            sum += noise.texel((x + dx + width) % width,
                               (y + dy + height) % height)[static_cast<std::size_t>(c)];
        image.texel(x, y)[static_cast<std::size_t>(c)] = sum / (side * side);
      }
  // Spread to the whole range, so that differences are large.
  for (float& v : image.data()) v = std::min(1.0f, std::max(0.0f, (v - 0.5f) * (5.0f * side / 7.0f) + 0.5f));
  return image;
}

/// Two colors of edges in each direction, or of corners.
inline SynthOptions two_colors(Size tile, Coloring coloring, int effort) {
  SynthOptions options;
  options.tile_size = tile;
  options.coloring = coloring;
  options.colors = coloring == Coloring::edge ? ColorCounts{2, 2, 0} : ColorCounts{0, 0, 2};
  options.effort = effort;
  return options;
}

inline SampleMap color_map(Image image) {
  return {"color", Role::color, Encoding::srgb, Depth::u8, std::move(image)};
}

inline FeatureImage features(const Image& image) {
  const SampleMap map = color_map(image);
  return feature_image({&map, 1});
}

} // namespace tilepack::testing
