#include "tilepack/bake/material_normals.h"
#include "tilepack/bake/material_values.h"
#include "tilepack/error/error.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>

using namespace tilepack;
using Catch::Matchers::Contains;

namespace {

constexpr int side = 48;

double bumps(double x, double y) {
  return 1.5 * std::sin(x * 0.4) * std::cos(y * 0.3) + 0.7 * std::sin(x * 0.23 + y * 0.31);
}

Image heights(const std::function<double(double)>& value = [](double h) { return h * 0.1 + 0.5; }) {
  Image image(side, side, 1);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) image.texel(x, y)[0] = static_cast<float>(value(bumps(x, y)));
  return image;
}

// Unit normals of the bumps, x y z, of -1 to 1, green up.
std::array<double, 3> normal_at(int x, int y) {
  const double east = (bumps(x + 0.5, y) - bumps(x - 0.5, y)),
               south = (bumps(x, y + 0.5) - bumps(x, y - 0.5));
  const double length = std::sqrt(east * east + south * south + 1);
  return {-east / length, south / length, 1 / length};
}

SampleMap normals(int channels, NormalY y_points = NormalY::up, Depth depth = Depth::u8,
                  bool signed_ones = false) {
  Image image(side, side, channels, 1.0f);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      auto n = normal_at(x, y);
      if (y_points == NormalY::down) n[1] = -n[1];
      for (std::size_t c = 0; c < static_cast<std::size_t>(std::min(3, channels)); ++c)
        image.texel(x, y)[c] = static_cast<float>(signed_ones ? n[c] : n[c] * 0.5 + 0.5);
    }
  return {"normal", Role::normal, Encoding::linear, depth, quantised(image, depth), "n.png"};
}

SampleMap height_map(Image image, Depth depth) {
  return {"height", Role::height, Encoding::linear, depth, std::move(image), "h.exr"};
}

MaterialOptions turned(NormalY y) {
  return {y, {}, false};
}
MaterialOptions ranged(ValueRange range) {
  return {{}, range, false};
}
MaterialOptions fitted() {
  return {{}, {}, true};
}

std::string said(const std::vector<std::string>& notes) {
  std::string text;
  for (const std::string& note : notes) text += note + "\n";
  return text;
}

// How far the vectors of a map are from those of the bumps, at most.
double largest_error(const SampleMap& map, NormalY y_points = NormalY::up) {
  double largest = 0;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      auto n = normal_at(x, y);
      if (y_points == NormalY::down) n[1] = -n[1];
      for (std::size_t c = 0; c < 3; ++c)
        largest =
            std::max(largest, std::fabs(2.0 * static_cast<double>(map.image.texel(x, y)[c]) - 1 - n[c]));
    }
  return largest;
}

} // namespace

TEST_CASE("normals of two channels get their third") {
  SampleMap map = normals(2);
  CHECK_THAT(said(complete_normals(map)), Contains("z is worked out"));
  CHECK(map.image.channels() == 3);
  CHECK(largest_error(map) < 0.02); // 8 bits
}

TEST_CASE("a blue channel that holds nothing is filled") {
  for (const float blue : {0.0f, 1.0f}) {
    SampleMap map = normals(3);
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) map.image.texel(x, y)[2] = blue;
    CHECK_THAT(said(complete_normals(map)), Contains("nothing in blue"));
    CHECK(largest_error(map) < 0.02);
  }
  SampleMap flat{"normal", Role::normal, Encoding::linear, Depth::u8, Image(4, 4, 3, 1.0f)};
  CHECK(complete_normals(flat).empty()); // nothing varies: a flat map, perhaps
}

TEST_CASE("normals in green and alpha are put in their places") {
  SampleMap map = normals(3);
  Image swizzled(side, side, 4, 1.0f);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      swizzled.texel(x, y)[1] = map.image.texel(x, y)[1];
      swizzled.texel(x, y)[3] = map.image.texel(x, y)[0];
    }
  map.image = swizzled;
  CHECK_THAT(said(complete_normals(map)), Contains("DXT5nm"));
  CHECK(map.image.channels() == 3);
  CHECK(largest_error(map) < 0.02);
}

