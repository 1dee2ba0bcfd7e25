#include "tilepack/sampler/fast_tables.h"

#include "tilepack/mapping/even_pattern.h"
#include "tilepack/numeric/wrap.h"
#include "tilepack/sampler/address.h"

namespace tilepack {

using Lookup = FastTables::Lookup;

std::int32_t place_of_cell(const FastTables& t, std::int32_t x, std::int32_t y) {
  if (t.lookup == Lookup::index) return t.places[y * static_cast<std::int32_t>(t.width) + x];
  const std::int32_t x1 = x == t.width - 1 ? 0 : x + 1;
  const std::int32_t y1 = y == t.height - 1 ? 0 : y + 1;
  const int kh = t.horizontal_colors;
  const int kv = t.vertical_colors;
  const auto mixed_color = [](const MixKeys& keys, std::int32_t i, std::int32_t j, int colors) {
    return mix_color(keys, static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j), colors);
  };
  // The four colors as digits of one number, the bases alternating: the id in the complete set.
  const auto place = [&](int a, int b, int c, int d) { return t.places[((a * kv + b) * kh + c) * kv + d]; };
  switch (t.lookup) {
  case Lookup::permutation_edges: { // [Wei04, Eq. 2]
    const std::int32_t p = t.first[x];
    const std::int32_t q = t.second[y];
    return place(t.horizontal[p + y], t.vertical[x1 + q], t.horizontal[p + y1], t.vertical[x + q]);
  }
  case Lookup::permutation_corners: {
    const std::int32_t p = t.first[x];
    const std::int32_t p1 = t.first[x1];
    return place(t.horizontal[p + y], t.horizontal[p1 + y], t.horizontal[p + y1], t.horizontal[p1 + y1]);
  }
  case Lookup::mix_edges:
    return place(mixed_color(t.horizontal_keys, x, y, kh), mixed_color(t.vertical_keys, x1, y, kv),
                 mixed_color(t.horizontal_keys, x, y1, kh), mixed_color(t.vertical_keys, x, y, kv));
  case Lookup::mix_corners:
    return place(mixed_color(t.horizontal_keys, x, y, kh), mixed_color(t.horizontal_keys, x1, y, kh),
                 mixed_color(t.horizontal_keys, x, y1, kh), mixed_color(t.horizontal_keys, x1, y1, kh));
  case Lookup::even_corners: {
    constexpr std::int32_t last = (1 << even_block_bits) - 1;
    const bool one_block = (x & last) != last && (y & last) != last && x1 != 0 && y1 != 0;
    const auto word_at = [&](std::int32_t i, std::int32_t j) {
      return even_word(t.horizontal_keys, static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j));
    };
    const std::uint32_t word = word_at(x, y);
    const auto color = [&](std::int32_t i, std::int32_t j) {
      return even_color(one_block ? word : word_at(i, j), t.pattern, static_cast<std::uint32_t>(i),
                        static_cast<std::uint32_t>(j), kh);
    };
    return place(color(x, y), color(x1, y), color(x, y1), color(x1, y1));
  }
  default:
    return 0;
  }
}

void settle_coordinates(std::int32_t* tile, float* fraction, int count, std::int64_t side) {
  for (int i = 0; i < count; ++i) {
    TileCoordinate place = normalised({tile[i], static_cast<double>(fraction[i])});
    float rest = static_cast<float>(place.fraction);
    if (rest >= 1.0f) { // rounded up
      rest = 0.0f;
      ++place.tile;
    }
    tile[i] = static_cast<std::int32_t>(wrapped(place.tile, side));
    fraction[i] = rest;
  }
}

} // namespace tilepack
