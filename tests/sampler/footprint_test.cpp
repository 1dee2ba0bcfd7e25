#include "support/small_pack.h"

#include "tilepack/sampler/footprint.h"
#include "tilepack/sampler/ground_truth.h"
#include "tilepack/sampler/reference_sampler.h"
#include "tilepack/sampler/virtual_texture.h"

#include <catch2/catch.hpp>
#include <limits>

using namespace tilepack;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// J = U diag(major, minor) V, in texels of 64 x 32 a tile.
Footprint turned(double major, double minor, double u_angle, double v_angle) {
  const double cu = std::cos(u_angle), su = std::sin(u_angle), cv = std::cos(v_angle), sv = std::sin(v_angle);
  return {(cu * major * cv - su * minor * -sv) / 64, (su * major * cv + cu * minor * -sv) / 32,
          (cu * major * sv - su * minor * cv) / 64, (su * major * sv + cu * minor * cv) / 32};
}

std::vector<double> sampled(const Pack& pack, TileCoordinate x, TileCoordinate y, const Footprint& footprint,
                            WrapMode border = WrapMode::wrap) {
  std::vector<double> out(static_cast<std::size_t>(pack.maps[0].channels));
  ReferenceSampler(pack, 0, default_corner_width, border).sample(x, y, footprint, out);
  return out;
}

Pack linear_pack(Size tile = {8, 8}, ColorCounts colors = {2, 2, 0}) {
  SmallPack wanted;
  wanted.encoding = Encoding::linear;
  wanted.depth = Depth::f32;
  wanted.tile_size = tile;
  wanted.colors = colors;
  return small_pack(wanted);
}

} // namespace

TEST_CASE("the half axes are the singular values of the footprint, however both sides are turned") {
  for (double u_angle = -3; u_angle < 3; u_angle += 0.7)
    for (double v_angle = -3; v_angle < 3; v_angle += 1.1) {
      const FootprintEllipse e = ellipse_of(turned(12, 3, u_angle, v_angle), {64, 32});
      CHECK(e.major == Approx(12));
      CHECK(e.minor == Approx(3));
      CHECK(std::fabs(e.x * std::cos(u_angle) + e.y * std::sin(u_angle)) == Approx(1));
      CHECK(level_of(e) == Approx(std::log2(3.0)));
    }
}

TEST_CASE("past the largest anisotropy ellipses grow wider") {
  const FootprintEllipse e = ellipse_of(turned(1000, 0.001, 0.3, 0.8), {64, 32});
  CHECK(e.major == Approx(1000));
  CHECK(e.minor == Approx(1000.0 / max_anisotropy));
}

TEST_CASE("every footprint has an ellipse") {
  CHECK(ellipse_of({}, {8, 8}).major == 0.0);
  CHECK(level_of(ellipse_of({}, {8, 8})) == 0.0);
  const double nan = std::nan("");
  CHECK(ellipse_of({nan, nan, nan, nan}, {8, 8}).major == 0.0);
  CHECK(ellipse_of({0.5, nan, 0, 0.5}, {8, 8}).major == 4.0);
  for (const double odd : {infinity, -infinity, 1e308, -1e308, 1e-308})
    for (const Footprint& f :
         {Footprint{odd, 0, 0, 0}, Footprint{odd, odd, odd, odd}, Footprint{0, odd, -odd, 1}}) {
      const FootprintEllipse e = ellipse_of(f, {8, 8});
      CHECK(std::isfinite(e.major));
      CHECK((e.minor >= 0 && e.minor <= e.major));
      CHECK(e.x * e.x + e.y * e.y == Approx(1));
      CHECK(std::isfinite(level_of(e)));
    }
}

TEST_CASE("an ellipse finds the texels whose centres it holds, and no others") {
  for (const int level : {0, 1, 3})
    for (const Footprint& f : {turned(40, 9, 0.4, 2), turned(3, 0.2, -1, 1), turned(0, 0, 0, 0)}) {
      const FootprintEllipse e = ellipse_of(f, {64, 32});
      const double a = std::clamp(e.major / (1 << level), 1.0, longest_half_axis);
      const double b = std::clamp(e.minor / (1 << level), 1.0, longest_half_axis);
      const double x = 5.3, y = -2.8;
      std::vector<std::pair<int, int>> found, wanted;
      EllipseTexels(e, level).each(x, y, [&](int i, int j, double weight) {
        found.emplace_back(i, j);
        const double along = ((i + 0.5 - x) * e.x + (j + 0.5 - y) * e.y) / a;
        const double across = ((j + 0.5 - y) * e.x - (i + 0.5 - x) * e.y) / b;
        const double rest = 1 - along * along - across * across;
        CHECK(weight == Approx(rest * rest).margin(1e-12));
      });
      for (int j = -60; j < 60; ++j)
        for (int i = -60; i < 60; ++i) {
          const double along = ((i + 0.5 - x) * e.x + (j + 0.5 - y) * e.y) / a;
          const double across = ((j + 0.5 - y) * e.x - (i + 0.5 - x) * e.y) / b;
          if (along * along + across * across < 1) wanted.emplace_back(i, j);
        }
      CHECK(found == wanted);
      CHECK_FALSE(found.empty());
    }
}

