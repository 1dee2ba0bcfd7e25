#include "support/samples.h"

#include "tilepack/exemplar/contrast_rank.h"
#include "tilepack/seam/patch_match.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <vector>

using namespace tilepack;
using testing::blobs;
using testing::features;

namespace {

// Blobs whose contrast grows from nothing in the west to that of `blobs` in the east.
Image contrast_growing_eastward(int side) {
  Image image = blobs(side, side);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      for (float& v : image.texel(x, y))
        v = 0.5f + (v - 0.5f) * static_cast<float>(x) / static_cast<float>(side - 1);
  return image;
}

// What a texel shows differs from the next one's by so much, on average.
double mean_step(const FeatureImage& image, const SourceCanvas& canvas) {
  double sum = 0.0;
  for (int y = 0; y < canvas.height; ++y)
    for (int x = 12; x < 28; ++x) {
      const SourceTexel a = canvas.at(x, y);
      const SourceTexel b = canvas.at(x + 1, y);
      sum += std::abs(image.texel(a.x, a.y)[0] - image.texel(b.x, b.y)[0]);
    }
  return sum / (16.0 * canvas.height);
}

} // namespace

TEST_CASE("contrast ranks split a sample's squares into equal parts, those of least contrast first") {
  const FeatureImage image = features(contrast_growing_eastward(160));
  const ContrastRanks ranks = contrast_ranks(image);
  REQUIRE(ranks.square == 2);
  REQUIRE(ranks.wide == 80);
  REQUIRE(ranks.high == 80);
  CHECK(ranks.at(0, 50) < 4);
  CHECK(ranks.at(159, 50) > ContrastRanks::count / 2);
  for (int part = 0; part < 4; ++part) {
    const auto count = std::count_if(ranks.ranks.begin(), ranks.ranks.end(), [&](std::uint8_t rank) {
      return rank * 4 / ContrastRanks::count == part;
    });
    CHECK(std::abs(static_cast<int>(count) - 1600) <= 16);
  }
}

TEST_CASE("contrast ranks of a flat sample are all the lowest; squares cut off at its end count too") {
  const FeatureImage image = features(Image(201, 131, 3));
  const ContrastRanks ranks = contrast_ranks(image);
  CHECK(ranks.wide == 101);
  CHECK(ranks.high == 66);
  CHECK(ranks.ranks == std::vector<std::uint8_t>(101 * 66, 0));
}

TEST_CASE("matching with a contrast weight keeps the contrast round a seam") {
  const FeatureImage image = features(contrast_growing_eastward(160));
  SourceCanvas start(40, 48);
  for (int y = 0; y < start.height; ++y)
    for (int x = 0; x < start.width; ++x)
      start.at(x, y) = x < 20 ? SourceTexel{x + 90, y + 10} : SourceTexel{x + 70, y + 100};
  const std::vector<std::uint8_t> fixed(start.texels.size(), 0);
  const auto contrast = [&](double contrast_weight) {
    PatchMatchOptions options;
    options.contrast_weight = contrast_weight;
    std::vector<SourceCanvas> canvases{start};
    match_and_vote({image, contrast_ranks(image), 1, fixed, {0, 0, 40, 48}}, options, canvases);
    return mean_step(image, canvases[0]);
  };
  const double plain = contrast(0.0);
  CHECK(plain < 0.9 * mean_step(image, start));
  CHECK(contrast(3.0) > 1.05 * plain);
}
