#include "tilepack/error/error.h"
#include "tilepack/mapping/even_pattern.h"
#include "tilepack/mapping/mapping.h"
#include "tilepack/numeric/random.h"
#include "tilepack/numeric/wrap.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <map>
#include <set>
#include <utility>

using namespace tilepack;

namespace {

const ColorCounts edges_3x2{3, 2, 0};
const ColorCounts corners_3{0, 0, 3};

// The origins of the windows that are looked at: around zero, negative, across 2^31, and at the ends of the
// range.
const std::array<std::int64_t, 7> origins{-5,
                                          0,
                                          250,
                                          (std::int64_t{1} << 31) - 3,
                                          -(std::int64_t{1} << 40),
                                          std::numeric_limits<std::int64_t>::max() - 8,
                                          std::numeric_limits<std::int64_t>::min()};

void check_edges_agree(const Mapping& mapping) {
  for (const std::int64_t ox : origins)
    for (const std::int64_t oy : origins)
      for (std::int64_t y = oy; y < oy + 6; ++y)
        for (std::int64_t x = ox; x < ox + 6; ++x) {
          const EdgeTile tile = edge_tile_at(mapping, edges_3x2, x, y);
          REQUIRE(tile.east == edge_tile_at(mapping, edges_3x2, x + 1, y).west);
          REQUIRE(tile.south == edge_tile_at(mapping, edges_3x2, x, y + 1).north);
          const CornerTile c = corner_tile_at(mapping, corners_3, x, y);
          const CornerTile east = corner_tile_at(mapping, corners_3, x + 1, y);
          const CornerTile south = corner_tile_at(mapping, corners_3, x, y + 1);
          REQUIRE(c.ne == east.nw);
          REQUIRE(c.se == east.sw);
          REQUIRE(c.sw == south.nw);
          REQUIRE(c.se == south.ne);
        }
}

} // namespace

TEST_CASE("a permutation table holds each number once") {
  for (const int length : {1, 2, 7, 512}) {
    std::vector<int> table = permutation_table(length, 42);
    std::sort(table.begin(), table.end());
    for (int i = 0; i < length; ++i) REQUIRE(table[static_cast<std::size_t>(i)] == i);
  }
  CHECK(permutation_table(64, 1) != permutation_table(64, 2));
}

TEST_CASE("the table is long enough to repeat no row, and a multiple of the color counts") {
  CHECK(permutation_mapping({256, 256}, {2, 2, 0}, 0).table.size() == 512);
  CHECK(permutation_mapping({256, 100}, {3, 4, 0}, 0).table.size() == 516);
  CHECK(permutation_mapping({1, 1}, {1, 1, 0}, 0).table.size() == 2);
  CHECK(permutation_mapping({10, 20}, {0, 0, 3}, 0).table.size() == 42);
  CHECK(permutation_mapping({10, 20}, {0, 0, 3, 5}, 0).table.size() == 45);
}

TEST_CASE("the permutation hash is that of the paper, coordinate for coordinate") {
  Mapping m;
  m.size = {7, 5};
  m.table = permutation_table(11, 3); // odd: indices wrap often
  const auto p = [&](std::int64_t i) {
    return static_cast<std::int64_t>(m.table[static_cast<std::size_t>(i % 11)]);
  };
  for (std::int64_t y = -6; y < 12; ++y)
    for (std::int64_t x = -8; x < 15; ++x) {
      const std::int64_t x0 = wrapped(x, std::int64_t{7});
      const std::int64_t y0 = wrapped(y, std::int64_t{5});
      const EdgeTile tile = edge_tile_at(m, edges_3x2, x, y);
      REQUIRE(tile.north == p(p(x0) + y0) % 3);
      REQUIRE(tile.west == p(x0 + p(2 * y0)) % 2);
      REQUIRE(tile.south == p(p(x0) + (y0 + 1) % 5) % 3);
      REQUIRE(tile.east == p((x0 + 1) % 7 + p(2 * y0)) % 2);
      REQUIRE(corner_tile_at(m, corners_3, x, y).nw == p(p(x0) + y0) % 3);
    }
}

TEST_CASE("neighbours agree on the edge and the corners between them, anywhere") {
  check_edges_agree(permutation_mapping({256, 256}, edges_3x2, 9));
  check_edges_agree(permutation_mapping({5, 3}, edges_3x2, 9));
  check_edges_agree(permutation_mapping({1, 1}, edges_3x2, 9));
  check_edges_agree(mix_mapping({std::int64_t{1} << 31, std::int64_t{1} << 31}, 9));
  check_edges_agree(mix_mapping({1000, 7}, 9));
  for (const int k : {2, 3, 4}) {
    const Mapping even = even_mapping({1000, std::int64_t{1} << 31}, k, 9);
    for (const std::int64_t at :
         {std::int64_t{-3}, std::int64_t{30}, std::int64_t{997}, std::int64_t{1} << 31})
      for (std::int64_t d = 0; d < 5; ++d) {
        const CornerTile tile = corner_tile_at(even, {0, 0, k}, at + d, at - d);
        const CornerTile east = corner_tile_at(even, {0, 0, k}, at + d + 1, at - d);
        const CornerTile south = corner_tile_at(even, {0, 0, k}, at + d, at - d + 1);
        REQUIRE((tile.ne == east.nw && tile.se == east.sw && tile.sw == south.nw && tile.se == south.ne));
      }
  }
}

