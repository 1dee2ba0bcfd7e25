#include "tilepack/error/error.h"
#include "tilepack/measure/longest_repeat.h"
#include "tilepack/measure/mapping_statistics.h"
#include "tilepack/numeric/random.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>

using namespace tilepack;

namespace {

const ColorCounts two_by_two{2, 2, 0};

const FamilyStatistics& family(const MappingStatistics& s, const std::string& name) {
  return *std::find_if(s.families.begin(), s.families.end(), [&](const auto& f) { return f.name == name; });
}

LongestRepeat by_brute_force(const std::vector<int>& text) {
  LongestRepeat longest;
  const int n = static_cast<int>(text.size());
  for (int i = 0; i < n; ++i)
    for (int j = i + 1; j < n; ++j) {
      int length = 0;
      while (j + length < n &&
             text[static_cast<std::size_t>(i + length)] == text[static_cast<std::size_t>(j + length)])
        ++length;
      if (length > longest.length) longest = {length, {i, j}};
    }
  return longest;
}

} // namespace

TEST_CASE("the longest repeat is that of brute force") {
  for (std::uint32_t letters = 1; letters < 5; ++letters)
    for (int n = 0; n < 60; n += 7) {
      std::vector<int> text;
      for (int i = 0; i < n; ++i)
        text.push_back(
            static_cast<int>(random_below(letters, "text", static_cast<std::uint64_t>(i), letters)));
      const LongestRepeat found = longest_repeat(text);
      REQUIRE(found.length == by_brute_force(text).length);
      for (int i = 0; i < found.length; ++i)
        REQUIRE(text[static_cast<std::size_t>(found.start[0] + i)] ==
                text[static_cast<std::size_t>(found.start[1] + i)]);
      if (found.length > 0) REQUIRE(found.start[0] != found.start[1]);
    }
}

TEST_CASE("the mixing hash shows no pattern, whatever the seed and the colors") {
  for (const std::uint64_t seed : {0u, 1u, 2u, 12345u})
    for (const ColorCounts& colors : {two_by_two, ColorCounts{3, 5, 0}, ColorCounts{8, 1, 0},
                                      ColorCounts{0, 0, 2}, ColorCounts{0, 0, 3}}) {
      const MappingStatistics s = mapping_statistics(mix_mapping({1 << 20, 1 << 20}, seed), colors, 128);
      for (const std::string& fault : s.faults) UNSCOPED_INFO(fault);
      CHECK(s.faults.empty());
    }
}

TEST_CASE("the even mapping's tiles return less often nearby, which is no fault; nor does it show another") {
  for (const std::uint64_t seed : {0u, 1u, 2u})
    for (const int k : {2, 3, 4}) {
      const MappingStatistics s = mapping_statistics(even_mapping({1 << 20, 1 << 20}, k, seed), {0, 0, k});
      for (const std::string& fault : s.faults) UNSCOPED_INFO(fault);
      CHECK(s.faults.empty());
      const Mapping m = even_mapping({1 << 20, 1 << 20}, k, seed);
      constexpr int side = 192;
      for (int lag = 1; lag <= 4; ++lag) {
        int equal = 0;
        for (int y = 0; y < side; ++y)
          for (int x = 0; x < side; ++x)
            equal += tile_at(m, {0, 0, k}, x, y) == tile_at(m, {0, 0, k}, x + lag, y);
        CHECK(equal < 0.92 * side * side / (k * k * k * k));
      }
      CHECK(family(s, "tiles").longest_in_columns.length < 96);
    }
}

TEST_CASE("known fault of the permutation hash: an even table no longer than the texture repeats at half") {
  const Mapping m = permutation_mapping_of_length({64, 64}, 64, 7);
  const MappingStatistics s = mapping_statistics(m, two_by_two);
  CHECK(family(s, "vertical edges").column_period == 32);
  CHECK(family(s, "horizontal edges").column_period == 0);
  CHECK_FALSE(s.faults.empty());
  // An odd table of about that length does not, nor does one twice as long.
  CHECK(
      family(mapping_statistics(permutation_mapping_of_length({64, 64}, 65, 7), two_by_two), "vertical edges")
          .column_period == 0);
  CHECK(family(mapping_statistics(permutation_mapping({64, 64}, two_by_two, 7), two_by_two), "vertical edges")
            .column_period == 0);
}

