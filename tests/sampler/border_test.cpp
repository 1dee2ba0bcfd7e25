#include "support/small_pack.h"

#include "tilepack/sampler/ground_truth.h"
#include "tilepack/sampler/reference_sampler.h"
#include "tilepack/sampler/render.h"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>

using namespace tilepack;

namespace {

constexpr std::array borders{WrapMode::wrap, WrapMode::clamp, WrapMode::mirror};

std::vector<double> sampled(const Pack& pack, WrapMode border, TileCoordinate x, TileCoordinate y,
                            double level, Filter filter) {
  std::vector<double> out(static_cast<std::size_t>(pack.maps[0].channels));
  ReferenceSampler(pack, 0, default_corner_width, border).sample(x, y, level, filter, out);
  return out;
}

Pack linear_pack(Size tile = {8, 8}) {
  SmallPack wanted;
  wanted.encoding = Encoding::linear;
  wanted.depth = Depth::f32;
  wanted.tile_size = tile;
  return small_pack(wanted);
}

} // namespace

TEST_CASE("borders have names") {
  for (const WrapMode border : borders) CHECK(enum_named<WrapMode>(name_of(border)) == border);
  CHECK_FALSE(enum_named<WrapMode>("repeat"));
}

TEST_CASE("a row goes on beyond its ends as its border says") {
  const auto row = [](WrapMode border) {
    std::string text;
    for (std::int64_t i = -7; i < 10; ++i) text += static_cast<char>('0' + within(i, 3, border));
    return text;
  };
  CHECK(row(WrapMode::wrap) == "20120120120120120");
  CHECK(row(WrapMode::clamp) == "00000000122222222");
  CHECK(row(WrapMode::mirror) == "00122100122100122");
  for (const WrapMode border : borders) CHECK(within(-5, 1, border) == 0);
}

TEST_CASE("places beyond the texture are brought back into it") {
  const double below_one = std::nextafter(1.0, 0.0);
  CHECK(within(TileCoordinate{-1, 0.25}, 3, WrapMode::wrap) == TileCoordinate{2, 0.25});
  CHECK(within(TileCoordinate{-1, 0.25}, 3, WrapMode::clamp) == TileCoordinate{0, 0.0});
  CHECK(within(TileCoordinate{3, 0.0}, 3, WrapMode::clamp) == TileCoordinate{2, below_one});
  CHECK(within(TileCoordinate{0, -0.25}, 3, WrapMode::mirror) == TileCoordinate{0, 0.25});
  CHECK(within(TileCoordinate{3, 0.25}, 3, WrapMode::mirror) == TileCoordinate{2, 0.75});
  CHECK(within(TileCoordinate{3, 0.0}, 3, WrapMode::mirror) == TileCoordinate{2, below_one});
  CHECK(within(TileCoordinate{4, 0.0}, 3, WrapMode::mirror) == TileCoordinate{2, 0.0});
  CHECK(within(TileCoordinate{3, 1e-20}, 3, WrapMode::mirror) == TileCoordinate{2, below_one});
  CHECK(within(TileCoordinate{6, 0.5}, 3, WrapMode::mirror) == TileCoordinate{0, 0.5});
  for (const WrapMode border : borders) {
    CHECK(within(TileCoordinate{1, 0.5}, 3, border) == TileCoordinate{1, 0.5});
    CHECK(within(TileCoordinate{0, std::nan("")}, 3, border) == TileCoordinate{0, 0.0});
    const TileCoordinate far =
        within(TileCoordinate{std::int64_t{1} << 62, 0.5}, std::int64_t{1} << 31, border);
    CHECK((far.tile >= 0 && far.tile < std::int64_t{1} << 31 && far.fraction >= 0 && far.fraction < 1));
  }
}

// Away from borders of tiles the pack's neighbour can't be told from the texture's; at the border of the
// texture nothing beyond it may be read.
TEST_CASE("at a border of the texture filters read what the ground truth reads") {
  for (const Size size : {Size{8, 8}, Size{7, 3}, Size{1, 1}}) {
    const Pack pack = linear_pack(size);
    for (const WrapMode border : {WrapMode::clamp, WrapMode::mirror}) {
      const GroundTruth truth = GroundTruth::of_stored_levels(pack, 0, border);
      const auto width = static_cast<double>(pack.mapping.size.width);
      for (const double x : {-20.3, -1.0, -0.04, 0.0, 0.03, width - 0.03, width, width + 0.02, width + 31.4})
        for (const Filter filter : {Filter::nearest, Filter::bilinear, Filter::trilinear})
          for (const double level : {0.0, 0.6}) {
            std::array<double, 3> wanted{};
            const double y = (size.height / 2 + 0.5) / size.height + 2;
            if (border == WrapMode::mirror && (x <= -1 || x > width + 2)) continue; // borders of tiles inside
            truth.sample({0, x}, {0, y}, level, filter, wanted);
            const auto got = sampled(pack, border, {0, x}, {0, y}, level, filter);
            for (std::size_t c = 0; c < 3; ++c) {
              INFO(name_of(border) << ' ' << name_of(filter) << " x " << x << " level " << level);
              CHECK(got[c] == Approx(wanted[c]).margin(1e-9));
            }
          }
    }
  }
}