TEST_CASE("a footprint of zero gives a texel at its centre, and the same for all that count as zero") {
  const Pack pack = linear_pack();
  const double nan = std::nan("");
  std::vector<double> texel(3);
  ReferenceSampler(pack, 0).sample({2, 3.5 / 8}, {1, 6.5 / 8}, 0, Filter::nearest, texel);
  CHECK(sampled(pack, {2, 3.5 / 8}, {1, 6.5 / 8}, {}) == texel);
  CHECK(sampled(pack, {2, 3.5 / 8}, {1, 6.5 / 8}, {nan, nan, nan, nan}) == texel);
  CHECK(sampled(pack, {2, 3.5 / 8}, {1, 6.5 / 8}, {1e-300, 0, 0, -1e-300}) == texel);
}

TEST_CASE("with one tile the pack is the texture, and its ellipses are the ground truth's") {
  const Pack pack = linear_pack({8, 8}, {1, 1, 0});
  const GroundTruth truth = GroundTruth::of_stored_levels(pack, 0);
  std::vector<double> wanted(3);
  for (const Footprint& f :
       {turned(30, 1, 0.4, 2), turned(9, 7, 1, 1), turned(500, 300, 0, 0), turned(0, 0, 0, 0)})
    for (double at = -3; at < 3; at += 0.37) {
      truth.sample({0, at}, {2, 0.3 - at}, f, wanted);
      const auto got = sampled(pack, {0, at}, {2, 0.3 - at}, f);
      for (std::size_t c = 0; c < 3; ++c) CHECK(got[c] == Approx(wanted[c]).margin(1e-12));
    }
}

TEST_CASE("the ground truth's ellipses are sums over the texture written out, at every border") {
  const Pack pack = linear_pack();
  const Size whole{8 * 6, 8 * 5};
  const Footprint f{0.9 / 8, 0.2 / 8, -2.0 / 8, 0.7 / 8}; // below a texel on the short side: level 0 alone
  const FootprintEllipse e = ellipse_of(f, pack.tile_size);
  REQUIRE(level_of(e) == 0.0);
  const auto tiles = tile_set_of(pack).maps[0].tiles;
  for (const WrapMode border : {WrapMode::wrap, WrapMode::clamp, WrapMode::mirror}) {
    const GroundTruth truth = GroundTruth::of_stored_levels(pack, 0, border);
    constexpr int margin = 8;
    const Image written = virtual_texture(
        pack, tiles, {-margin, -margin, whole.width + 2 * margin, whole.height + 2 * margin}, border);
    for (double x = 0.02; x < 6; x += 0.49)
      for (double y = 0.03; y < 5; y += 0.61) {
        std::array<double, 3> sum{};
        double total = 0;
        EllipseTexels(e, 0).each(x * 8, y * 8, [&](int i, int j, double weight) {
          total += weight;
          for (std::size_t c = 0; c < 3; ++c)
            sum[c] += weight * static_cast<double>(written.texel(i + margin, j + margin)[c]);
        });
        std::array<double, 3> got{};
        truth.sample({0, x}, {0, y}, f, got);
        for (std::size_t c = 0; c < 3; ++c) REQUIRE(got[c] == Approx(sum[c] / total).margin(1e-12));
      }
  }
}

TEST_CASE("far larger than the texture, a footprint sees its mean") {
  Pack pack = linear_pack();
  Image& coarsest = pack.maps[0].levels.back(); // a texel a tile
  double mean = 0;
  for (std::size_t i = 0; i < coarsest.data().size(); i += 3)
    mean += static_cast<double>(coarsest.data()[i]) / 16;
  for (const double large : {100.0, 1e9, infinity})
    CHECK(sampled(pack, {1, 0.3}, {4, 0.9}, {large, 0, 0, large})[0] == Approx(mean).margin(1e-3));
}
