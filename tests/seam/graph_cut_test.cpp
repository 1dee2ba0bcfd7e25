#include "support/images.h"
#include "support/samples.h"

#include "tilepack/exemplar/structure.h"
#include "tilepack/seam/graph_cut.h"

#include <catch2/catch.hpp>

using namespace tilepack;

namespace {

// A canvas of vertical bands from different places, so that it has seams of its own.
SourceCanvas banded(int width, int height, std::uint64_t seed) {
  SourceCanvas canvas(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int shift = static_cast<int>(random_below(seed, "band", static_cast<std::uint64_t>(x / 2), 12));
      canvas.at(x, y) = {x + shift, y + shift / 2};
    }
  return canvas;
}

LaidPatch whole(const SourceCanvas& canvas, SourceTexel origin) {
  LaidPatch patch{{0, 0, canvas.width, canvas.height}, origin, {}};
  patch.constraints.assign(canvas.texels.size(), CutConstraint::free);
  return patch;
}

std::int64_t least_by_trying(const FeatureImage& image, const SourceCanvas& start, const LaidPatch& patch) {
  std::vector<std::size_t> open;
  SourceCanvas canvas = start;
  for (std::size_t i = 0; i < canvas.texels.size(); ++i) {
    const int x = static_cast<int>(i) % canvas.width;
    const int y = static_cast<int>(i) / canvas.width;
    if (patch.constraints[i] == CutConstraint::free) open.push_back(i);
    if (patch.constraints[i] == CutConstraint::take)
      canvas.texels[i] = {patch.origin.x + x, patch.origin.y + y};
  }
  std::int64_t least = std::numeric_limits<std::int64_t>::max();
  for (std::uint32_t bits = 0; bits < (1u << open.size()); ++bits) {
    for (std::size_t k = 0; k < open.size(); ++k) {
      const int x = static_cast<int>(open[k]) % canvas.width;
      const int y = static_cast<int>(open[k]) / canvas.width;
      canvas.texels[open[k]] =
          (bits >> k & 1u) != 0 ? SourceTexel{patch.origin.x + x, patch.origin.y + y} : start.texels[open[k]];
    }
    least = std::min(least, seam_energy(image, canvas));
  }
  return least;
}

} // namespace

TEST_CASE("a laid patch never raises the seam energy") {
  const FeatureImage image = test::noise_features(48, 48, 3, 1);
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    SourceCanvas canvas = banded(20, 16, seed);
    const std::int64_t before = seam_energy(image, canvas);
    const LaidPatch patch = whole(canvas, {static_cast<int>(random_below(seed, "ox", 0, 28)),
                                           static_cast<int>(random_below(seed, "oy", 0, 32))});
    const bool changed = lay_patch(image, canvas, patch);
    CHECK(seam_energy(image, canvas) <= before);
    CHECK(changed == (canvas.texels != banded(20, 16, seed).texels));
  }
}

TEST_CASE("a laid patch over a canvas without seams is the best of all ways to lay it") {
  const FeatureImage image = test::noise_features(24, 24, 3, 2);
  for (std::uint64_t seed = 0; seed < 25; ++seed) {
    SourceCanvas canvas(5, 4);
    for (int y = 0; y < 4; ++y)
      for (int x = 0; x < 5; ++x) canvas.at(x, y) = {x + 1, y + 2};
    LaidPatch patch = whole(canvas, {7 + static_cast<int>(seed % 5), 9});
    for (std::size_t i = 0; i < patch.constraints.size(); ++i) {
      const auto draw = random_below(seed, "freedom", i, 6);
      patch.constraints[i] = draw == 0   ? CutConstraint::take
                             : draw == 1 ? CutConstraint::keep
                                         : CutConstraint::free;
    }
    const std::int64_t least = least_by_trying(image, canvas, patch);
    lay_patch(image, canvas, patch);
    CHECK(seam_energy(image, canvas) == least);
  }
}

