#include "support/images.h"

#include "tilepack/match/patch_search.h"
#include "tilepack/match/plane_transform.h"
#include "tilepack/numeric/random.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <numbers>

using namespace tilepack;

namespace {

// By the sum that defines it, of the numbers in the corner `filled` of a plane that is 0 elsewhere.
std::vector<std::complex<double>> transform_by_definition(const ComplexPlane& plane, Size filled) {
  std::vector<std::complex<double>> result;
  for (int v = 0; v < plane.rows; ++v)
    for (int u = 0; u < plane.columns; ++u) {
      std::complex<double> sum = 0;
      for (int y = 0; y < filled.height; ++y)
        for (int x = 0; x < filled.width; ++x)
          sum += std::complex(plane.real_row(y)[x], plane.imaginary_row(y)[x]) *
                 std::polar(1.0, -2 * std::numbers::pi *
                                     (double(u) * x / plane.columns + double(v) * y / plane.rows));
      result.push_back(sum);
    }
  return result;
}

void fill(ComplexPlane& plane, Size filled, std::uint64_t seed) {
  for (std::size_t i = 0; i < plane.count(); ++i) plane.real[i] = plane.imaginary[i] = std::nan("");
  for (int y = 0; y < filled.height; ++y)
    for (int x = 0; x < filled.width; ++x) {
      const auto at = static_cast<std::uint64_t>(y * plane.columns + x);
      plane.real_row(y)[x] = static_cast<double>(random_below(seed, "real", at, 1000)) - 500;
      plane.imaginary_row(y)[x] = static_cast<double>(random_below(seed, "imaginary", at, 1000)) - 500;
    }
}

bool by_size(const std::complex<double>& a, const std::complex<double>& b) {
  return std::abs(a) < std::abs(b);
}

} // namespace

TEST_CASE("sides of transforms are products of two, three and five") {
  CHECK(transform_size(1) == 1);
  CHECK(transform_size(7) == 8);
  CHECK(transform_size(60) == 60);
  CHECK(transform_size(61) == 64);
  CHECK(transform_size(271) == 288);
  CHECK(transform_size(1025) == 1080);
}

TEST_CASE(
    "the transform of a plane holds the numbers that its definition gives, and leads back to the plane") {
  for (const Size size :
       {Size{1, 1}, Size{8, 4}, Size{30, 9}, Size{16, 25}, Size{5, 12}, Size{27, 2}, Size{40, 32}})
    for (const Size filled : {size, Size{(size.width + 1) / 2, (size.height + 2) / 3}}) {
      CAPTURE(size.width, size.height, filled.width, filled.height);
      const PlaneTransform transform(size.height, size.width);
      ComplexPlane plane(size.height, size.width), before(size.height, size.width);
      fill(plane, filled, 3);
      fill(before, filled, 3);
      transform.forward(plane, filled);
      // In which order is the transform's own affair.
      std::vector<std::complex<double>> numbers, wanted = transform_by_definition(before, filled);
      for (std::size_t i = 0; i < plane.count(); ++i) numbers.emplace_back(plane.real[i], plane.imaginary[i]);
      std::sort(numbers.begin(), numbers.end(), by_size);
      std::sort(wanted.begin(), wanted.end(), by_size);
      double worst = 0;
      for (std::size_t i = 0; i < numbers.size(); ++i)
        worst = std::max(worst, std::abs(std::abs(numbers[i]) - std::abs(wanted[i])));
      CHECK(worst < 1e-8);
      transform.inverse(plane, filled);
      worst = 0;
      for (int y = 0; y < filled.height; ++y)
        for (int x = 0; x < filled.width; ++x)
          worst = std::max(worst, std::abs(plane.real_row(y)[x] - before.real_row(y)[x]));
      CHECK(worst < 1e-10);
    }
}

TEST_CASE("sums of the largest values stay exact") {
  // Black and white, of as many channels as there may be, with the largest weights: no sums are larger.
  constexpr int channels = 16, patch = 150;
  FeatureImage image = test::noise_features(700, 500, channels, 5);
  FeatureImage layer = test::noise_features(patch, patch, channels, 6);
  for (FeatureImage* one : {&image, &layer})
    for (std::uint8_t& value : one->values) value = value < 100 ? 0 : 255;
  Overlap overlap(patch, patch, channels);
  for (int y = 0; y < patch; ++y)
    for (int x = 0; x < patch; ++x) overlap.add(x, y, layer.texel(x, y), 64);
  const PositionMap map = PatchSearch(image).mismatches(overlap);
  for (const auto& [x, y] :
       {std::pair(0, 0), std::pair(map.width - 1, map.height - 1), std::pair(311, 87), std::pair(5, 349)})
    CHECK(map.at(x, y) == mismatch_at(image, overlap, {x, y}));
}
