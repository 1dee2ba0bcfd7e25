#include "tilepack/check/structure_checks.h"
#include "tilepack/check/tile_border.h"

#include <fmt/format.h>

#include <algorithm>

namespace tilepack {
namespace {

constexpr std::int64_t max_side = std::int64_t{1} << 31;

void check_permutation(const Pack& pack, std::vector<Issue>& issues) {
  const std::vector<int>& table = pack.mapping.table;
  const auto n = static_cast<std::int64_t>(table.size());
  std::vector<int> first_at(table.size(), -1);
  bool permutation = n > 0;
  for (int i = 0; i < n && permutation; ++i) {
    const int value = table[i];
    if (value < 0 || value >= n) {
      issues.push_back({Rule::table_not_permutation, fmt::format("mapping.table[{}]", i),
                        std::to_string(value), fmt::format("0 to {}", n - 1)});
      permutation = false;
    } else if (first_at[value] >= 0) {
      issues.push_back({Rule::table_not_permutation, fmt::format("mapping.table[{}]", i),
                        fmt::format("{}, which stands at [{}] too", value, first_at[value]),
                        fmt::format("each of 0 to {} once", n - 1)});
      permutation = false;
    } else {
      first_at[value] = i;
    }
  }
  if (n == 0) issues.push_back({Rule::table_not_permutation, "mapping.table", "no entries", "at least one"});
  if (!permutation) return;

  // Rows: V(x,y) reads P[2y mod n], so y and y + n/2 are alike for even n. Columns: both colors read P[x].
  const std::int64_t row_period = n % 2 == 0 ? n / 2 : n;
  const VirtualSize& size = pack.mapping.size;
  if (size.height > row_period)
    issues.push_back(
        {Rule::table_repeats_rows, "mapping.table",
         fmt::format("{} entries repeat every {} rows, the texture has {}", n, row_period, size.height),
         fmt::format("an even length of at least {}", 2 * size.height)});
  if (size.width > n)
    issues.push_back({Rule::table_repeats_rows, "mapping.table",
                      fmt::format("{} entries repeat every {} columns, the texture has {}", n, n, size.width),
                      fmt::format("at least {} entries", size.width)});
  for (const int colors :
       {pack.colors.horizontal, pack.colors.vertical, pack.colors.corner, pack.colors.variants})
    if (colors > 0 && n % colors != 0) {
      issues.push_back({Rule::table_biased, "mapping.table",
                        fmt::format("{} entries for {} colors or variants", n, colors),
                        fmt::format("a multiple of {}", colors)});
      break;
    }
}

void check_index(const Pack& pack, std::vector<Issue>& issues) {
  const Mapping& mapping = pack.mapping;
  const std::int64_t width = mapping.size.width;
  const std::int64_t height = mapping.size.height;
  if (static_cast<std::int64_t>(mapping.ids.size()) != width * height) {
    issues.push_back({Rule::index_size, "mapping", fmt::format("{} cells", mapping.ids.size()),
                      fmt::format("{} x {} = {} cells", width, height, width * height)});
    return;
  }
  const int tiles = tile_count(pack.tiles);
  const auto id_at = [&](std::int64_t x, std::int64_t y) {
    return mapping.ids[static_cast<std::size_t>((y % height) * width + x % width)];
  };
  const auto legal = [&](int id) { return id >= 0 && id < tiles; };
  const auto fits = [&](int id, Side side, int neighbour, Side facing) {
    return !legal(neighbour) || border_key(pack.tiles, id, side) == border_key(pack.tiles, neighbour, facing);
  };
  std::int64_t bad_ids = 0;
  std::int64_t bad_borders = 0;
  std::string first_id;
  std::string first_border;
  for (std::int64_t y = 0; y < height; ++y)
    for (std::int64_t x = 0; x < width; ++x) {
      const int id = id_at(x, y);
      if (!legal(id)) {
        if (bad_ids++ == 0) first_id = fmt::format("tile {} at cell ({}, {})", id, x, y);
        continue;
      }
      const bool east = fits(id, Side::east, id_at(x + 1, y), Side::west);
      const bool south = fits(id, Side::south, id_at(x, y + 1), Side::north);
      if (east && south) continue;
      if (bad_borders == 0)
        first_border = fmt::format("tile {} at cell ({}, {}) and tile {} to its {}", id, x, y,
                                   east ? id_at(x, y + 1) : id_at(x + 1, y), east ? "south" : "east");
      bad_borders += (east ? 0 : 1) + (south ? 0 : 1);
    }
  if (bad_ids > 0)
    issues.push_back({Rule::index_id, "mapping, index map",
                      fmt::format("{} cells, the first: {}", bad_ids, first_id),
                      fmt::format("0 to {}", tiles - 1)});
  if (bad_borders > 0)
    issues.push_back({Rule::index_colors, "mapping, index map",
                      fmt::format("{} borders, the first: {}", bad_borders, first_border),
                      "the same color on both sides"});
}

} // namespace

std::vector<Issue> check_mapping(const Pack& pack) {
  std::vector<Issue> issues;
  const VirtualSize& size = pack.mapping.size;
  if (size.width < 1 || size.height < 1 || size.width > max_side || size.height > max_side) {
    issues.push_back({Rule::virtual_size, "mapping.virtual_size",
                      fmt::format("{} x {} tiles", size.width, size.height),
                      fmt::format("1 to {} a side", max_side)});
    return issues;
  }
  if (pack.mapping.kind == MappingKind::permutation) check_permutation(pack, issues);
  if (pack.mapping.kind == MappingKind::index) check_index(pack, issues);
  return issues;
}

} // namespace tilepack