TEST_CASE("known fault of the permutation hash: columns are shifted copies of one sequence") {
  const Mapping m = permutation_mapping({64, 64}, two_by_two, 7);
  const MappingStatistics s = mapping_statistics(m, two_by_two);
  const RepeatedRun run = family(s, "horizontal edges").longest_in_columns;
  CHECK(run.length > 50);
  CHECK(run.by_chance < 30);
  CHECK(run.x[0] != run.x[1]);
  for (int i = 0; i < run.length; ++i)
    REQUIRE(edge_tile_at(m, two_by_two, run.x[0], run.y[0] + i).north ==
            edge_tile_at(m, two_by_two, run.x[1], run.y[1] + i).north);
  // Whole tiles are not copied: their other edges differ.
  CHECK(family(s, "tiles").longest_in_columns.length < 2 * family(s, "tiles").longest_in_columns.by_chance);
}

TEST_CASE("a short table repeats everything") {
  const MappingStatistics s = mapping_statistics(permutation_mapping_of_length({64, 64}, 8, 1), two_by_two);
  CHECK(family(s, "tiles").column_period == 8);
  CHECK(family(s, "horizontal edges").column_period == 8);
  CHECK(family(s, "vertical edges").row_period == 8);
  CHECK(family(s, "tiles").along_columns.equal == 1.0);
}

TEST_CASE("counts and chi-square by hand") {
  Mapping m;
  m.kind = MappingKind::index;
  m.size = {4, 2};
  m.ids = {0, 1, 2, 3, 0, 0, 0, 1}; // counts 4, 2, 1, 1 of expected 2 each
  const MappingStatistics s = mapping_statistics(m, {2, 1, 0});
  REQUIRE(s.families.size() == 1);
  const FamilyStatistics& f = s.families[0];
  CHECK(f.counts == std::vector<std::int64_t>{4, 2, 1, 1});
  CHECK(f.degrees == 3);
  CHECK(f.chi_square == Approx(3.0));
  CHECK(f.chi_square_sigmas == Approx((1 - (1 - 2.0 / 27)) / std::sqrt(2.0 / 27)));
  CHECK(f.longest_in_rows.length == 2); // 0 1
}

TEST_CASE("biased colors are noticed: a table whose length is no multiple of the number of colors") {
  const ColorCounts five{5, 5, 0};
  const MappingStatistics s = mapping_statistics(permutation_mapping_of_length({256, 256}, 8, 3), five);
  CHECK(family(s, "horizontal edges").chi_square_sigmas > 6);
}

TEST_CASE("one color, one cell, wide and narrow textures have statistics too") {
  CHECK(mapping_statistics(mix_mapping({1, 1}, 0), {1, 1, 0}).faults.empty());
  CHECK(mapping_statistics(mix_mapping({1, 1}, 0), two_by_two).window == VirtualSize{1, 1});
  CHECK(mapping_statistics(mix_mapping({1, 100}, 0), two_by_two).families.size() == 3);
  CHECK_THROWS_AS(mapping_statistics(mix_mapping({9, 9}, 0), two_by_two, 4), Error);
}

TEST_CASE("a picture has a texel a cell, equal where tiles are") {
  const Mapping m = permutation_mapping_of_length({32, 32}, 8, 1);
  const Image picture = mapping_picture(m, two_by_two, 32);
  CHECK(picture.size() == Size{32, 32});
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 32; ++x) {
      const auto a = picture.texel(x, y);
      const auto b = picture.texel(0, 0);
      REQUIRE(std::equal(a.begin(), a.end(), b.begin()) ==
              (tile_at(m, two_by_two, x, y) == tile_at(m, two_by_two, 0, 0)));
    }
}