TEST_CASE("a mapping wraps at its size") {
  for (const Mapping& m : {permutation_mapping({13, 6}, edges_3x2, 1), mix_mapping({13, 6}, 1)})
    for (std::int64_t y = 0; y < 6; ++y)
      for (std::int64_t x = 0; x < 13; ++x) {
        REQUIRE(tile_at(m, edges_3x2, x, y) == tile_at(m, edges_3x2, x - 13, y + 18));
        REQUIRE(tile_at(m, corners_3, x, y) == tile_at(m, corners_3, x + 130000000, y - 6));
      }
}

TEST_CASE("an index map holds what its mapping says") {
  const Mapping m = mix_mapping({9, 4}, 77);
  const Mapping index = index_mapping(m, edges_3x2);
  REQUIRE(index.ids.size() == 36);
  for (std::int64_t y = -9; y < 9; ++y)
    for (std::int64_t x = -20; x < 20; ++x)
      REQUIRE(tile_at(index, edges_3x2, x, y) == tile_at(m, edges_3x2, x, y));
}

TEST_CASE("every tile of the set comes up, and another seed gives another plane") {
  const Mapping permutation = permutation_mapping({64, 64}, edges_3x2, 5);
  const Mapping mix = mix_mapping({64, 64}, 5);
  for (const Mapping* m : {&permutation, &mix}) {
    std::set<int> seen;
    for (std::int64_t y = 0; y < 64; ++y)
      for (std::int64_t x = 0; x < 64; ++x) seen.insert(tile_at(*m, edges_3x2, x, y));
    CHECK(seen.size() == 36);
  }
  CHECK(index_mapping(mix, edges_3x2).ids != index_mapping(mix_mapping({64, 64}, 6), edges_3x2).ids);
}

TEST_CASE("a block of the even mapping is the pattern, moved and turned by the block's hash") {
  const Mapping even = even_mapping({1 << 20, 1 << 20}, 3, 4);
  const MixKeys keys = mix_keys(4, MixAxis::corner);
  const auto pattern = [&](std::uint32_t u, std::uint32_t v) {
    return even.table[static_cast<std::size_t>(v % 64 * 64 + u % 64)];
  };
  int turned = 0;
  for (std::uint32_t block = 0; block < 40; ++block) {
    const std::uint32_t word = mix_word(keys, block, 7);
    turned += static_cast<int>(word >> 14 & 1);
    for (std::uint32_t i = 0; i < 64; ++i) {
      // Written out by cases, as the page on the format has it.
      std::uint32_t u = (block * 64 + i + word % 64) % 64;
      std::uint32_t v = (7 * 64 + 63 - i + word / 64 % 64) % 64;
      if (word / 4096 % 2 == 1) u = 63 - u;
      if (word / 8192 % 2 == 1) v = 63 - v;
      const int color = word / 16384 % 2 == 1 ? pattern(v, u) : pattern(u, v);
      const int shift = static_cast<int>((word / 65536 * 3) / 65536);
      REQUIRE(corner_tile_at(even, corners_3, block * 64 + i, 7 * 64 + 63 - i).nw == (color + shift) % 3);
    }
  }
  CHECK(turned > 5);
  CHECK(turned < 35);
}

namespace {

// The largest share of an 8 x 8 window that one displacement of up to 4 tiles brings onto equal tiles, pairs
// at the window's middle counting more; the mean over many windows. And the variance of how often tiles are
// shown.
struct Evenness {
  double repeat = 0;
  double variance = 0;
};

Evenness evenness(const Mapping& mapping, const ColorCounts& colors) {
  constexpr int window = 8;
  const double weight[window] = {0.04, 0.31, 0.69, 0.96, 0.96, 0.69, 0.31, 0.04};
  Evenness sum;
  int windows = 0;
  for (int wy = 0; wy < 100; wy += 5)
    for (int wx = 0; wx < 100; wx += 5, ++windows) {
      const auto id = [&](int x, int y) { return tile_at(mapping, colors, wx + x, wy + y); };
      double worst = 0;
      for (int dy = 0; dy <= 4; ++dy)
        for (int dx = -4; dx <= 4; ++dx) {
          if (dy == 0 && dx <= 0) continue;
          double equal = 0;
          double all = 0;
          for (int y = 0; y + dy < window; ++y)
            for (int x = std::max(0, -dx); x < window - std::max(0, dx); ++x) {
              const double w = weight[x] * weight[y] * weight[x + dx] * weight[y + dy];
              all += w;
              if (id(x, y) == id(x + dx, y + dy)) equal += w;
            }
          worst = std::max(worst, equal / all);
        }
      sum.repeat += worst;
      const double fair = 64.0 / (combinations(colors) * colors.variants);
      std::map<int, int> counts;
      for (int y = 0; y < window; ++y)
        for (int x = 0; x < window; ++x) ++counts[id(x, y)];
      double squares = 0;
      for (const auto& [tile, count] : counts) squares += count * count;
      sum.variance += squares / 64.0 - fair;
    }
  return {sum.repeat / windows, sum.variance / windows};
}

} // namespace

