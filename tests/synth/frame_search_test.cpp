#include "support/samples.h"

#include "tilepack/exemplar/local_contrast.h"
#include "tilepack/numeric/random.h"
#include "tilepack/synth/frame_search.h"

#include <catch2/catch.hpp>

using namespace tilepack;

namespace {

// Fine noise all over, and stones of 6 × 6 texels on a third of it, in the east.
FeatureImage stones_in_the_east(int side) {
  Image image(side, side, 1);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const auto index = static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(side) + x;
      const bool stone = 3 * x > 2 * side && x % 12 < 6 && y % 14 < 6;
      image.texel(x, y)[0] =
          (stone ? 0.75F : 0.35F) + 0.05F * static_cast<float>(random_below(7, "noise", index, 3));
    }
  return testing::features(image);
}

} // namespace

TEST_CASE(
    "corner patches lie in plain parts where a sample has some, for half of all lattice points show one") {
  const SampleAnalysis sample = analysed(stones_in_the_east(160), {});
  const LocalContrast contrast = local_contrast(sample.features);
  const SearchSpace space(sample,
                          frame_shape(testing::two_colors({32, 32}, Coloring::corner, 0), {}, 0.2, 0.3),
                          FeaturePyramid(sample.features));
  FrameSearchOptions plain, anywhere;
  anywhere.plain_contrast = 0;
  double with = 0, without = 0;
  for (plain.seed = anywhere.seed = 0; plain.seed < 8; ++plain.seed, ++anywhere.seed) {
    const int half = space.shape.corner_reach.x / 2;
    for (const SourceTexel& at : searched_frame(space, plain, {}).corners) {
      const double shown = mean_in(contrast, {at.x - half, at.y - half, 2 * half, 2 * half});
      CHECK(shown < plain.plain_contrast);
      with += shown;
    }
    for (const SourceTexel& at : searched_frame(space, anywhere, {}).corners)
      without += mean_in(contrast, {at.x - half, at.y - half, 2 * half, 2 * half});
  }
  CHECK(with < 0.2 * without);
}
