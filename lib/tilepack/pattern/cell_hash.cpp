#include "tilepack/pattern/cell_hash.h"

#include "tilepack/error/error.h"
#include "tilepack/mapping/mapping.h"
#include "tilepack/numeric/random.h"

#include <fmt/format.h>

namespace tilepack {
namespace {

constexpr int most_values = 65536;
constexpr int most_streams = 1024;

// The least i with nⁱ >= cells: how many digits a coordinate has.
int digits_of(std::int64_t cells, std::int64_t n) {
  int digits = 0;
  for (std::int64_t reach = 1; reach < cells; reach *= n) ++digits;
  return digits;
}

} // namespace

CellHash::CellHash(HashKind kind, PatternGrid grid, int values, std::uint64_t seed, int stream, int table)
    : hash(kind), value_count(values) {
  if (values < 1 || values > most_values || stream < 0 || stream >= most_streams || table < 1 ||
      table > most_values)
    throw Error(
        ErrorKind::usage, "hash",
        fmt::format(
            "{} values, stream {}, a table of {}; there are 1 to {} values, streams 0 to {} and tables "
            "of 1 to {}",
            values, stream, table, most_values, most_streams - 1, most_values));
  const std::uint64_t own = random_bits(seed, "pattern stream", static_cast<std::uint64_t>(stream));
  if (kind == HashKind::mix) {
    keys = mix_keys(own, MixAxis::variant);
    return;
  }
  // One value would make tables of one entry that no chain gets past.
  const int length = (std::max(table, 2) + values - 1) / values * values;
  for (const int entry : permutation_table(length, own)) sigma.push_back(static_cast<std::uint32_t>(entry));
  steps_x = std::max(1, digits_of(grid.width, length));
  steps_y = digits_of(grid.height, length);
}

} // namespace tilepack
