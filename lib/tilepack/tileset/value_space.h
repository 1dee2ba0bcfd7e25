#pragma once

#include "tilepack/image/encoding.h"
#include "tilepack/tileset/material_map.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <span>

namespace tilepack {

/// What the values of a map are, as far as an average of them must know. Everything that averages texels
/// (mips, layouts, filters, views) does it the same way:
///
///   light     sRGB color is decoded to linear light before, encoded after: to_linear(), from_linear()
///   alpha     color with an alpha channel is weighed by it, so that what lies under clear texels doesn't
///             bleed; where all texels are clear, colors are averaged plainly
///   vectors   normals are averaged as vectors; only what is stored or shown is made a unit vector again
///   the rest  plainly
struct ValueSpace {
  Role role = Role::color;
  Encoding encoding = Encoding::srgb;
  int channels = 0; ///< 1..4

  /// The last channel is alpha, which weighs the others.
  bool has_alpha() const { return tilepack::has_alpha(role, channels); }
  /// The first three channels are a vector n, stored as n * 0.5 + 0.5.
  bool has_vectors() const { return role == Role::normal && channels >= 3; }
};

/// That of a TileMap (with a tile at least) or of a SampleMap.
inline ValueSpace value_space(const TileMap& map) {
  return {map.role, map.encoding, map.tiles.front().channels()};
}
inline ValueSpace value_space(const SampleMap& map) {
  return {map.role, map.encoding, map.image.channels()};
}

/// The vector in the first three channels, stored as n * 0.5 + 0.5, at length 1; that of length 0 stays.
template <typename T>
void renormalise(std::span<T> stored) {
  const auto component = [&](std::size_t c) { return 2 * static_cast<double>(stored[c]) - 1; };
  double square = 0;
  for (std::size_t c = 0; c < 3; ++c) square += component(c) * component(c);
  if (!(square > 0)) return;
  const double length = std::sqrt(square);
  for (std::size_t c = 0; c < 3; ++c) stored[c] = static_cast<T>(0.5 + 0.5 * (component(c) / length));
}

/// The weighted mean of linear values, in doubles. Colors are summed weighed by alpha (`weighed`) and plainly
/// (`plain`), for the case that no texel has any.
struct ValueSums {
  static constexpr std::size_t max_channels = 4;
  std::array<double, max_channels> weighed{};
  std::array<double, max_channels> plain{};

  /// `alpha`: the last channel is one.
  template <typename T>
  void add(std::span<const T> value, double weight, bool alpha) {
    const double coverage = alpha ? static_cast<double>(value.back()) : 1.0;
    for (std::size_t c = 0; c < value.size(); ++c) {
      plain[c] += weight * static_cast<double>(value[c]);
      weighed[c] += weight * coverage * static_cast<double>(value[c]);
    }
  }

  /// The mean; `total` is what the weights added up to, above 0.
  void resolve(std::span<double> out, bool alpha, double total = 1.0) const {
    const double coverage = alpha ? plain[out.size() - 1] : 1.0;
    for (std::size_t c = 0; c < out.size(); ++c)
      out[c] = alpha && coverage != 0.0 ? weighed[c] / coverage : plain[c] / total;
    if (alpha) out.back() = coverage / total;
  }
};

} // namespace tilepack
