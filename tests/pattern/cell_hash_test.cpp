#include "tilepack/numeric/random.h"
#include "tilepack/pattern/cell_hash.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

using namespace tilepack;

namespace {

constexpr std::int64_t far_side = std::int64_t{1} << 31;

/// How far counts lie from even ones, in standard deviations of chi-square with that many degrees of freedom.
double excess(const std::vector<int>& counts, double expected) {
  double chi = 0;
  for (const int count : counts) chi += (count - expected) * (count - expected) / expected;
  const auto freedom = static_cast<double>(counts.size() - 1);
  return (chi - freedom) / std::sqrt(2 * freedom);
}

PatternCell scattered(std::uint64_t k, std::int64_t side) {
  return {static_cast<std::int64_t>(random_bits(1, "x", k) % static_cast<std::uint64_t>(side)),
          static_cast<std::int64_t>(random_bits(1, "y", k) % static_cast<std::uint64_t>(side))};
}

} // namespace

TEST_CASE("random indices are evenly frequent", "[pattern]") {
  const HashKind kind = GENERATE(HashKind::mix, HashKind::chain);
  const int values = GENERATE(2, 3, 7, 16, 100);
  const CellHash hash(kind, {far_side, far_side}, values, 5);
  std::vector<int> counts(static_cast<std::size_t>(values));
  constexpr int samples = 200000;
  for (std::uint64_t k = 0; k < samples; ++k) ++counts[hash.index(scattered(k, far_side))];
  INFO(name_of(kind) << " " << values);
  CHECK(std::fabs(excess(counts, static_cast<double>(samples) / values)) < 5);
}

TEST_CASE("a number of n levels makes a biased index, a table of a multiple does not", "[pattern]") {
  // [LN03, figure 2.2]: n = 12 levels as an index of 9: three of them come twice as often.
  const CellHash levels(HashKind::chain, {4096, 4096}, 1, 3, 0, 12);
  REQUIRE(levels.table_length() == 12);
  const CellHash fitted(HashKind::chain, {4096, 4096}, 9, 3, 0, 12);
  REQUIRE(fitted.table_length() == 18);
  std::vector<int> biased(9), even(9);
  for (std::int64_t y = 0; y < 36; ++y)
    for (std::int64_t x = 0; x < 36 * 12; ++x) {
      ++biased[floored_index(levels.number({x, y}), 9)];
      ++even[fitted.index({x, y})];
    }
  const double fair = 36 * 36 * 12 / 9.0;
  CHECK(biased == std::vector<int>{2592, 1296, 1296, 2592, 1296, 1296, 2592, 1296, 1296});
  CHECK(std::fabs(excess(even, fair)) < 3);
  CHECK(excess(biased, fair) > 100);
}

TEST_CASE("along x, each aligned run of a chain's length has each number once", "[pattern]") {
  const CellHash chain(HashKind::chain, {1 << 20, 1 << 20}, 16, 9, 2, 16);
  REQUIRE(chain.table_length() == 16);
  for (const std::int64_t y : {0, 1, 77777}) {
    std::vector<int> counts(16);
    for (std::int64_t x = 0; x < 16; ++x) ++counts[chain.index({32 + x, y})];
    CHECK(counts == std::vector<int>(16, 1));
  }
}

TEST_CASE("cells apart are uncorrelated, near ones too", "[pattern]") {
  const HashKind kind = GENERATE(HashKind::mix, HashKind::chain);
  const CellHash hash(kind, {1 << 20, 1 << 20}, 1, 11, 0, 4096);
  const CellHash other(kind, {1 << 20, 1 << 20}, 1, 11, 1, 4096);
  constexpr int samples = 40000;
  const auto correlation = [&](const CellHash& a, const CellHash& b, std::int64_t dx, std::int64_t dy) {
    double sum = 0;
    for (std::uint64_t k = 0; k < samples; ++k) {
      const PatternCell cell = scattered(k, 1 << 19);
      sum += (a.number(cell) - 0.5) * (b.number({cell.x + dx, cell.y + dy}) - 0.5);
    }
    return sum / samples * 12;
  };
  INFO(name_of(kind));
  // Where only the last digit differs, a chain's two numbers are σ(k) and σ(k + d): their correlation over all k is one
  // number that the table of 4096 happens to have, about 1 / √4096. The hash has nothing of the kind.
  const double of_table = kind == HashKind::chain ? 1.0 / 4096 : 0;
  const double deviation = std::sqrt(1.0 / samples + of_table);
  for (const std::int64_t away : {1, 2, 64, 255, 256, 257, 4096, 65536, 1 << 18}) {
    INFO(away);
    CHECK(std::fabs(correlation(hash, hash, away, 0)) < 5 * deviation);
    CHECK(std::fabs(correlation(hash, hash, 0, away)) < 5 * deviation);
    CHECK(std::fabs(correlation(hash, hash, away, away)) < 5 * deviation);
  }
  CHECK(std::fabs(correlation(hash, other, 0, 0)) < 5 * deviation);
}

TEST_CASE("no period within 2^20 cells", "[pattern]") {
  const HashKind kind = GENERATE(HashKind::mix, HashKind::chain);
  constexpr std::int64_t side = 1 << 20;
  const CellHash hash(kind, {side, side}, 256, 4);
  INFO(name_of(kind));
  std::vector<std::uint32_t> row(side), column(side);
  for (std::int64_t i = 0; i < side; ++i) {
    row[static_cast<std::size_t>(i)] = hash.index({i, 12345});
    column[static_cast<std::size_t>(i)] = hash.index({54321, i});
  }
  // A period p < side would repeat the first 64 numbers p cells on; all places are tried.
  const auto repeats = [](const std::vector<std::uint32_t>& numbers) {
    for (std::size_t p = 1; p + 64 <= numbers.size(); ++p)
      if (std::equal(numbers.begin(), numbers.begin() + 64, numbers.begin() + static_cast<std::ptrdiff_t>(p)))
        return p;
    return std::size_t{0};
  };
  CHECK(repeats(row) == 0);
  CHECK(repeats(column) == 0);
  // A chain too short for the grid has one: that of the digits it reads.
  const CellHash shorter(kind, {65536, 65536}, 256, 4);
  if (kind == HashKind::chain) CHECK(shorter.index({3, 5}) == shorter.index({3 + 65536, 5}));
}
