#include "tilepack/mapping/mapping.h"

#include "tilepack/error/error.h"
#include "tilepack/mapping/even_pattern.h"
#include "tilepack/mapping/even_variants.h"
#include "tilepack/mapping/index_size.h"
#include "tilepack/mapping/mix_hash.h"
#include "tilepack/numeric/random.h"
#include "tilepack/numeric/wrap.h"
#include "tilepack/tileset/limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>

namespace tilepack {
namespace {

void check_size(VirtualSize size, std::int64_t longest, const char* way_out) {
  if (size.width < 1 || size.height < 1 || size.width > longest || size.height > longest)
    throw Error(ErrorKind::usage, field("virtual-size"),
                fmt::format("{}x{} tiles is out of range; each side must be 1 to {}{}", size.width,
                            size.height, longest, way_out));
}

} // namespace

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
  check_size(size, limits::longest_permutation_side_made, "; for a larger texture take the mapping \"mix\"");
  std::int64_t unit = 1;
  for (const int count : {colors.horizontal, colors.vertical, colors.corner, colors.variants})
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
  check_size(size, limits::longest_virtual_side, "");
  Mapping mapping;
  mapping.kind = MappingKind::mix;
  mapping.size = size;
  mapping.seed = seed;
  return mapping;
}

Mapping even_mapping(VirtualSize size, int corners, std::uint64_t seed, int variants) {
  check_size(size, limits::longest_virtual_side, "");
  if (!has_even_pattern(corners))
    throw Error(
        ErrorKind::usage, field("mapping"),
        fmt::format("'even' has patterns for 2 to 4 corner colors, not for {}; take the mapping \"mix\"",
                    corners == 0 ? std::string("edge colors") : std::to_string(corners)));
  Mapping mapping;
  mapping.kind = MappingKind::even;
  mapping.size = size;
  mapping.table = even_pattern(corners);
  if (variants > 1) mapping.variants = even_variants(mapping.table, corners, variants);
  mapping.seed = seed;
  return mapping;
}

Mapping index_mapping(const Mapping& mapping, const ColorCounts& colors) {
  check_size(mapping.size, limits::longest_virtual_side, "");
  if (mapping.size.width > limits::most_index_cells / mapping.size.height)
    throw Error(
        ErrorKind::usage, field("virtual-size"),
        fmt::format("an index map of {0}x{1} tiles is too large to store; up to {2} cells are, such as "
                    "{3}x{3}, or take the mapping \"mix\"",
                    mapping.size.width, mapping.size.height, limits::most_index_cells,
                    largest_index_square()));
  Mapping index;
  index.kind = MappingKind::index;
  index.size = mapping.size;
  index.ids.reserve(static_cast<std::size_t>(mapping.size.width * mapping.size.height));
  for (std::int64_t y = 0; y < mapping.size.height; ++y)
    for (std::int64_t x = 0; x < mapping.size.width; ++x) index.ids.push_back(tile_at(mapping, colors, x, y));
  return index;
}

LatticeWords lattice_words(const Mapping& mapping, const ColorCounts& colors) {
  const bool corners = colors.corner > 0;
  LatticeWords words;
  words.kind = mapping.kind;
  words.corner_colored = corners ? 1 : 0;
  words.width = static_cast<std::uint32_t>(mapping.size.width);
  words.height = static_cast<std::uint32_t>(mapping.size.height);
  words.horizontal_colors = static_cast<std::uint32_t>(corners ? colors.corner : colors.horizontal);
  words.vertical_colors = static_cast<std::uint32_t>(corners ? colors.corner : colors.vertical);
  if (mapping.kind == MappingKind::mix || mapping.kind == MappingKind::even) {
    words.horizontal_keys = mix_keys(mapping.seed, corners ? MixAxis::corner : MixAxis::horizontal);
    words.vertical_keys = mix_keys(mapping.seed, MixAxis::vertical);
  }
  words.variants = static_cast<std::uint32_t>(colors.variants);
  words.variant_keys = mix_keys(mapping.seed, MixAxis::variant);
  words.variant_pattern = mapping.variants.data();
  words.table_length = static_cast<std::uint32_t>(mapping.table.size());
  words.table = mapping.table.data();
  words.ids = mapping.ids.data();
  return words;
}

LatticeCell cell_at(const LatticeWords& words, std::int64_t x, std::int64_t y) {
  return {static_cast<std::uint32_t>(wrapped(x, std::int64_t{words.width})),
          static_cast<std::uint32_t>(wrapped(y, std::int64_t{words.height}))};
}

EdgeTile edge_tile_at(const Mapping& mapping, const ColorCounts& colors, std::int64_t x, std::int64_t y) {
  const LatticeWords words = lattice_words(mapping, colors);
  const CellColors cell = colors_of_cell(words, cell_at(words, x, y));
  return {static_cast<int>(cell.a), static_cast<int>(cell.b), static_cast<int>(cell.c),
          static_cast<int>(cell.d)};
}

CornerTile corner_tile_at(const Mapping& mapping, const ColorCounts& colors, std::int64_t x, std::int64_t y) {
  const LatticeWords words = lattice_words(mapping, colors);
  const CellColors cell = colors_of_cell(words, cell_at(words, x, y));
  return {static_cast<int>(cell.a), static_cast<int>(cell.b), static_cast<int>(cell.c),
          static_cast<int>(cell.d)};
}

int tile_at(const Mapping& mapping, const ColorCounts& colors, std::int64_t x, std::int64_t y) {
  const LatticeWords words = lattice_words(mapping, colors);
  return static_cast<int>(tile_of_cell(words, cell_at(words, x, y)));
}

} // namespace tilepack
