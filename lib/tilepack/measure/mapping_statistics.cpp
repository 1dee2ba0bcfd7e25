#include "tilepack/measure/mapping_statistics.h"

#include "tilepack/error/error.h"
#include "tilepack/mapping/even_pattern.h"
#include "tilepack/measure/longest_repeat.h"
#include "tilepack/numeric/grid.h"
#include "tilepack/numeric/random.h"
#include "tilepack/tileset/limits.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>

namespace tilepack {
namespace {

// The values of one family over the window, row by row.
struct Field {
  std::string name;
  int values = 0; // 0..values-1
  double bits_a_cell_in_rows = 0;
  double bits_a_cell_in_columns = 0;
  Grid<int> cells;
};

Field field(std::string name, VirtualSize window, int values, const std::function<int(int, int)>& value_at) {
  Field f;
  f.name = std::move(name);
  f.cells = Grid<int>(static_cast<int>(window.width), static_cast<int>(window.height));
  f.values = values;
  f.bits_a_cell_in_rows = f.bits_a_cell_in_columns = std::log2(values);
  for (int y = 0; y < f.cells.height; ++y)
    for (int x = 0; x < f.cells.width; ++x) f.cells.at(x, y) = value_at(x, y);
  return f;
}

// A tile shares an edge with the one before it, so a cell brings fewer new bits than a tile has: along a row
// two horizontal edges and one vertical one; along a column the other way; of corners two.
std::vector<Field> fields(const Mapping& m, const ColorCounts& colors, VirtualSize window) {
  std::vector<Field> all;
  const bool by_corner = colors.corner > 0;
  int tiles = combinations(colors) * colors.variants;
  if (m.kind == MappingKind::index) // of any set, complete or not
    for (const int id : m.ids) tiles = std::max(tiles, id + 1);
  all.push_back(field("tiles", window, tiles, [&](int x, int y) { return tile_at(m, colors, x, y); }));
  Field& f = all.front();
  if (by_corner)
    f.bits_a_cell_in_rows = f.bits_a_cell_in_columns = 2 * std::log2(colors.corner);
  else {
    f.bits_a_cell_in_rows = 2 * std::log2(colors.horizontal) + std::log2(colors.vertical);
    f.bits_a_cell_in_columns = std::log2(colors.horizontal) + 2 * std::log2(colors.vertical);
  }
  f.bits_a_cell_in_rows += std::log2(colors.variants);
  f.bits_a_cell_in_columns += std::log2(colors.variants);
  if (m.kind == MappingKind::index) return all;
  if (colors.variants > 1)
    all.push_back(field("variants", window, colors.variants,
                        [&](int x, int y) { return tile_at(m, colors, x, y) / combinations(colors); }));
  if (by_corner) {
    all.push_back(field("corners", window, colors.corner,
                        [&](int x, int y) { return corner_tile_at(m, colors, x, y).nw; }));
    return all;
  }
  all.push_back(field("horizontal edges", window, colors.horizontal,
                      [&](int x, int y) { return edge_tile_at(m, colors, x, y).north; }));
  all.push_back(field("vertical edges", window, colors.vertical,
                      [&](int x, int y) { return edge_tile_at(m, colors, x, y).west; }));
  return all;
}

void count_values(const Field& f, FamilyStatistics& s) {
  s.counts.assign(static_cast<std::size_t>(f.values), 0);
  for (const int v : f.cells.values) ++s.counts[static_cast<std::size_t>(v)];
  s.degrees = f.values - 1;
  const double expected = static_cast<double>(f.cells.values.size()) / f.values;
  for (const std::int64_t count : s.counts) {
    const double off = static_cast<double>(count) - expected;
    s.chi_square += off * off / expected;
  }
  if (s.degrees == 0) return;
  // The cube root of chi-square over its degrees is close to normal.
  const double narrow = 2.0 / (9.0 * s.degrees);
  s.chi_square_sigmas = (std::cbrt(s.chi_square / s.degrees) - (1 - narrow)) / std::sqrt(narrow);
}

// The pairs one lag apart in direction (dx, dy).
PairCorrelation pairs_at(const Field& f, int lag, int dx, int dy) {
  const int sx = lag * dx;
  const int sy = lag * dy;
  std::int64_t equal = 0;
  std::int64_t pairs = 0;
  for (int y = std::max(0, -sy); y < std::min(f.cells.height, f.cells.height - sy); ++y)
    for (int x = 0; x < f.cells.width - sx; ++x) {
      equal += f.cells.at(x, y) == f.cells.at(x + sx, y + sy);
      ++pairs;
    }
  PairCorrelation c;
  c.lag = lag;
  c.expected = 1.0 / f.values;
  if (pairs == 0) return c;
  c.equal = static_cast<double>(equal) / static_cast<double>(pairs);
  const double deviation = std::sqrt(c.expected * (1 - c.expected) / static_cast<double>(pairs));
  if (deviation > 0) c.sigmas = (c.equal - c.expected) / deviation;
  return c;
}

PairCorrelation worst_pairs(const Field& f, int dx, int dy) {
  const int reach = dx == 0   ? f.cells.height
                    : dy == 0 ? f.cells.width
                              : std::min(f.cells.width, f.cells.height);
  PairCorrelation worst;
  worst.expected = 1.0 / f.values;
  for (int lag = 1; lag <= reach / 2; ++lag) {
    const PairCorrelation c = pairs_at(f, lag, dx, dy);
    if (worst.lag == 0 || std::abs(c.sigmas) > std::abs(worst.sigmas)) worst = c;
  }
  return worst;
}

int period(const Field& f, int dx, int dy) {
  const int reach = dx > 0 ? f.cells.width : f.cells.height;
  for (int lag = 1; lag <= reach / 2; ++lag)
    if (pairs_at(f, lag, dx, dy).equal == 1.0) return lag;
  return 0;
}

// All rows (or columns) end to end, each closed by a value of its own so that no run crosses an end.
RepeatedRun longest_run(const Field& f, bool in_rows) {
  const int lines = in_rows ? f.cells.height : f.cells.width;
  const int length = in_rows ? f.cells.width : f.cells.height;
  std::vector<int> text;
  text.reserve(f.cells.values.size() + static_cast<std::size_t>(lines));
  for (int line = 0; line < lines; ++line) {
    for (int i = 0; i < length; ++i) text.push_back(in_rows ? f.cells.at(i, line) : f.cells.at(line, i));
    text.push_back(f.values + line);
  }
  const LongestRepeat repeat = longest_repeat(text);
  RepeatedRun run;
  run.length = repeat.length;
  // Among N places there are N²/2 pairs, and each goes on for L cells with probability 2^(-bits L).
  const double bits = in_rows ? f.bits_a_cell_in_rows : f.bits_a_cell_in_columns;
  const double places = static_cast<double>(f.cells.values.size());
  run.by_chance = bits > 0 ? std::min<double>(length, (2 * std::log2(places) - 1) / bits) : length;
  for (int k = 0; k < 2; ++k) {
    const int line = repeat.start[k] / (length + 1);
    const int i = repeat.start[k] % (length + 1);
    run.x[k] = in_rows ? i : line;
    run.y[k] = in_rows ? line : i;
  }
  return run;
}

FamilyStatistics statistics_of(const Field& f) {
  FamilyStatistics s;
  s.name = f.name;
  count_values(f, s);
  if (f.values == 1) return s; // one value: everything repeats, and must
  s.along_rows = worst_pairs(f, 1, 0);
  s.along_columns = worst_pairs(f, 0, 1);
  s.along_diagonals = worst_pairs(f, 1, 1);
  s.against_diagonals = worst_pairs(f, 1, -1);
  s.longest_in_rows = longest_run(f, true);
  s.longest_in_columns = longest_run(f, false);
  s.row_period = period(f, 1, 0);
  s.column_period = period(f, 0, 1);
  return s;
}

constexpr double far_off = 6.0; // standard deviations: chance does not get there among a few thousand tests

void note_faults(const FamilyStatistics& s, MappingKind kind, std::vector<std::string>& faults) {
  // Rows of the even pattern return in other blocks. Pairs near to each other are rarely equal, that is what
  // it is for, and those a little further apart more often.
  const bool even = kind == MappingKind::even;
  constexpr double block = 1 << even_block_bits;
  if (s.row_period > 0)
    faults.push_back(fmt::format("{}: every row repeats after {} cells", s.name, s.row_period));
  if (s.column_period > 0)
    faults.push_back(fmt::format("{}: every column repeats after {} cells", s.name, s.column_period));
  const auto note_run = [&](const RepeatedRun& run, const char* where) {
    if (run.length > 2 * run.by_chance && !(even && run.length <= block + run.by_chance))
      faults.push_back(
          fmt::format("{}: {} cells along a {} occur twice, from ({}, {}) and ({}, {}); chance makes "
                      "about {:.0f}",
                      s.name, run.length, where, run.x[0], run.y[0], run.x[1], run.y[1], run.by_chance));
  };
  note_run(s.longest_in_rows, "row");
  note_run(s.longest_in_columns, "column");
  const auto note_pairs = [&](const PairCorrelation& c, const char* direction) {
    if (even && (s.name != "tiles" || c.equal < 1.5 * c.expected || c.lag >= block)) return;
    if (std::abs(c.sigmas) > far_off)
      faults.push_back(fmt::format("{}: {:.1f} % of the cells {} {} apart are equal, expected are {:.1f} %",
                                   s.name, 100 * c.equal, c.lag, direction, 100 * c.expected));
  };
  note_pairs(s.along_rows, "along rows");
  note_pairs(s.along_columns, "along columns");
  note_pairs(s.along_diagonals, "along diagonals");
  note_pairs(s.against_diagonals, "against diagonals");
  if (s.chi_square_sigmas > far_off)
    faults.push_back(fmt::format("{}: the values are unevenly frequent, chi-square {:.1f} of {} degrees",
                                 s.name, s.chi_square, s.degrees));
}

} // namespace

MappingStatistics mapping_statistics(const Mapping& mapping, const ColorCounts& colors, int largest_window) {
  if (largest_window < 8 || largest_window > 1024)
    throw Error(ErrorKind::usage, "window",
                fmt::format("{} cells are out of range; 8 to 1024 are looked at", largest_window));
  MappingStatistics result;
  result.window = {std::min<std::int64_t>(mapping.size.width, largest_window),
                   std::min<std::int64_t>(mapping.size.height, largest_window)};
  const std::vector<Field> all = fields(mapping, colors, result.window);
  result.families.resize(all.size());
  tbb::parallel_for(std::size_t{0}, all.size(),
                    [&](std::size_t i) { result.families[i] = statistics_of(all[i]); });
  for (const FamilyStatistics& s : result.families) note_faults(s, mapping.kind, result.faults);
  return result;
}

Image mapping_picture(const Mapping& mapping, const ColorCounts& colors, int side) {
  Image picture(static_cast<int>(std::min<std::int64_t>(mapping.size.width, side)),
                static_cast<int>(std::min<std::int64_t>(mapping.size.height, side)), 3);
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x) {
      // Sixteen steps a channel keep neighbours in number far apart in color.
      const std::uint64_t bits =
          random_bits(0, "picture", static_cast<std::uint64_t>(tile_at(mapping, colors, x, y)));
      const auto texel = picture.texel(x, y);
      for (std::size_t c = 0; c < 3; ++c) texel[c] = static_cast<float>((bits >> (8 * c)) & 15) / 15.0f;
    }
  return picture;
}

Mapping permutation_mapping_of_length(VirtualSize size, int length, std::uint64_t seed) {
  if (length < 1 || length > limits::longest_table)
    throw Error(
        ErrorKind::usage, "table length",
        fmt::format("{} is out of range; a table has 1 to {} entries", length, limits::longest_table));
  Mapping mapping;
  mapping.kind = MappingKind::permutation;
  mapping.size = size;
  mapping.table = permutation_table(length, seed);
  return mapping;
}

} // namespace tilepack