TEST_CASE("the even mapping repeats less nearby than independent colors, and shows tiles more evenly") {
  for (const int k : {2, 3, 4}) {
    const Evenness even = evenness(even_mapping({4096, 4096}, k, 11), {0, 0, k});
    const Evenness mix = evenness(mix_mapping({4096, 4096}, 11), {0, 0, k});
    INFO(k << " colors: repeat " << even.repeat << " against " << mix.repeat << ", variance " << even.variance
           << " against " << mix.variance);
    CHECK(even.repeat < 0.9 * mix.repeat);
    CHECK(even.variance < 0.8 * mix.variance);
  }
}

TEST_CASE("the even mapping is for two to four corner colors") {
  for (const int k : {0, 1, 5, 8}) CHECK_THROWS_AS(even_mapping({8, 8}, k, 0), Error);
  CHECK_THROWS_AS(even_mapping({0, 8}, 2, 0), Error);
  for (const int k : {2, 3, 4}) {
    const std::vector<int> pattern = even_pattern(k);
    CHECK(pattern.size() == 64 * 64);
    CHECK(*std::min_element(pattern.begin(), pattern.end()) == 0);
    CHECK(*std::max_element(pattern.begin(), pattern.end()) == k - 1);
  }
}

TEST_CASE("sizes out of range are refused") {
  CHECK_THROWS_AS(permutation_mapping({4097, 1}, edges_3x2, 0), Error);
  CHECK_THROWS_AS(permutation_mapping({0, 4}, edges_3x2, 0), Error);
  CHECK_THROWS_AS(mix_mapping({4, -1}, 0), Error);
  CHECK_THROWS_AS(mix_mapping({(std::int64_t{1} << 31) + 1, 1}, 0), Error);
  CHECK_THROWS_AS(index_mapping(mix_mapping({std::int64_t{1} << 31, std::int64_t{1} << 31}, 0), edges_3x2),
                  Error);
}

TEST_CASE("variants leave a cell's colors alone, and each comes up about as often") {
  const ColorCounts corners{0, 0, 2, 3}, edges{2, 1, 0, 3};
  const VirtualSize size{96, 96};
  const Mapping mix = mix_mapping(size, 5), even = even_mapping(size, 2, 5, 3);
  const Mapping of_corners = permutation_mapping(size, corners, 5),
                of_edges = permutation_mapping(size, edges, 5);
  for (const auto& [mapping, colors] :
       {std::pair{&mix, corners}, std::pair{&mix, edges}, std::pair{&even, corners},
        std::pair{&of_corners, corners}, std::pair{&of_edges, edges}}) {
    ColorCounts one = colors;
    one.variants = 1;
    std::map<int, int> counts;
    for (int y = 0; y < 96; ++y)
      for (int x = 0; x < 96; ++x) {
        const int tile = tile_at(*mapping, colors, x, y);
        REQUIRE(tile % combinations(colors) == tile_at(*mapping, one, x, y));
        ++counts[tile / combinations(colors)];
      }
    CAPTURE(static_cast<int>(mapping->kind));
    REQUIRE(counts.size() == 3);
    for (const auto& [variant, count] : counts) CHECK(std::abs(count - 3072) < 250);
  }
}

TEST_CASE("an even mapping with variants lays equal tiles far apart") {
  for (const int colors : {2, 3}) {
    const Mapping one = even_mapping({256, 256}, colors, 3), two = even_mapping({256, 256}, colors, 3, 2);
    CHECK(two.table == one.table);
    CHECK(one.variants.empty());
    Mapping chance = two; // the same colors, and variants by chance
    for (std::size_t i = 0; i < chance.variants.size(); ++i)
      chance.variants[i] = static_cast<int>(random_below(1, "variant", i, 2));
    const ColorCounts counts{0, 0, colors, 2};
    CAPTURE(evenness(two, counts).repeat, evenness(chance, counts).repeat,
            evenness(one, {0, 0, colors}).repeat);
    CHECK(evenness(two, counts).repeat < 0.8 * evenness(chance, counts).repeat);
    CHECK(evenness(two, counts).repeat < 0.6 * evenness(one, {0, 0, colors}).repeat);
  }
}
