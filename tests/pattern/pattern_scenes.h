#pragma once

#include "support/images.h"

#include "tilepack/numeric/random.h"
#include "tilepack/pattern/pattern_graph.h"
#include "tilepack/pattern/pattern_texture.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace tilepack::test {

/// Sets of patterns and graphs for tests: a graph grows by add(), which names nodes and gives their numbers.
struct Scene {
  PatternGraph graph;

  explicit Scene(std::int64_t units = 1024, Size unit = {16, 16}, int channels = 3) {
    graph.scene = {units, units};
    graph.unit = unit;
    graph.maps = {{"color", Role::color, channels}};
  }
  NodeId add(PatternBlock block) {
    graph.nodes.push_back({fmt::format("n{}", graph.nodes.size()), std::move(block)});
    graph.output = static_cast<NodeId>(graph.nodes.size()) - 1;
    return graph.output;
  }
  PatternGrid grid() const { return graph.scene; }
  NodeId random(int values, int stream = 0, HashKind hash = HashKind::mix) {
    return add(RandomIndex{grid(), values, 7, stream, hash});
  }
  NodeId number(double low, double high, int stream) {
    return add(RandomNumber{grid(), low, high, 7, stream});
  }
  NodeId constant(double red, double green = 0, double blue = 0) {
    return add(ConstantTexture{{{red, green, blue}}});
  }
};

/// Random linear patterns.
inline std::vector<Image> noise_patterns(int count, Size size, int channels = 3) {
  std::vector<Image> images;
  for (int i = 0; i < count; ++i)
    images.push_back(
        noise(size.width, size.height, channels, static_cast<std::uint64_t>(100 + i), Depth::f32));
  return images;
}

/// A soft spot on clear ground, of a color of its own.
inline std::vector<Image> spots(int count, int side) {
  std::vector<Image> images;
  for (int i = 0; i < count; ++i) {
    Image image(side, side, 4);
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        const double dx = (x + 0.5) / side - 0.5, dy = (y + 0.5) / side - 0.5;
        const double alpha = std::max(0.0, 1 - 5 * (dx * dx + dy * dy));
        const auto texel = image.texel(x, y);
        texel[0] = static_cast<float>(i + 1) / static_cast<float>(count);
        texel[1] = static_cast<float>(x) / static_cast<float>(side);
        texel[2] = 0.5f;
        texel[3] = static_cast<float>(alpha);
      }
    images.push_back(image);
  }
  return images;
}

inline std::shared_ptr<const PatternSource> pattern_source(const std::vector<Image>& images) {
  const MapFormat format{"color", Role::color, Encoding::linear, Depth::f32};
  return source_of(std::make_shared<const Pack>(pattern_pack(images, format)), "patterns");
}

/// The value at a place, `width` units a pixel.
inline std::vector<double> value_at(const PatternTexture& texture, TileCoordinate u, TileCoordinate v,
                                    double width) {
  std::vector<double> out(static_cast<std::size_t>(texture.channels()));
  texture.sample(u, v, {width, 0, 0, width}, out);
  return out;
}

inline double difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0;
  for (std::size_t c = 0; c < a.size(); ++c) largest = std::max(largest, std::fabs(a[c] - b[c]));
  return largest;
}

/// A random number of 0..1.
inline double chance(const char* what, std::uint64_t k) {
  return random_below(17, what, k, 1u << 30) / static_cast<double>(1u << 30);
}

} // namespace tilepack::test
