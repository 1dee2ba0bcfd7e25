#include "seam/seamed_canvases.h"

#include "tilepack/seam/patch_match.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>

using namespace tilepack;
using testing::blobs;
using testing::features;
using testing::with_seam;

namespace {

// The mean over a few squares of 7 × 7 texels of the least squared difference to any square of the sample.
double unlikeness(const FeatureImage& image, const SourceCanvas& canvas) {
  constexpr int side = 7;
  double sum = 0.0;
  int count = 0;
  for (int y = 0; y + side <= canvas.height; y += 5)
    for (int x = 18; x < 24; x += 2, ++count) {
      int least = std::numeric_limits<int>::max();
      for (int v = 0; v + side <= image.height; ++v)
        for (int u = 0; u + side <= image.width; ++u) {
          int d = 0;
          for (int j = 0; j < side && d < least; ++j)
            for (int i = 0; i < side; ++i) {
              const SourceTexel s = canvas.at(x + i, y + j);
              d += squared_difference(image.texel(s.x, s.y), image.texel(u + i, v + j), image.channels);
            }
          least = std::min(least, d);
        }
      sum += least;
    }
  return sum / count;
}

// The neighbours of one square in the sample, all of which agree.
bool is_square_of_sample(const SourceCanvas& canvas, int x, int y) {
  const SourceTexel middle = canvas.at(x, y);
  for (int j = -3; j <= 3; ++j)
    for (int i = -3; i <= 3; ++i)
      if (canvas.at(x + i, y + j) != SourceTexel{middle.x + i, middle.y + j}) return false;
  return true;
}

} // namespace

TEST_CASE("matching at half size changes texels near a seam to others of the sample, fixed ones never") {
  const FeatureImage image = features(blobs(256, 256));
  SourceCanvas start(96, 80);
  std::vector<std::uint8_t> fixed(start.texels.size());
  for (int y = 0; y < start.height; ++y)
    for (int x = 0; x < start.width; ++x) {
      start.at(x, y) = x < 48 ? SourceTexel{x, y} : SourceTexel{x + 91, y + 120};
      fixed[start.index(x, y)] = x < 46;
    }
  std::vector<SourceCanvas> matched{start};
  match_and_vote({halved(image), contrast_ranks(halved(image)), 2, fixed, {0, 0, 96, 80}}, {}, matched);
  CHECK(matched[0].texels != start.texels);
  for (std::size_t i = 0; i < fixed.size(); ++i) {
    const SourceTexel s = matched[0].texels[i];
    CHECK((s.x >= 0 && s.y >= 0 && s.x < image.width && s.y < image.height));
    if (fixed[i] || i % 96 > 60) CHECK(s == start.texels[i]); // the last are out of reach
  }
}

TEST_CASE(
    "passes of matching and voting make squares more like the sample's, and leave alone what has no seam") {
  const FeatureImage image = features(blobs(96, 96));
  const SourceCanvas start = with_seam({48, 40}, 24, {40, 50});
  const std::vector<std::uint8_t> fixed(start.texels.size(), 0);
  const Rect all{0, 0, 48, 40};
  const auto matched = [&](int passes) {
    PatchMatchOptions options;
    options.passes = passes;
    std::vector<SourceCanvas> canvases{start};
    match_and_vote({image, contrast_ranks(image), 1, fixed, all}, options, canvases);
    return unlikeness(image, canvases[0]);
  };
  const double once = matched(1);
  CHECK(once < 0.9 * unlikeness(image, start));
  CHECK(matched(4) < 0.97 * once);

  std::vector<SourceCanvas> whole{SourceCanvas(48, 40)};
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 48; ++x) whole[0].at(x, y) = {x + 5, y + 7};
  const auto before = whole[0].texels;
  match_and_vote({image, contrast_ranks(image), 1, fixed, all}, {}, whole);
  CHECK(whole[0].texels == before);
}

