#include "support/samples.h"

#include "tilepack/exemplar/statistics.h"

#include <catch2/catch.hpp>

using namespace tilepack;
using testing::blobs;

TEST_CASE("the sample's own statistics are at distance nought, a part's are not") {
  const SampleMap map = testing::color_map(blobs(64, 64));
  const SampleStatistics statistics(feature_image(std::span(&map, 1)));
  auto tally = statistics.empty();
  statistics.add(tally, {0, 0, 64, 64}, 2.0);
  CHECK(statistics.distance(tally) == Approx(0.0).margin(1e-12));
  auto part = statistics.empty();
  statistics.add(part, {8, 8, 9, 9}, 1.0);
  CHECK(statistics.distance(part) > 0.0);
  CHECK(statistics.distance_with(statistics.empty(), {8, 8, 9, 9}, 1.0) == Approx(statistics.distance(part)));
  statistics.add(part, {8, 8, 9, 9}, -1.0);
  CHECK(part.texels == 0.0);
}