TEST_CASE("normals of -1 to 1 are decoded, others refused") {
  SampleMap map = normals(3, NormalY::up, Depth::f32, true);
  CHECK_THAT(said(complete_normals(map)), Contains("-1 to 1"));
  CHECK(largest_error(map) < 1e-6);
  SampleMap two = normals(2, NormalY::up, Depth::f16, true);
  complete_normals(two);
  CHECK(largest_error(two) < 0.002);
  // Everything leans north-east: no component is negative.
  SampleMap slope{"normal", Role::normal, Encoding::linear, Depth::f32, Image(4, 4, 3)};
  for (int i = 0; i < 16; ++i) {
    const auto n = slope.image.texel(i % 4, i / 4);
    n[0] = i % 2 == 0 ? 0.6f : 0.0f;
    n[1] = i % 2 == 0 ? 0.0f : 0.6f;
    n[2] = 0.8f;
  }
  CHECK_FALSE(complete_normals(slope).empty());
  CHECK(slope.image.texel(0, 0)[0] == Approx(0.8f));
  SampleMap far = normals(3, NormalY::up, Depth::f32);
  far.image.texel(5, 7)[1] = 7.5f;
  CHECK_THROWS_WITH(complete_normals(far), Contains("7.5") && Contains("(5, 7)"));
  SampleMap plain = normals(3, NormalY::up, Depth::f32);
  CHECK(complete_normals(plain).empty());
}

TEST_CASE("which way green points is found with heights and without") {
  for (const NormalY y : {NormalY::up, NormalY::down}) {
    const SampleMap map = normals(3, y);
    const Image height = heights(), depth = heights([](double h) { return 0.5 - h * 0.1; });
    REQUIRE(green_evidence(map.image, &height));
    CHECK(green_evidence(map.image, &height)->y == y);
    CHECK(green_evidence(map.image, &height)->from_heights);
    CHECK(green_evidence(map.image, &depth)->y == y); // black is high
    CHECK(green_evidence(map.image, nullptr)->y == y);
    CHECK_FALSE(green_evidence(map.image, nullptr)->from_heights);
  }
  CHECK_FALSE(green_evidence(Image(8, 8, 3, 0.5f), nullptr));
}

TEST_CASE("green is turned where that is asked for, and what it is is kept") {
  std::vector<SampleMap> maps{normals(3, NormalY::down), height_map(heights(), Depth::u8)};
  CHECK_THAT(said(prepare_maps(maps, {})), Contains("down, as in DirectX") && Contains("height map"));
  CHECK(maps[0].normal_y == NormalY::down);
  CHECK(largest_error(maps[0], NormalY::down) < 0.01);
  CHECK_THAT(said(prepare_maps(maps, turned(NormalY::up))), Contains("turned up"));
  CHECK(maps[0].normal_y == NormalY::up);
  CHECK(largest_error(maps[0]) < 0.01);
  CHECK(prepare_maps(maps, turned(NormalY::up)).empty());

  // A name goes before slopes, which are told.
  std::vector<SampleMap> named{normals(3, NormalY::down)};
  named[0].normal_y = NormalY::up;
  CHECK_THAT(said(prepare_maps(named, {})), Contains("by its name"));
  CHECK(named[0].normal_y == NormalY::up);

  // Nothing tells.
  std::vector<SampleMap> flat{{"normal", Role::normal, Encoding::linear, Depth::u8, Image(8, 8, 3, 0.5f)}};
  for (int i = 0; i < 64; ++i) flat[0].image.texel(i % 8, i / 8)[2] = 1.0f;
  CHECK(prepare_maps(flat, {}).empty());
  CHECK_FALSE(flat[0].normal_y);
  CHECK_THAT(said(prepare_maps(flat, turned(NormalY::down))), Contains("doesn't tell"));
  CHECK(flat[0].normal_y == NormalY::down);
}

TEST_CASE("normals that lean and lengths that are off are told") {
  CHECK(doubts_about_normals(normals(3).image).empty());
  Image leaning = normals(3).image, short_ones = normals(3).image;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      leaning.texel(x, y)[0] += 0.05f;
      for (float& v : short_ones.texel(x, y)) v = 0.5f + (v - 0.5f) * 0.6f;
    }
  CHECK_THAT(said(doubts_about_normals(leaning)), Contains("lean by") && Contains("red +0.1"));
  CHECK_THAT(said(doubts_about_normals(short_ones)), Contains("length 0.6"));
  CHECK_THAT(said(doubts_about_normals(Image(4, 4, 3, 0.9f))), Contains("point"));
}