TEST_CASE("clamped, all that lies beyond a border is its texel") {
  const Pack pack = linear_pack();
  for (const Filter filter : {Filter::nearest, Filter::bilinear, Filter::trilinear}) {
    const auto edge = sampled(pack, WrapMode::clamp, {0, 0.5 / 8}, {2, 3.5 / 8}, 0, filter);
    for (const double x : {0.0, -1e-9, -0.5, -77.0, -1e300})
      CHECK(sampled(pack, WrapMode::clamp, {0, x}, {2, 3.5 / 8}, 0, filter) == edge);
    const auto far = sampled(pack, WrapMode::clamp, {5, 7.5 / 8}, {2, 3.5 / 8}, 0, filter);
    CHECK(far != edge);
    for (const double x : {6.0, 6.5, 1e6})
      CHECK(sampled(pack, WrapMode::clamp, {0, x}, {2, 3.5 / 8}, 0, filter) == far);
  }
}

TEST_CASE("mirrored, the texture is the same either side of a border") {
  const Pack pack = linear_pack();
  for (const Filter filter : {Filter::bilinear, Filter::trilinear})
    for (const double off : {0.01, 0.3, 0.77, 1.4, 5.9}) {
      const auto a = sampled(pack, WrapMode::mirror, {0, off}, {1, 0.4}, 0.3, filter);
      const auto b = sampled(pack, WrapMode::mirror, {0, -off}, {1, 0.4}, 0.3, filter);
      const auto c = sampled(pack, WrapMode::mirror, {12, off}, {-1, 0.6 - 1}, 0.3, filter);
      for (std::size_t i = 0; i < 3; ++i) {
        CHECK(a[i] == Approx(b[i]).margin(1e-9));
        CHECK(a[i] == Approx(c[i]).margin(1e-9));
      }
    }
}

TEST_CASE("ellipses at a border that doesn't wrap read nothing beyond it") {
  Pack pack = linear_pack();
  // Only the cell at the west border is dark; what lies west of it in the pack is bright.
  const Cell cell = pack.layout.cells[static_cast<std::size_t>(tile_at(pack.mapping, pack.colors, 0, 2))];
  for (Image& level : pack.maps[0].levels) {
    const int side = level.width() / pack.layout.columns;
    for (float& v : level.data()) v = 1.0f;
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x)
        for (float& v : level.texel(cell.column * side + x, cell.row * side + y)) v = 0.0f;
  }
  const Footprint wide{3.0 / 8, 0, 0, 0.5 / 8};
  std::vector<double> out(3);
  for (const WrapMode border : {WrapMode::clamp, WrapMode::mirror}) {
    ReferenceSampler(pack, 0, default_corner_width, border).sample({0, 0.5 / 8}, {2, 0.5}, wide, out);
    CHECK(out[0] == 0.0);
  }
  ReferenceSampler(pack, 0).sample({0, 0.5 / 8}, {2, 0.5}, wide, out);
  CHECK(out[0] > 0.2);
}

TEST_CASE("rendered windows go on beyond the texture as the border says, at scale 1 and elsewhere") {
  const Pack pack = linear_pack();
  const int width = 8 * 6;
  for (const double scale : {1.0, 2.0}) {
    const auto pixels = static_cast<int>(scale);
    const auto rendered = [&](WrapMode border, bool elliptical) {
      View view{{-8, 4, width + 16, 8}, 0, scale, Filter::bilinear};
      view.border = border;
      view.elliptical = elliptical;
      const Renderer renderer(pack, 0, view, {Encoding::linear, Depth::f32});
      return renderer.rows(0, renderer.size().height);
    };
    for (const bool elliptical : {false, true}) {
      const Image clamped = rendered(WrapMode::clamp, elliptical);
      const Image mirrored = rendered(WrapMode::mirror, elliptical);
      for (int y = 0; y < clamped.height(); ++y)
        for (int x = 0; x < 7 * pixels; ++x)
          for (std::size_t c = 0; c < 3; ++c) {
            REQUIRE(clamped.texel(x, y)[c] == clamped.texel(0, y)[c]);
            REQUIRE(mirrored.texel(8 * pixels + x, y)[c] ==
                    Approx(mirrored.texel(8 * pixels - 1 - x, y)[c]).margin(1e-6));
          }
    }
  }
}