TEST_CASE("a laid patch keeps what must stay and takes what must go") {
  const FeatureImage image = test::noise_features(40, 40, 3, 3);
  const SourceCanvas start = banded(12, 9, 5);
  SourceCanvas canvas = start;
  LaidPatch patch{{3, 2, 6, 5}, {11, 13}, {}};
  for (int i = 0; i < 30; ++i)
    patch.constraints.push_back(i % 3 == 0   ? CutConstraint::take
                                : i % 3 == 1 ? CutConstraint::keep
                                             : CutConstraint::free);
  lay_patch(image, canvas, patch);
  for (int y = 0; y < 9; ++y)
    for (int x = 0; x < 12; ++x) {
      const bool inside = x >= 3 && x < 9 && y >= 2 && y < 7;
      const int kind = inside ? ((y - 2) * 6 + x - 3) % 3 : 1;
      if (kind == 1) CHECK(canvas.at(x, y) == start.at(x, y));
      if (kind == 0) CHECK(canvas.at(x, y) == SourceTexel{11 + x, 13 + y});
    }
}

TEST_CASE("texels that are neighbours in the sample have no seam") {
  const FeatureImage image = test::noise_features(10, 10, 3, 4);
  CHECK(seam_cost(image, {3, 3}, {4, 3}, 1, 0) == 0);
  CHECK(seam_cost(image, {3, 3}, {3, 4}, 0, 1) == 0);
  CHECK(seam_cost(image, {3, 3}, {5, 3}, 1, 0) > 0);
  CHECK(seam_cost(image, {9, 9}, {0, 0}, 1, 0) > 0); // at the sample's end the last texel stands for the next
}

TEST_CASE("a cut through two flat things of one color costs, one along their outlines does not") {
  // Grey stones 40 texels wide, dark gaps of 4 between them.
  FeatureImage stones{220, 60, 1, {}};
  for (int y = 0; y < stones.height; ++y)
    for (int x = 0; x < stones.width; ++x)
      stones.values.push_back(static_cast<std::uint8_t>(x % 44 < 40 ? 150 : 20));
  const SourceTexel middle{20, 30}, next_middle{44 + 21, 10};
  const SourceTexel rim{39, 30}, next_gap{44 + 40, 10};
  CHECK(seam_cost(stones, middle, next_middle, 1, 0) == 0);
  const FeatureImage seen = with_structure(stones);
  REQUIRE(seen.flat_seam > 0);
  const std::int64_t through = seam_cost(seen, middle, next_middle, 1, 0);
  CHECK(through == seen.flat_seam);
  CHECK(20 * seam_cost(seen, rim, next_gap, 1, 0) < through);
  CHECK(seam_cost(seen, middle, {21, 30}, 1, 0) == 0); // no cut at all
}

TEST_CASE("texels without bias are cut as without it, others at its price") {
  const FeatureImage image = test::noise_features(24, 24, 3, 6);
  constexpr std::int64_t bias = 6'000; // a tenth of a seam between two texels
  int differing = 0;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    SourceCanvas start(5, 4);
    for (int y = 0; y < 4; ++y)
      for (int x = 0; x < 5; ++x) start.at(x, y) = {x + 1, y + 2};
    LaidPatch patch = whole(start, {9, 11});
    for (std::size_t i = 0; i < patch.constraints.size(); ++i)
      patch.constraints[i] = i == 0                                    ? CutConstraint::take
                             : i == 19                                 ? CutConstraint::keep
                             : random_below(seed, "biased", i, 4) == 0 ? CutConstraint::free
                                                                       : CutConstraint::unbiased;
    const auto cost = [&](const SourceCanvas& canvas) {
      std::int64_t total = seam_energy(image, canvas);
      for (std::size_t i = 0; i < patch.constraints.size(); ++i)
        if (patch.constraints[i] == CutConstraint::free && canvas.texels[i] == start.texels[i]) total += bias;
      return total;
    };
    std::int64_t least = std::numeric_limits<std::int64_t>::max();
    for (std::uint32_t bits = 0; bits < (1u << 18); ++bits) {
      SourceCanvas canvas = start;
      for (std::size_t i = 0; i < 19; ++i)
        if (i == 0 || (bits >> (i - 1) & 1u) != 0)
          canvas.texels[i] = {9 + static_cast<int>(i) % 5, 11 + static_cast<int>(i) / 5};
      least = std::min(least, cost(canvas));
    }
    SourceCanvas canvas = start;
    lay_patch(image, canvas, patch, bias);
    CHECK(cost(canvas) == least);
    LaidPatch all_free = patch;
    for (CutConstraint& c : all_free.constraints)
      if (c == CutConstraint::unbiased) c = CutConstraint::free;
    SourceCanvas other = start;
    lay_patch(image, other, all_free, bias);
    differing += other.texels != canvas.texels;
  }
  CHECK(differing > 0);
}
