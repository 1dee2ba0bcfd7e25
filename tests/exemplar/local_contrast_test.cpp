#include "support/samples.h"

#include "tilepack/exemplar/local_contrast.h"

#include <catch2/catch.hpp>
#include <numeric>

using namespace tilepack;
using testing::features;

namespace {

// Grey, with one bright cell.
Image with_spot(int side, int column, int row) {
  Image image(side, side, 1, 0.25F);
  for (int y = 0; y < LocalContrast::side; ++y)
    for (int x = 0; x < LocalContrast::side; ++x)
      image.texel(column * LocalContrast::side + x, row * LocalContrast::side + y)[0] = 0.75F;
  return image;
}

} // namespace

TEST_CASE("a cell has contrast by how far it is from the mean of what lies round it") {
  const LocalContrast cells = local_contrast(features(with_spot(22, 5, 6)));
  REQUIRE((cells.wide == 11 && cells.high == 11));
  // The spot is off the mean of 25 cells by 24 parts of 25, each of the 24 round it by one; squares add up to 24² + 24.
  const double mean = (24.0 * 24 + 24) / (11 * 11);
  CHECK(cells.at(5, 6) == Approx(24 * 24 / mean));
  CHECK(cells.at(3, 4) == Approx(1 / mean));
  CHECK(cells.at(2, 6) == 0);
  CHECK(std::accumulate(cells.values.begin(), cells.values.end(), 0.0) == Approx(11 * 11));
  const Rect of_spot{10, 12, 2, 2};
  CHECK(mean_in(cells, of_spot) == Approx(24 * 24 / mean));
  CHECK(mean_in(cells, {0, 12, 6, 2}) == 0);
  CHECK(mean_in(cells, {-4, -4, 100, 100}) == Approx(1));
}

TEST_CASE("where nothing differs, and where no cell lies, nothing is plainer than the rest") {
  const LocalContrast plain = local_contrast(features(Image(9, 7, 3, 0.5F)));
  CHECK(plain.values == std::vector<double>(4 * 3, 0.0));
  CHECK(mean_in(plain, {50, 50, 4, 4}) == 1);
  CHECK(local_contrast(features(Image(1, 9, 3, 0.5F))).values.empty());
}

TEST_CASE("guides are no part of contrast") {
  FeatureImage image = features(with_spot(22, 5, 6));
  const LocalContrast without = local_contrast(image);
  FeatureImage guided{image.width, image.height, image.channels + 1, {}};
  guided.guides = 1;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      for (int c = 0; c < image.channels; ++c) guided.values.push_back(image.texel(x, y)[c]);
      guided.values.push_back(static_cast<std::uint8_t>(17 * x + 31 * y));
    }
  CHECK(local_contrast(guided).values == without.values);
}
