#include "support/enlarged.h"
#include "support/samples.h"

#include "tilepack/exemplar/structure.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

using namespace tilepack;

namespace {

constexpr int edge = 60; // the first bright column

FeatureImage with_edge(int bright) {
  FeatureImage image{160, 40, 1, {}};
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      image.values.push_back(static_cast<std::uint8_t>(x < edge ? 40 : bright));
  return image;
}

} // namespace

TEST_CASE("the channel of structure is nothing at an edge and full structure_range texels away from it") {
  for (const int bright : {60, 220}) { // what counts is not how strong an edge is
    const FeatureImage image = with_structure(with_edge(bright));
    REQUIRE(image.channels == 2);
    CHECK(image.guides == 1);
    for (const int y : {0, 17, 39}) {
      const auto at = [&](int x) { return static_cast<int>(image.texel(x, y)[1]); };
      CHECK(image.texel(3, y)[0] == 40);
      CHECK(at(edge - 1) == 0);
      CHECK(at(edge) == 0);
      int zeros = 0;
      for (int x = 0; x < image.width; ++x) {
        zeros += at(x) == 0;
        if (x < edge - 1 - structure_range - 3 || x > edge + structure_range + 3) CHECK(at(x) == 255);
        if (x > edge) CHECK((at(x) >= at(x - 1) && at(x) - at(x - 1) <= 255 / structure_range + 1));
      }
      CHECK(zeros <= 160 / 10); // only the steepest tenth is an edge
      const auto first = [&](int wanted) {
        int x = edge;
        while (at(x) < wanted) ++x;
        return x;
      };
      CHECK(first(255) - (first(1) - 1) == structure_range);
    }
  }
}

TEST_CASE("the weight scales the channel, and nothing of it leaves the image as it is") {
  const FeatureImage plain = with_edge(200);
  const FeatureImage half = with_structure(plain, {0.5, 0.5});
  CHECK(*std::max_element(half.values.begin(), half.values.end()) == 200);
  CHECK(half.texel(5, 5)[1] == 128);
  const FeatureImage none = with_structure(plain, {0.0, 0.5});
  CHECK(none.values == plain.values);
  CHECK(none.flat_seam == 0);
}

TEST_CASE("what a flat seam costs follows the variance of the sample") {
  const FeatureImage plain = with_edge(200);
  CHECK(variance_of(plain) == 6000); // 3/8 and 5/8 of all texels, 160 apart
  CHECK(with_structure(plain, {1.0, 0.5}).flat_seam == 3000);
  CHECK(with_structure(plain, {1.0, 0.0}).flat_seam == 0);
}

TEST_CASE("differences are seen on what is flat, and lost in what is busy") {
  FeatureImage image{96, 48, 1, {}}; // noise in the west, none in the east
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      image.values.push_back(static_cast<std::uint8_t>(x < 48 ? 90 + (x * 7 + y * 13 + x * y) % 41 : 110));
  const FeatureImage seen = with_structure(image);
  REQUIRE(seen.sensitivity.size() == 96 * 48);
  const auto at = [&](const FeatureImage& i, int x, int y) {
    return i.sensitivity[static_cast<std::size_t>(y * i.width + x)];
  };
  CHECK(at(seen, 80, 24) > 2 * at(seen, 20, 24));
  double sum = 0;
  for (const auto s : seen.sensitivity) sum += s;
  CHECK(sum / (96 * 48) == Approx(sensitivity_unit).epsilon(0.02));
  CHECK(at(halved(seen), 40, 12) == at(seen, 80, 24));
  StructureOptions wide;
  wide.sensitivity_floor = 100; // next to nothing is told apart
  CHECK(at(with_structure(image, wide), 80, 24) <= 1.05 * at(with_structure(image, wide), 20, 24));
}

TEST_CASE("an image with all channels gets none of structure") {
  FeatureImage full{8, 8, max_feature_channels, {}};
  full.values.resize(64 * max_feature_channels);
  CHECK(with_structure(full).channels == max_feature_channels);
}

TEST_CASE("distances and sensitivities are those of the definition, for images of many bands too") {
  FeatureImage image{37, 300, 2, {}};
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < 2; ++c)
        image.values.push_back(
            static_cast<std::uint8_t>((x / 5 * 37 + y / 9 * 61 + (y % 7 == 0 ? x * x : 0)) % 200 + c));
  const FeatureImage seen = with_structure(image);
  const auto clamped = [](int v, int end) { return std::clamp(v, 0, end - 1); };
  std::vector<double> inverse;
  double mean = 0, all = 0;
  std::vector<std::int64_t> steps;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      steps.push_back(squared_difference(image.texel(x, y), image.texel(clamped(x + 1, image.width), y), 2) +
                      squared_difference(image.texel(x, y), image.texel(x, clamped(y + 1, image.height)), 2));
      mean += static_cast<double>(steps.back());
    }
  mean /= static_cast<double>(steps.size());
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      std::int64_t sum = 0, count = 0;
      for (int j = std::max(0, y - 3); j < std::min(image.height, y + 4); ++j)
        for (int i = std::max(0, x - 3); i < std::min(image.width, x + 4); ++i, ++count)
          sum += steps[static_cast<std::size_t>(j * image.width + i)];
      inverse.push_back(mean / (0.6 * mean + static_cast<double>(sum) / static_cast<double>(count)));
      all += inverse.back();
    }
  int off = 0;
  for (std::size_t i = 0; i < inverse.size(); ++i)
    off +=
        std::abs(seen.sensitivity[i] - 32 * inverse[i] / (all / static_cast<double>(inverse.size()))) > 0.51;
  CHECK(off == 0);
  // Neighbours differ by a step of the distance at most, and a texel next to an edge is a step from it.
  int jumps = 0, edges = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const int d = seen.texel(x, y)[2];
      edges += d == 0;
      if (x + 1 < image.width) jumps += std::abs(d - seen.texel(x + 1, y)[2]) > 22;
      if (y + 1 < image.height) jumps += std::abs(d - seen.texel(x, y + 1)[2]) > 22;
      if (x + 1 < image.width && y + 1 < image.height)
        jumps += std::abs(d - seen.texel(x + 1, y + 1)[2]) > 31;
    }
  CHECK(jumps == 0);
  CHECK(edges > 0);
}

TEST_CASE("structure is seen on a halved image, and brought back") {
  const Image small = testing::blobs(96, 80, 3, 1, 5);
  const FeatureImage plain = testing::features(small), large = testing::features(testing::enlarged(small, 4));
  const FeatureImage once = with_structure(plain), seen = with_structure(large, {}, 2);
  REQUIRE((seen.width == 384 && seen.height == 320 && seen.channels == 2));
  double off = 0;
  for (int y = 0; y < small.height(); ++y)
    for (int x = 0; x < small.width(); ++x) {
      // Round the middle of what was one texel, within what bilinear weights may take from its neighbours.
      const int now = seen.texel(4 * x + 2, 4 * y + 2)[1], then = once.texel(x, y)[1];
      CHECK(std::abs(now - then) <= 2 * 255 / structure_range);
      off += std::abs(now - then);
      CHECK(seen.texel(4 * x + 2, 4 * y + 2)[0] == large.texel(4 * x + 2, 4 * y + 2)[0]);
    }
  CHECK(off / (small.width() * small.height()) < 6);
  CHECK(with_structure(plain, {}, 0).values == once.values);
  CHECK(with_structure(plain, {}, 0).sensitivity == once.sensitivity);
  CHECK(with_structure(plain, {}, 20).values.size() == once.values.size()); // no more than can be halved
}
