#include "tilepack/mip/level_values.h"

#include "tilepack/image/encoding.h"
#include "tilepack/mip/srgb_tables.h"
#include "tilepack/tileset/value_space.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace tilepack {
namespace {

std::size_t channels_of(const TileMap& map) {
  return static_cast<std::size_t>(map.tiles.front().channels());
}

void make_unit(float* n) {
  const double squares =
      static_cast<double>(n[0]) * n[0] + static_cast<double>(n[1]) * n[1] + static_cast<double>(n[2]) * n[2];
  if (!(squares > 0)) {
    n[2] = 1.0f;
    return;
  }
  const double length = std::sqrt(squares);
  for (int c = 0; c < 3; ++c) n[c] = static_cast<float>(n[c] / length);
}

void make_unit(std::span<float> texels, std::size_t channels) {
  for (std::size_t i = 0; i < texels.size(); i += channels) make_unit(&texels[i]);
}

bool is_srgb(const TileMap& map) {
  return is_light(map.role) && map.encoding == Encoding::srgb;
}

void copy(std::span<const float> from, std::span<float> to) {
  if (from.data() != to.data()) std::copy(from.begin(), from.end(), to.begin());
}

} // namespace

void decode(std::span<const float> from, const TileMap& map, std::span<float> to) {
  const std::size_t channels = channels_of(map);
  if (map.role == Role::normal) {
    for (std::size_t i = 0; i < from.size(); ++i) to[i] = from[i] * 2.0f - 1.0f;
    if (value_space(map).has_vectors()) make_unit(to, channels);
    return;
  }
  copy(from, to);
  if (!is_srgb(map)) return;
  const auto colors = static_cast<std::size_t>(color_channels(static_cast<int>(channels)));
  for (std::size_t i = 0; i < to.size(); i += channels)
    for (std::size_t c = 0; c < colors; ++c)
      to[i + c] = static_cast<float>(srgb_to_linear(static_cast<double>(to[i + c])));
}

void encode(std::span<const float> from, const TileMap& map, std::span<float> to) {
  if (is_srgb(map)) return encode_srgb(from, static_cast<int>(channels_of(map)), to);
  copy(from, to);
  if (map.role != Role::normal) return;
  if (value_space(map).has_vectors()) make_unit(to, channels_of(map));
  for (float& v : to) v = v * 0.5f + 0.5f;
}

void halve_decoded(std::span<const float> north, std::span<const float> south, const TileMap& map,
                   std::span<float> to) {
  const int channels = map.tiles.front().channels();
  if (is_srgb(map) && map.depth == Depth::u8 && halve_srgb_codes(north, south, channels, to)) return;
  if (!is_srgb(map) && map.role != Role::normal)
    return halve_rows(north, south, channels, weighting_of(map), to);
  std::vector<float> decoded(2 * north.size());
  const auto north_decoded = std::span(decoded).first(north.size());
  const auto south_decoded = std::span(decoded).last(north.size());
  decode(north, map, north_decoded);
  decode(south, map, south_decoded);
  halve_rows(north_decoded, south_decoded, channels, weighting_of(map), to);
}

Weighting weighting_of(const TileMap& map) {
  return !map.tiles.empty() && value_space(map).has_alpha() ? Weighting::by_alpha : Weighting::plain;
}

} // namespace tilepack
