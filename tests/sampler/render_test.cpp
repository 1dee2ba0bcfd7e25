#include "support/small_pack.h"

#include "tilepack/error/error.h"
#include "tilepack/numeric/exact_math.h"
#include "tilepack/numeric/wrap.h"
#include "tilepack/sampler/reference_sampler.h"
#include "tilepack/sampler/render.h"

#include <tbb/global_control.h>

#include <array>
#include <catch2/catch.hpp>
#include <limits>

using namespace tilepack;

namespace {

// The texel the virtual texture has at (x, y), by the definition: cell, tile, place.
std::span<const float> stored_texel(const Pack& pack, int level, std::int64_t x, std::int64_t y) {
  const std::int64_t width = pack.tile_size.width >> level;
  const std::int64_t height = pack.tile_size.height >> level;
  const std::int64_t i = wrapped(x, width);
  const std::int64_t j = wrapped(y, height);
  const int id = tile_at(pack.mapping, pack.colors, (x - i) / width, (y - j) / height);
  const Cell& cell = pack.layout.cells[static_cast<std::size_t>(id)];
  return pack.maps[0].levels[static_cast<std::size_t>(level)].texel(static_cast<int>(cell.column * width + i),
                                                                    static_cast<int>(cell.row * height + j));
}

Image rendered(const Pack& pack, const View& view, RenderTarget target = {}) {
  const Renderer renderer(pack, 0, view, target);
  return renderer.rows(0, renderer.size().height);
}

} // namespace

TEST_CASE("the virtual texture is its tiles side by side") {
  const Pack pack = small_pack();
  for (const int level : {0, 1, 3}) {
    const VirtualRect rect{-11, 5, 37, 29};
    const Image window = virtual_texture(pack, 0, level, rect);
    for (int y = 0; y < rect.height; ++y)
      for (int x = 0; x < rect.width; ++x) {
        const auto wanted = stored_texel(pack, level, rect.x + x, rect.y + y);
        const auto got = window.texel(x, y);
        REQUIRE(std::equal(wanted.begin(), wanted.end(), got.begin(), got.end()));
      }
  }
}

TEST_CASE("the virtual texture repeats after its size") {
  const Pack pack = small_pack();
  const Image window = virtual_texture(pack, 0, 0, {-3, -3, 20, 20});
  CHECK(window == virtual_texture(pack, 0, 0, {-3 + 48, -3 - 40, 20, 20}));
  CHECK(window == virtual_texture(pack, 0, 0, {-3 - 48 * (std::int64_t{1} << 40), -3, 20, 20}));
}

TEST_CASE("a window the pack doesn't hold is an error") {
  const Pack pack = small_pack();
  CHECK_THROWS_AS(virtual_texture(pack, 1, 0, {0, 0, 1, 1}), Error);
  CHECK_THROWS_AS(virtual_texture(pack, 0, 4, {0, 0, 1, 1}), Error);
  CHECK_THROWS_AS(virtual_texture(pack, 0, -1, {0, 0, 1, 1}), Error);
  CHECK_THROWS_AS(virtual_texture(pack, 0, 0, {0, 0, 0, 1}), Error);
}

TEST_CASE("at scale 1 every filter renders the texels themselves") {
  const Pack pack = small_pack();
  for (const Filter filter : {Filter::nearest, Filter::bilinear, Filter::trilinear})
    CHECK(rendered(pack, {{-5, 9, 40, 21}, 1, 1.0, filter}) == virtual_texture(pack, 0, 1, {-5, 9, 40, 21}));
}

TEST_CASE("pixels are those of the reference sampler") {
  const Pack pack = small_pack();
  const ReferenceSampler sampler(pack, 0);
  for (const Filter filter : {Filter::nearest, Filter::bilinear, Filter::trilinear})
    for (const double scale : {0.3, 0.5, 1.7, 3.0}) {
      const View view{{-13, 22, 30, 25}, 0, scale, filter};
      const RenderTarget target{Encoding::linear, Depth::f32};
      const Image image = rendered(pack, view, target);
      const double level = filter == Filter::trilinear ? -exact_log2(scale) : 0.0;
      REQUIRE(image.size() == output_size(view));
      for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x) {
          std::array<double, 3> wanted{};
          sampler.sample(from_texels(-13 + (x + 0.5) / scale, 8), from_texels(22 + (y + 0.5) / scale, 8),
                         level, filter, wanted);
          for (std::size_t c = 0; c < 3; ++c)
            REQUIRE(static_cast<double>(image.texel(x, y)[c]) == Approx(wanted[c]).margin(1e-6));
        }
    }
}

TEST_CASE("scaled pixels are encoded and rounded as the target says") {
  const Pack pack = small_pack();
  const View view{{3, 4, 20, 20}, 0, 1.5, Filter::bilinear};
  const Image linear = rendered(pack, view, {Encoding::linear, Depth::f32});
  const Image encoded = rendered(pack, view, {Encoding::srgb, Depth::u8});
  const Image wanted = quantised(from_linear(linear, Encoding::srgb), Depth::u8);
  for (std::size_t i = 0; i < wanted.data().size(); ++i)
    REQUIRE(encoded.data()[i] == Approx(wanted.data()[i]).margin(1.01 / 255));
}

TEST_CASE("bands and threads change nothing") {
  const Pack pack = small_pack();
  for (const double scale : {1.0, 0.75}) {
    const View view{{-100, 33, 90, 70}, 0, scale, Filter::trilinear};
    const Image whole = rendered(pack, view);
    const Renderer renderer(pack, 0, view, {});
    for (const int threads : {1, 4}) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                      static_cast<std::size_t>(threads));
      for (int row = 0; row < whole.height(); row += 13) {
        const int count = std::min(13, whole.height() - row);
        REQUIRE(renderer.rows(row, count) == crop(whole, {0, row, whole.width(), count}));
      }
    }
  }
}

TEST_CASE("filtered normals are renormalised") {
  SmallPack wanted;
  wanted.role = Role::normal;
  wanted.encoding = Encoding::linear;
  const Image image = rendered(small_pack(wanted), {{0, 0, 20, 20}, 0, 0.5, Filter::trilinear},
                               {Encoding::linear, Depth::f32});
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      double square = 0;
      for (const float v : image.texel(x, y)) square += (2.0 * v - 1) * (2.0 * v - 1);
      REQUIRE(square == Approx(1.0).margin(1e-5));
    }
}

TEST_CASE("the picture's size is the window's times the scale, within limits") {
  CHECK(output_size({{0, 0, 100, 50}, 0, 0.25, Filter::nearest}) == Size{25, 13});
  CHECK(output_size({{0, 0, 3, 5}, 0, 0.01, Filter::nearest}) == Size{1, 1});
  CHECK_THROWS_AS(output_size({{0, 0, 0, 5}, 0, 1, Filter::nearest}), Error);
  CHECK_THROWS_AS(output_size({{0, 0, 70000, 5}, 0, 1, Filter::nearest}), Error);
  for (const double scale :
       {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e300})
    CHECK_THROWS_AS(output_size({{0, 0, 5, 5}, 0, scale, Filter::nearest}), Error);
}

TEST_CASE("a view of a map or level that isn't there is an error") {
  const Pack pack = small_pack();
  CHECK_THROWS_AS(Renderer(pack, 1, {{0, 0, 5, 5}}, {}), Error);
  CHECK_THROWS_AS(Renderer(pack, 0, {{0, 0, 5, 5}, 4}, {}), Error);
  CHECK_THROWS_AS(Renderer(pack, 0, {{0, 0, 5, 5}, -1}, {}), Error);
}