TEST_CASE("a range of heights is brought to 0..1 and kept, so that metres come back") {
  const auto metres = [](double h) { return 100 + 5 * h; };
  std::vector<SampleMap> maps{height_map(heights(metres), Depth::f32)};
  CHECK(prepare_maps(maps, fitted()).empty());
  REQUIRE(maps[0].range);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const double stored = static_cast<double>(maps[0].image.texel(x, y)[0]);
      CHECK(stored >= 0);
      CHECK(stored <= 1);
      CHECK(maps[0].range->low + stored * (maps[0].range->high - maps[0].range->low) ==
            Approx(metres(bumps(x, y))).margin(1e-4));
    }
  std::vector<SampleMap> given{height_map(heights(metres), Depth::f32)};
  prepare_maps(given, ranged(ValueRange{80, 120}));
  CHECK(given[0].range == ValueRange{80, 120});
  CHECK(given[0].image.texel(0, 0)[0] == Approx((metres(bumps(0, 0)) - 80) / 40));
  std::vector<SampleMap> outside{height_map(heights(metres), Depth::f32)};
  CHECK_THROWS_WITH(prepare_maps(outside, ranged(ValueRange{0, 100})),
                    Contains("outside") && Contains("height-range"));
  // Integers fill the range that is given.
  std::vector<SampleMap> codes{height_map(heights(), Depth::u16)};
  const Image before = codes[0].image;
  prepare_maps(codes, ranged(ValueRange{-3, 9}));
  CHECK(codes[0].image == before);
  CHECK(codes[0].range == ValueRange{-3, 9});
  // One height everywhere.
  std::vector<SampleMap> level{height_map(Image(4, 4, 1, 7.0f), Depth::f32)};
  prepare_maps(level, fitted());
  CHECK(level[0].range == ValueRange{7, 8});
  CHECK(level[0].image.texel(1, 1)[0] == 0.0f);
  std::vector<SampleMap> none{normals(3)};
  CHECK_THAT(said(prepare_maps(none, fitted())), Contains("there is none"));
}

TEST_CASE("values that integers can't hold are refused with the way out") {
  const SampleMap metres = height_map(heights([](double h) { return 100 + 5 * h; }), Depth::f32);
  CHECK_THROWS_WITH(check_storable(metres, Depth::u16), Contains("height-range") && Contains("100 %"));
  CHECK_NOTHROW(check_storable(metres, Depth::f16));
  CHECK_NOTHROW(check_storable(height_map(heights(), Depth::f32), Depth::u8));
  SampleMap roughness{"roughness", Role::roughness,      Encoding::linear,
                      Depth::f32,  Image(8, 8, 1, 0.5f), "r.exr"};
  roughness.image.texel(3, 4)[0] = 1.5f;
  CHECK_THROWS_WITH(check_storable(roughness, Depth::u8), Contains("(3, 4)") && Contains("Store floats"));
  // Highlights of light are clipped everywhere, and that is told.
  SampleMap color{"color", Role::color, Encoding::linear, Depth::f16, Image(32, 32, 3, 0.5f), "c.exr"};
  color.image.texel(1, 1)[0] = 3.0f;
  CHECK_THAT(check_storable(color, Depth::u8), Contains("0.098 % of the texels are clipped"));
  CHECK(check_storable(color, Depth::f16).empty());
}

TEST_CASE("alpha beside plain values goes where it says nothing, and is the opacity where nothing else is") {
  const auto map = [](Role role, int channels, float color, bool alpha_varies) {
    Image image(4, 4, channels, color);
    for (int i = 0; i < 16; ++i)
      image.texel(i % 4, i / 4).back() = alpha_varies ? static_cast<float>(i) / 16 : 1.0f;
    return SampleMap{"map", role, Encoding::linear, Depth::f32, image};
  };
  std::vector<SampleMap> maps{map(Role::roughness, 4, 0.5f, false), map(Role::opacity, 4, 0.0f, true),
                              map(Role::height, 2, 30.0f, false), map(Role::data, 4, 0.5f, false),
                              map(Role::ao, 2, 0.5f, true)};
  const std::string notes = said(prepare_maps(maps, ranged(ValueRange{20, 40})));
  CHECK(maps[0].image.channels() == 3);
  CHECK(maps[1].image.channels() == 1);
  CHECK(maps[1].image.texel(3, 1)[0] == 7.0f / 16);
  CHECK(maps[2].image.channels() == 1);
  CHECK(maps[2].image.texel(0, 0)[0] == 0.5f);
  CHECK(maps[3].image.channels() == 4);
  CHECK(maps[4].image.channels() == 2);
  CHECK_THAT(notes, Contains("opacity in alpha") && Contains("weighs nothing"));
}