TEST_CASE("matching with a reuse weight turns to parts of the sample that no canvas shows") {
  const FeatureImage image = features(testing::four_quarters());
  const SourceCanvas start = with_seam({48, 40}, 24, {14, 20}); // shows the north-west quarter only
  const std::vector<std::uint8_t> fixed(start.texels.size(), 0);
  const auto fresh = [&](double reuse_weight) {
    PatchMatchOptions options;
    options.reuse_weight = reuse_weight;
    std::vector<SourceCanvas> canvases{start, start};
    match_and_vote({image, contrast_ranks(image), 1, fixed, {0, 0, 48, 40}}, options, canvases);
    return std::count_if(canvases[0].texels.begin(), canvases[0].texels.end(),
                         [](SourceTexel s) { return s.x >= 64 || s.y >= 64; });
  };
  CHECK(fresh(2.0) > fresh(0.0) + 20);
}

TEST_CASE(
    "a hole whose like stands elsewhere in the sample is filled with it, by propagation from any one find") {
  // The canvas shows the first quarter; a square in its middle shows what is elsewhere. The three other quarters
  // hold the right texels, so the best vote is an exact copy of one of them or of the first.
  const FeatureImage image = features(testing::four_quarters());
  SourceCanvas start = with_seam({64, 64}, 64, {0, 0});
  for (int y = 29; y < 35; ++y)
    for (int x = 29; x < 35; ++x) start.at(x, y) = {x + 20, y - 25};
  const std::vector<std::uint8_t> fixed(start.texels.size(), 0);
  PatchMatchOptions options;
  options.passes = 8;
  options.sweeps = 8;
  std::vector<SourceCanvas> canvases{start};
  match_and_vote({image, contrast_ranks(image), 1, fixed, {0, 0, 64, 64}}, options, canvases);
  int wrong = 0;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      const SourceTexel s = canvases[0].at(x, y);
      wrong += squared_difference(image.texel(s.x, s.y), image.texel(x, y), image.channels) != 0;
    }
  CHECK(wrong == 0);
  CHECK(is_square_of_sample(canvases[0], 10, 10));
}

TEST_CASE("matching leaves fixed texels, and what is farther from seams than its reach, as they are") {
  const FeatureImage image = features(blobs(96, 96));
  const SourceCanvas start = with_seam({48, 40}, 24, {40, 50});
  std::vector<std::uint8_t> fixed(start.texels.size());
  for (std::size_t i = 0; i < fixed.size(); ++i) fixed[i] = i % 48 < 22 || i % 7 == 0;
  PatchMatchOptions options;
  options.reach = 5;
  std::vector<SourceCanvas> matched{start};
  match_and_vote({image, contrast_ranks(image), 1, fixed, {0, 0, 48, 40}}, options, matched);
  CHECK(matched[0].texels != start.texels);
  for (std::size_t i = 0; i < fixed.size(); ++i)
    if (fixed[i] || i % 48 >= 24 + 5) CHECK(matched[0].texels[i] == start.texels[i]);
}

TEST_CASE("matching depends on the seed, not on the number of threads; no pass and too small a canvas change "
          "nothing") {
  const FeatureImage image = features(blobs(96, 96));
  const SourceCanvas start = with_seam({48, 40}, 24, {40, 50});
  const std::vector<std::uint8_t> fixed(start.texels.size(), 0);
  const auto matched = [&](PatchMatchOptions options) {
    std::vector<SourceCanvas> canvases{start, start};
    match_and_vote({image, contrast_ranks(image), 1, fixed, {0, 0, 48, 40}}, options, canvases);
    return canvases;
  };
  PatchMatchOptions options;
  const auto many = matched(options);
  CHECK(many[0].texels != many[1].texels); // each with a stream of its own
  {
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    CHECK(matched(options)[1].texels == many[1].texels);
  }
  options.seed = 7;
  CHECK(matched(options)[0].texels != many[0].texels);
  options.passes = 0;
  CHECK(matched(options)[0].texels == start.texels);

  std::vector<SourceCanvas> small{with_seam({6, 40}, 3, {40, 50})};
  const auto before = small[0].texels;
  match_and_vote({image, contrast_ranks(image), 1, std::vector<std::uint8_t>(240, 0), {0, 0, 6, 40}}, {},
                 small);
  CHECK(small[0].texels == before);
}
