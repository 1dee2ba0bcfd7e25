#include "support/samples.h"

#include "tilepack/exemplar/tone_choice.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <functional>

using namespace tilepack;
using namespace tilepack::testing;

namespace {

SampleMap grey(const std::function<double(int x, int y)>& value) {
  Image image(256, 256, 3);
  for (int y = 0; y < 256; ++y)
    for (int x = 0; x < 256; ++x)
      for (float& v : image.texel(x, y)) v = quantised(static_cast<float>(value(x, y)), Depth::u8);
  return {"color", Role::color, Encoding::srgb, Depth::u8, std::move(image)};
}

double grain(int x, int y) {
  return 0.01 * ((x * 31 + y * 17) % 11);
}

// Without order, 0..1.
double noise(int x, int y) {
  const std::uint32_t mixed =
      (static_cast<std::uint32_t>(x) * 73856093u ^ static_cast<std::uint32_t>(y) * 19349663u) * 2654435761u;
  return static_cast<double>((mixed ^ mixed >> 15) * 2246822519u >> 24) / 255.0;
}

ToneChoice choice_for(const SampleMap& map, Size tile) {
  const std::vector<SampleMap> maps{map};
  return tone_choice(maps, detect_periods(maps), tile);
}

// Boards of 32 texels and of many tones, with grooves that are a texel or two off even places.
double boards(int x, int y) {
  const int at = (y + x / 200) % 32;
  if (at < 3) return 0.05 + grain(x, y);
  return 0.35 + 0.04 * ((y / 32 * 5) % 7) + grain(x, y);
}

} // namespace

TEST_CASE("boards are made alike, where tiles hold whole ones", "[tone_choice]") {
  const ToneChoice choice = choice_for(grey(boards), {64, 64});
  CHECK(choice.flatten == 100);
  REQUIRE(choice.courses);
  CHECK(choice.courses->axis == CourseAxis::y);
  CHECK(choice.courses->period == Approx(32).margin(0.5));
  CHECK(std::abs(std::remainder(choice.courses->joint - 1.5, 32.0)) < 3);
  CHECK(choice_for(grey(boards), {64, 80}).flatten == 0);

  const SampleMap turned = grey([](int x, int y) { return boards(y, x); });
  const ToneChoice other = choice_for(turned, {64, 64});
  REQUIRE(other.courses);
  CHECK(other.courses->axis == CourseAxis::x);
}

TEST_CASE("wood is flattened, and what has no lines is left alone", "[tone_choice]") {
  const auto wood = [](int x, int y) { return 0.3 + 0.08 * std::sin(y * 0.02) + 0.3 * noise(x, y); };
  const ToneChoice choice = choice_for(grey(wood), {64, 64});
  CHECK(choice.flatten == 100);
  CHECK_FALSE(choice.courses);
  CHECK(choice_for(color_map(blobs(256, 256)), {64, 64}).flatten == 0);
  SampleMap height = grey(wood);
  height.role = Role::height;
  CHECK(choice_for(height, {64, 64}).flatten == 0);
}
