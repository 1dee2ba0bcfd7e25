#include "tilepack/mapping/mapping.h"

#include "tilepack/error/error.h"
#include "tilepack/mapping/even_pattern.h"
#include "tilepack/mapping/mix_hash.h"
#include "tilepack/numeric/random.h"
#include "tilepack/numeric/wrap.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>

namespace tilepack {
namespace {

constexpr std::int64_t longest_side = std::int64_t{1} << 31;
constexpr std::int64_t longest_permutation_side = 4096;
constexpr std::int64_t most_index_cells = std::int64_t{1} << 26;

void check_size(VirtualSize size, std::int64_t longest, const char* way_out) {
  if (size.width < 1 || size.height < 1 || size.width > longest || size.height > longest)
    throw Error(ErrorKind::usage, "--virtual-size",
                fmt::format("{}x{} tiles is out of range; each side must be 1 to {}{}", size.width,
                            size.height, longest, way_out));
}

// P[i mod n]; i is never negative here.
std::int64_t entry(const std::vector<int>& table, std::int64_t i) {
  return table[static_cast<std::size_t>(i % static_cast<std::int64_t>(table.size()))];
}

// The three families of lattice colors. x and y are already within the virtual texture.
int horizontal_color(const Mapping& m, int colors, std::int64_t x, std::int64_t y) {
  if (m.kind == MappingKind::mix) return mix_color(m.seed, MixAxis::horizontal, x, y, colors);
  return static_cast<int>(entry(m.table, entry(m.table, x) + y) % colors); // [Wei04, Eq. 2]
}

int vertical_color(const Mapping& m, int colors, std::int64_t x, std::int64_t y) {
  if (m.kind == MappingKind::mix) return mix_color(m.seed, MixAxis::vertical, x, y, colors);
  return static_cast<int>(entry(m.table, x + entry(m.table, 2 * y)) % colors); // [Wei04, Eq. 2]
}

int corner_color(const Mapping& m, int colors, std::int64_t x, std::int64_t y) {
  if (m.kind == MappingKind::mix) return mix_color(m.seed, MixAxis::corner, x, y, colors);
  if (m.kind == MappingKind::even)
    return even_color(mix_keys(m.seed, MixAxis::corner), m.table.data(), static_cast<std::uint32_t>(x),
                      static_cast<std::uint32_t>(y), colors);
  return static_cast<int>(entry(m.table, entry(m.table, x) + y) % colors);
}

// A coordinate and the next one, both within 0..side-1. Wrapping before adding keeps any std::int64_t valid.
struct Neighbours {
  std::int64_t here = 0;
  std::int64_t next = 0;
};

Neighbours within(std::int64_t i, std::int64_t side) {
  const std::int64_t here = wrapped(i, side);
  return {here, here + 1 == side ? 0 : here + 1};
}

} // namespace

std::string_view name_of(MappingKind kind) {
  switch (kind) {
  case MappingKind::permutation:
    return "permutation";
  case MappingKind::mix:
    return "mix";
  case MappingKind::even:
    return "even";
  case MappingKind::index:
    break;
  }
  return "index";
}

std::vector<int> permutation_table(int length, std::uint64_t seed) {
  std::vector<int> table(static_cast<std::size_t>(length));
  std::iota(table.begin(), table.end(), 0);
  for (int i = length - 1; i > 0; --i) {
    const std::uint32_t j =
        random_below(seed, "permutation", static_cast<std::uint64_t>(i), static_cast<std::uint32_t>(i) + 1);
    std::swap(table[static_cast<std::size_t>(i)], table[j]);
  }
  return table;
}

Mapping permutation_mapping(VirtualSize size, const ColorCounts& colors, std::uint64_t seed) {
  check_size(size, longest_permutation_side, "; for a larger texture take the mapping \"mix\"");
  std::int64_t unit = 1;
  for (const int count : {colors.horizontal, colors.vertical, colors.corner})
    if (count > 0) unit = std::lcm(unit, static_cast<std::int64_t>(count));
  const std::int64_t least = 2 * std::max(size.width, size.height);
  const std::int64_t length = (least + unit - 1) / unit * unit;

  Mapping mapping;
  mapping.kind = MappingKind::permutation;
  mapping.size = size;
  mapping.table = permutation_table(static_cast<int>(length), seed);
  return mapping;
}

Mapping mix_mapping(VirtualSize size, std::uint64_t seed) {
  check_size(size, longest_side, "");
  Mapping mapping;
  mapping.kind = MappingKind::mix;
  mapping.size = size;
  mapping.seed = seed;
  return mapping;
}

Mapping even_mapping(VirtualSize size, int corners, std::uint64_t seed) {
  check_size(size, longest_side, "");
  if (!has_even_pattern(corners))
    throw Error(
        ErrorKind::usage, "--mapping",
        fmt::format("'even' has patterns for 2 to 4 corner colors, not for {}; take the mapping \"mix\"",
                    corners == 0 ? std::string("edge colors") : std::to_string(corners)));
  Mapping mapping;
  mapping.kind = MappingKind::even;
  mapping.size = size;
  mapping.table = even_pattern(corners);
  mapping.seed = seed;
  return mapping;
}

Mapping index_mapping(const Mapping& mapping, const ColorCounts& colors) {
  check_size(mapping.size, longest_side, "");
  if (mapping.size.width > most_index_cells / mapping.size.height)
    throw Error(ErrorKind::usage, "--virtual-size",
                fmt::format("an index map of {}x{} tiles is too large to store; up to {} cells are, or take "
                            "the mapping \"mix\"",
                            mapping.size.width, mapping.size.height, most_index_cells));
  Mapping index;
  index.kind = MappingKind::index;
  index.size = mapping.size;
  index.ids.reserve(static_cast<std::size_t>(mapping.size.width * mapping.size.height));
  for (std::int64_t y = 0; y < mapping.size.height; ++y)
    for (std::int64_t x = 0; x < mapping.size.width; ++x) index.ids.push_back(tile_at(mapping, colors, x, y));
  return index;
}

EdgeTile edge_tile_at(const Mapping& mapping, const ColorCounts& colors, std::int64_t x, std::int64_t y) {
  const auto [x0, x1] = within(x, mapping.size.width);
  const auto [y0, y1] = within(y, mapping.size.height);
  return {
      horizontal_color(mapping, colors.horizontal, x0, y0), vertical_color(mapping, colors.vertical, x1, y0),
      horizontal_color(mapping, colors.horizontal, x0, y1), vertical_color(mapping, colors.vertical, x0, y0)};
}

CornerTile corner_tile_at(const Mapping& mapping, const ColorCounts& colors, std::int64_t x, std::int64_t y) {
  const auto [x0, x1] = within(x, mapping.size.width);
  const auto [y0, y1] = within(y, mapping.size.height);
  return {corner_color(mapping, colors.corner, x0, y0), corner_color(mapping, colors.corner, x1, y0),
          corner_color(mapping, colors.corner, x0, y1), corner_color(mapping, colors.corner, x1, y1)};
}

int tile_at(const Mapping& mapping, const ColorCounts& colors, std::int64_t x, std::int64_t y) {
  if (mapping.kind == MappingKind::index) {
    const std::int64_t cell =
        wrapped(y, mapping.size.height) * mapping.size.width + wrapped(x, mapping.size.width);
    return mapping.ids[static_cast<std::size_t>(cell)];
  }
  if (colors.corner > 0) return id_in_complete_set(corner_tile_at(mapping, colors, x, y), colors.corner);
  return id_in_complete_set(edge_tile_at(mapping, colors, x, y), colors.horizontal, colors.vertical);
}

} // namespace tilepack
