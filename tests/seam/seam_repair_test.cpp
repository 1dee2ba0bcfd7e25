#include "seam/seamed_canvases.h"
#include "support/enlarged.h"

#include "tilepack/seam/seam_repair.h"

#include <algorithm>
#include <catch2/catch.hpp>

using namespace tilepack;
using testing::blobs;
using testing::features;
using testing::with_seam;

namespace {

constexpr Size canvas_size{48, 40};

UseTable unused(const FeatureImage& image) {
  return prepared(UseCounts(image.width, image.height));
}

} // namespace

TEST_CASE("repair lowers the seam energy, patch by patch, and leaves fixed texels alone") {
  const FeatureImage image = features(blobs(96, 96));
  FeaturePyramid pyramid(image);
  pyramid.add_half();
  const PatchSearch search(pyramid.back());
  const SourceCanvas start = with_seam(canvas_size, 24, {40, 50});
  std::vector<std::uint8_t> fixed(start.texels.size());
  for (std::size_t i = 0; i < fixed.size(); ++i) fixed[i] = i % 48 < 22 || i % 7 == 0;
  std::int64_t energy = seam_energy(image, start);
  for (const int patches : {1, 2, 4}) {
    SourceCanvas canvas = start;
    SeamRepairOptions options;
    options.patches = patches;
    replace_worst_patches({pyramid, search, unused(pyramid.back()), {}, fixed}, options, canvas);
    INFO(patches << " patches");
    CHECK(seam_energy(image, canvas) < energy);
    energy = seam_energy(image, canvas);
    for (std::size_t i = 0; i < fixed.size(); ++i)
      if (fixed[i]) CHECK(canvas.texels[i] == start.texels[i]);
  }
}

TEST_CASE("repair changes nothing where there is no seam, where all is fixed, and for no patches") {
  const FeatureImage image = features(blobs(96, 96));
  const FeaturePyramid pyramid(image);
  const PatchSearch search(image);
  const UseTable uses = unused(image);
  const SourceCanvas whole = with_seam(canvas_size, 24, {0, 0});
  const SourceCanvas seamed = with_seam(canvas_size, 24, {40, 50});
  const std::vector<std::uint8_t> none(whole.texels.size(), 0), all(whole.texels.size(), 1);
  SourceCanvas canvas = whole;
  replace_worst_patches({pyramid, search, uses, {}, none}, {}, canvas);
  CHECK(canvas.texels == whole.texels);
  canvas = seamed;
  replace_worst_patches({pyramid, search, uses, {}, all}, {}, canvas);
  CHECK(canvas.texels == seamed.texels);
  SeamRepairOptions options;
  options.patches = 0;
  replace_worst_patches({pyramid, search, uses, {}, none}, options, canvas);
  CHECK(canvas.texels == seamed.texels);
}

TEST_CASE("the worst patch is replaced first, within a window round it") {
  // A seam everywhere along a column, and a worse one at the canvas's foot: flat there, against blobs.
  Image sample = blobs(96, 96);
  for (int y = 30; y < 40; ++y)
    for (int x = 0; x < 24; ++x) std::fill_n(sample.texel(x, y).begin(), 3, 0.0f);
  for (int y = 80; y < 90; ++y)
    for (int x = 60; x < 96; ++x) std::fill_n(sample.texel(x, y).begin(), 3, 1.0f);
  const FeatureImage image = features(sample);
  const FeaturePyramid pyramid(image);
  const PatchSearch search(image);
  const SourceCanvas start = with_seam(canvas_size, 24, {40, 50});
  const std::vector<std::uint8_t> fixed(start.texels.size(), 0);
  SourceCanvas canvas = start;
  SeamRepairOptions options;
  options.patches = 1;
  options.window = 16;
  replace_worst_patches({pyramid, search, unused(image), {}, fixed}, options, canvas);
  CHECK(canvas.texels != start.texels);
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 48; ++x)
      if (y < 20 || x < 8 || x >= 40) CHECK(canvas.at(x, y) == start.at(x, y));
}

TEST_CASE("a repair stays in step with the sample's period") {
  const FeatureImage image = features(blobs(96, 96));
  const FeaturePyramid pyramid(image);
  const PatchSearch search(image);
  // Canvas texel (x, y) may show sample texel (u, v) only if u - x is a multiple of 8, or one off.
  const PeriodAlignment alignment({{8.0, 1.0}, {}}, {48, 40});
  const SourceCanvas start = with_seam(canvas_size, 24, {40, 50});
  const std::vector<std::uint8_t> fixed(start.texels.size(), 0);
  SourceCanvas canvas = start;
  replace_worst_patches({pyramid, search, unused(image), alignment, fixed}, {}, canvas);
  CHECK(canvas.texels != start.texels);
  int off = 0;
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 48; ++x) {
      const int rest = (canvas.at(x, y).x - x + 96) % 8;
      off += rest > 2 && rest < 6; // a texel allowed, and one by which the place found is refined
    }
  CHECK(off == 0);
}

TEST_CASE("repair takes windows that are not shown yet, where they are as like") {
  const FeatureImage image = features(testing::four_quarters());
  const FeaturePyramid pyramid(image);
  const PatchSearch search(pyramid.back());
  UseCounts counts(128, 128);
  counts.add({0, 0, 128, 64}, 3.0);
  counts.add({0, 64, 64, 64}, 3.0);
  const SourceCanvas start = with_seam({56, 40}, 28, {-28, 12});
  SourceCanvas canvas = start;
  const std::vector<std::uint8_t> fixed(canvas.texels.size(), 0);
  SeamRepairOptions options;
  options.patches = 2;
  options.window = 24;
  replace_worst_patches({pyramid, search, prepared(counts), {}, fixed}, options, canvas);
  std::size_t shown_before = 0;
  std::size_t fresh = 0;
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 56; ++x) {
      const SourceTexel s = canvas.at(x, y);
      if (s == start.at(x, y)) continue;
      ++(s.x >= 64 && s.y >= 64 ? fresh : shown_before);
    }
  CHECK(fresh > 100);
  CHECK(fresh > 4 * shown_before);
}

TEST_CASE("repair of large things replaces large squares, and seam energy still falls") {
  const FeatureImage image = features(testing::enlarged(blobs(64, 64), 8));
  FeaturePyramid pyramid(image);
  while (pyramid.size() < 5) pyramid.add_half();
  const PatchSearch search(pyramid.back());
  const SourceCanvas start = with_seam({384, 320}, 192, {40, 50});
  const std::vector<std::uint8_t> fixed(start.texels.size());
  SourceCanvas canvas = start;
  SeamRepairOptions options;
  options.patches = 1;
  replace_worst_patches({pyramid, search, unused(pyramid.back()), {}, fixed}, options, canvas);
  CHECK(seam_energy(image, canvas) < seam_energy(image, start));
  int west = 384, east = 0;
  for (int y = 0; y < 320; ++y)
    for (int x = 0; x < 384; ++x)
      if (canvas.at(x, y) != start.at(x, y)) {
        west = std::min(west, x);
        east = std::max(east, x);
      }
  CHECK(east - west >= options.window); // four times that may be replaced
  CHECK(east - west < 4 * options.window);
}
