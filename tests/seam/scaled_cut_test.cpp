#include "support/samples.h"

#include "tilepack/seam/scaled_cut.h"

#include <catch2/catch.hpp>

using namespace tilepack;
using testing::blobs;
using testing::features;

namespace {

FeaturePyramid pyramid_of(const FeatureImage& image, int levels) {
  FeaturePyramid pyramid(image);
  for (int level = 1; level < levels; ++level) pyramid.add_half();
  return pyramid;
}

SourceCanvas shown_from(SourceTexel first, int side) {
  SourceCanvas canvas(side, side);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) canvas.at(x, y) = {first.x + x, first.y + y};
  return canvas;
}

// Over a square in the midst of a canvas, its outermost texels to be kept and its middle taken.
LaidPatch ring(SourceTexel origin, int border, int side, int middle) {
  LaidPatch patch{{border, border, side, side}, origin, {}};
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const int from_border = std::min({x, y, side - 1 - x, side - 1 - y});
      patch.constraints.push_back(from_border < 5                      ? CutConstraint::keep
                                  : from_border >= (side - middle) / 2 ? CutConstraint::take
                                                                       : CutConstraint::free);
    }
  return patch;
}

} // namespace

TEST_CASE("cuts of small scales are those of lay_patch") {
  const FeatureImage image = features(blobs(160, 160));
  const LaidPatch patch = ring({30, 20}, 8, 48, 10);
  SourceCanvas one = shown_from({4, 60}, 64), other = one;
  lay_patch(image, one, patch);
  lay_patch_by_scales(pyramid_of(image, 3), other, patch);
  CHECK(one.texels == other.texels);
}

TEST_CASE("a cut that comes down scale by scale keeps and takes what it must, and costs little more than the "
          "best") {
  const FeatureImage image = features(blobs(600, 600, 1, 3, 12));
  for (const int levels : {4, 5, 6})
    for (const SourceTexel origin : {SourceTexel{150, 101}, SourceTexel{33, 77}}) {
      const LaidPatch patch = ring(origin, 37, 300, 40);
      const SourceCanvas before = shown_from({61, 163}, 374);
      SourceCanvas best = before, scaled = before;
      lay_patch(image, best, patch);
      CHECK(lay_patch_by_scales(pyramid_of(image, levels), scaled, patch));
      int wrong = 0, taken = 0;
      for (int y = 0; y < 374; ++y)
        for (int x = 0; x < 374; ++x) {
          const SourceTexel kept = before.at(x, y), laid{origin.x + x, origin.y + y}, shown = scaled.at(x, y);
          const bool inside = x >= 37 && y >= 37 && x < 337 && y < 337;
          const CutConstraint asked =
              inside ? patch.constraints[static_cast<std::size_t>((y - 37) * 300 + x - 37)]
                     : CutConstraint::keep;
          wrong += asked == CutConstraint::keep   ? shown != kept
                   : asked == CutConstraint::take ? shown != laid
                                                  : shown != kept && shown != laid;
          taken += shown == laid;
        }
      CHECK(wrong == 0);
      CHECK(taken > 40 * 40);
      INFO(levels << " levels, " << seam_energy(image, scaled) << " for " << seam_energy(image, best));
      CHECK(seam_energy(image, scaled) >= seam_energy(image, best));
      CHECK(static_cast<double>(seam_energy(image, scaled)) <
            1.5 * static_cast<double>(seam_energy(image, best)));
    }
}

TEST_CASE("what is settled leaves a band round the line") {
  // The west half takes, of 8 × 4 coarse texels.
  std::vector<std::uint8_t> taken;
  for (int i = 0; i < 32; ++i) taken.push_back(i % 8 < 4);
  const std::vector<CutConstraint> settled = settled_by(taken, {8, 4}, {33, 16}, 4);
  REQUIRE(settled.size() == 33 * 16);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 33; ++x)
      CHECK(settled[static_cast<std::size_t>(y * 33 + x)] == (x < 12   ? CutConstraint::take
                                                              : x < 20 ? CutConstraint::free
                                                              : x < 32 ? CutConstraint::keep
                                                                       : CutConstraint::free));
}
