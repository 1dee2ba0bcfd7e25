#include "support/images.h"

#include "tilepack/image/encoding.h"
#include "tilepack/mip/far_levels.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace tilepack;

namespace {

Layout grid(int columns, int rows, LayoutKind kind = LayoutKind::tile_index) {
  Layout layout;
  layout.kind = kind;
  layout.columns = columns;
  layout.rows = rows;
  return layout;
}

TileMap map_of(Role role, Encoding encoding, int channels) {
  return {{"map", role, encoding, Depth::f32}, {Image(1, 1, channels)}};
}

// The mean of rows first..first+rows of an image whose values may be averaged as they are.
double mean(const Image& image, std::size_t channel, int first, int rows) {
  double sum = 0;
  for (int y = first; y < first + rows; ++y)
    for (int x = 0; x < image.width(); ++x) sum += static_cast<double>(image.texel(x, y)[channel]);
  return sum / (image.width() * rows);
}

} // namespace

TEST_CASE("far levels halve the texture, rounded down, to one texel") {
  CHECK(far_level_sizes(grid(4, 4), {128, 128}, 8) == std::vector<Size>{{2, 2}, {1, 1}});
  CHECK(far_level_sizes(grid(9, 4), {96, 64}, 6) == std::vector<Size>{{13, 4}, {6, 2}, {3, 1}, {1, 1}});
  CHECK(far_level_sizes(grid(1, 1), {16, 16}, 5).empty());
  // Layers stay apart, one below the other.
  CHECK(far_level_sizes(grid(1, 16, LayoutKind::array), {8, 2}, 2) == std::vector<Size>{{2, 16}, {1, 16}});
  CHECK(far_level_sizes(grid(1, 16, LayoutKind::array), {8, 8}, 4).empty());
}

TEST_CASE("the last far level is the mean, whatever the sides") {
  for (const Size size : {Size{8, 8}, Size{27, 8}, Size{13, 7}}) {
    const Image last = test::noise(size.width, size.height, 3, 5, Depth::f32);
    const TileMap map = map_of(Role::data, Encoding::linear, 3);
    const std::vector<Size> sizes = far_level_sizes(grid(1, 1), size, 1);
    const std::vector<Image> levels = far_levels({last, map}, 1, sizes);
    REQUIRE(levels.size() == sizes.size());
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      CHECK(levels[i].size() == sizes[i]);
      for (std::size_t c = 0; c < 3; ++c) // of each level too
        CHECK(mean(levels[i], c, 0, sizes[i].height) == Approx(mean(last, c, 0, size.height)).margin(1e-6));
    }
  }
}

TEST_CASE("texels of a far level cover what lies under them, by area") {
  const Image last(Size{3, 1}, 1, {0.0f, 0.3f, 0.9f});
  const std::vector<Image> levels =
      far_levels({last, map_of(Role::height, Encoding::linear, 1)}, 1, {{2, 1}, {1, 1}});
  CHECK(levels[0].texel(0, 0)[0] == Approx(0.1)); // one and a half of three
  CHECK(levels[0].texel(1, 0)[0] == Approx(0.7));
  CHECK(levels[1].texel(0, 0)[0] == Approx(0.4));
}

TEST_CASE("layers of an array keep their own mean") {
  const Image last = test::noise(2, 3 * 4, 2, 8, Depth::f32);
  const std::vector<Image> levels = far_levels({last, map_of(Role::data, Encoding::linear, 2)}, 4,
                                               far_level_sizes(grid(1, 4, LayoutKind::array), {2, 3}, 1));
  REQUIRE(levels.size() == 1);
  for (int layer = 0; layer < 4; ++layer)
    CHECK(levels[0].texel(0, layer)[1] == Approx(mean(last, 1, 3 * layer, 3)).margin(1e-6));
}

TEST_CASE("light is averaged as light, colors by alpha, normals as vectors") {
  const Image codes(Size{2, 1}, 1, {0.0f, 1.0f});
  CHECK(far_levels({codes, map_of(Role::color, Encoding::srgb, 1)}, 1, {{1, 1}})[0].texel(0, 0)[0] ==
        Approx(linear_to_srgb(0.5)));
  const Image clear(Size{2, 1}, 2, {0.2f, 1.0f, 0.9f, 0.0f});
  const Image shown = far_levels({clear, map_of(Role::color, Encoding::linear, 2)}, 1, {{1, 1}})[0];
  CHECK(shown.texel(0, 0)[0] == Approx(0.2));
  CHECK(shown.texel(0, 0)[1] == Approx(0.5));
  // Left and right up make up; and that spread makes a mirror rough.
  const float s = 0.8f * 0.5f;
  const Image tilted(Size{2, 1}, 3, {0.5f - s, 0.5f, 0.8f, 0.5f + s, 0.5f, 0.8f});
  const TileMap normals = map_of(Role::normal, Encoding::linear, 3);
  const Image up = far_levels({tilted, normals}, 1, {{1, 1}})[0];
  CHECK(up.texel(0, 0)[0] == Approx(0.5));
  CHECK(up.texel(0, 0)[2] == Approx(1.0));
  const Image mirror(2, 1, 1, 0.0f);
  const TileMap roughness = map_of(Role::roughness, Encoding::linear, 1);
  const PlacedLevel of_normals{tilted, normals};
  CHECK(far_levels({mirror, roughness}, 1, {{1, 1}})[0].texel(0, 0)[0] == 0.0f);
  // |mean| = 0.6: variance 2 * 0.4 / 0.6, beyond all roughness there is.
  CHECK(far_levels({mirror, roughness}, 1, {{1, 1}}, &of_normals)[0].texel(0, 0)[0] == 1.0f);
}
