#include "tilepack/exemplar/sample_wrap.h"
#include "tilepack/image/image_file.h"
#include "tilepack/numeric/random.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

using namespace tilepack;

namespace {

// Bumps at random places, on a torus or not.
SampleMap bumps(int width, int height, bool wraps_x, bool wraps_y) {
  SampleMap map;
  map.image = Image(width, height, 1);
  const auto random = [](int i, const char* what, int most) {
    return static_cast<int>(
        random_below(3, what, static_cast<std::uint64_t>(i), static_cast<std::uint32_t>(most)));
  };
  for (int i = 0; i < width * height / 20; ++i) {
    const int cx = random(i, "x", width), cy = random(i, "y", height);
    const float sign = i % 2 == 0 ? 0.1f : -0.1f;
    for (int y = cy - 6; y <= cy + 6; ++y)
      for (int x = cx - 6; x <= cx + 6; ++x) {
        const auto inside = [](int& at, int side, bool wraps) {
          if (wraps) at = (at + side) % side;
          return at >= 0 && at < side;
        };
        int at_x = x, at_y = y;
        if (!inside(at_x, width, wraps_x) || !inside(at_y, height, wraps_y)) continue;
        const float d = static_cast<float>((x - cx) * (x - cx) + (y - cy) * (y - cy)) / 36.0f;
        if (d < 1) map.image.texel(at_x, at_y)[0] += sign * (1 - d);
      }
  }
  for (float& v : map.image.data()) v = std::clamp(0.5f + v, 0.0f, 1.0f);
  return map;
}

SampleWrap found_of(const SampleMap& map) {
  const std::vector<SampleMap> maps{map};
  return detect_wrap(feature_image(maps), {});
}

} // namespace

TEST_CASE("a sample that was made to repeat is told from one that was cut out, along each axis") {
  CHECK(found_of(bumps(192, 160, true, true)) == SampleWrap{true, true});
  CHECK(found_of(bumps(192, 160, true, false)) == SampleWrap{true, false});
  CHECK(found_of(bumps(192, 160, false, true)) == SampleWrap{false, true});
  CHECK(found_of(bumps(192, 160, false, false)) == SampleWrap{});
}

namespace {

// A field on a torus of `period` texels a side, looked at over `size` texels a side from within the first of the cells
// that it is made of: their own borders are no places like others.
using Field = double (*)(int x, int y, int period, int seed);

SampleMap shown(Field field, int period, int size, int seed) {
  constexpr int from = 20;
  SampleMap map;
  map.image = Image(size, size, 1);
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x)
      map.image.texel(x, y)[0] =
          static_cast<float>(std::clamp(field(x + from, y + from, period, seed), 0.0, 1.0));
  return map;
}

double chance(int seed, const char* what, int i, int j) {
  return random_below(static_cast<std::uint64_t>(seed), what,
                      static_cast<std::uint64_t>(i) * 4096 + static_cast<std::uint64_t>(j), 1 << 20) /
         static_cast<double>(1 << 20);
}

// Smooth noise, a value every `cell` texels.
double value_noise(int x, int y, int period, int cell, int seed) {
  const int count = period / cell;
  const auto value = [&](int i, int j) { return chance(seed + cell, "value", i % count, j % count); };
  const auto eased = [](double t) { return t * t * (3 - 2 * t); };
  const int i = x / cell, j = y / cell;
  const double tx = eased((x % cell + 0.5) / cell), ty = eased((y % cell + 0.5) / cell);
  return std::lerp(std::lerp(value(i, j), value(i + 1, j), tx),
                   std::lerp(value(i, j + 1), value(i + 1, j + 1), tx), ty);
}

double slow(int x, int y, int period, int seed) {
  return value_noise(x, y, period, 24, seed);
}
double fine(int x, int y, int period, int seed) {
  return value_noise(x, y, period, 4, seed);
}
double rough(int x, int y, int period, int seed) {
  return 0.5 * value_noise(x, y, period, 48, seed) + 0.25 * value_noise(x, y, period, 12, seed) +
         0.25 * value_noise(x, y, period, 3, seed);
}

// The nearest of one point a cell, and how much farther the next one lies.
double cells(int x, int y, int period, int seed, int side, bool lines) {
  const int count = period / side;
  double nearest = 1e9, second = 1e9, tone = 0;
  for (int j = y / side - 2; j <= y / side + 2; ++j)
    for (int i = x / side - 2; i <= x / side + 2; ++i) {
      const int ci = (i + 4 * count) % count, cj = (j + 4 * count) % count;
      const double dx = (i + chance(seed, "x", ci, cj)) * side - x,
                   dy = (j + chance(seed, "y", ci, cj)) * side - y;
      const double d = std::hypot(dx, dy);
      if (d < nearest) {
        second = nearest;
        nearest = d;
        tone = chance(seed, "tone", ci, cj);
      } else {
        second = std::min(second, d);
      }
    }
  return lines && second - nearest < 2
             ? 0.0
             : 0.2 + 0.7 * tone + 0.05 * chance(seed, "grain", x % period, y % period);
}

double plates(int x, int y, int period, int seed) {
  return cells(x, y, period, seed, 48, true);
}
double stones(int x, int y, int period, int seed) {
  return cells(x, y, period, seed, 24, false);
}
double crumbs(int x, int y, int period, int seed) {
  return cells(x, y, period, seed, 8, false);
}

} // namespace

TEST_CASE("fields on a torus are found to repeat, and cut through they are not") {
  struct Kind {
    const char* name;
    Field field;
  };
  int axes_found = 0, axes = 0;
  for (const Kind& kind : {Kind{"slow", slow}, Kind{"fine", fine}, Kind{"rough", rough},
                           Kind{"plates", plates}, Kind{"stones", stones}, Kind{"crumbs", crumbs}})
    for (const int seed : {1, 2, 3}) {
      CAPTURE(kind.name, seed);
      const SampleWrap whole = found_of(shown(kind.field, 192, 192, seed));
      axes += 2;
      axes_found += (whole.x ? 1 : 0) + (whole.y ? 1 : 0);
      CHECK(found_of(shown(kind.field, 288, 192, seed)) == SampleWrap{});
    }
  CHECK(axes_found >= axes - 1); // a line may lie along a border
}

TEST_CASE("no photo is taken for a sample that repeats") {
  const std::filesystem::path textures = std::filesystem::path(TILEPACK_SOURCE_DIR) / "../shared/textures";
  if (!std::filesystem::is_directory(textures)) {
    WARN("not tested: " << textures.string() << " is not there");
    return;
  }
  for (const char* name :
       {"asphalt", "bark_albedo", "brick", "clouds", "cracked", "crackedasphalt", "grass", "gravel", "leaves",
        "moss", "pebbles", "planks", "sand", "stonewall", "tiles", "water", "wood", "wool"}) {
    CAPTURE(name);
    SampleMap photo;
    photo.image = read_image((textures / (std::string(name) + ".png")).string()).image;
    CHECK(found_of(photo) == SampleWrap{});
  }
}

TEST_CASE("a pattern may end at its lines") {
  SampleMap squares;
  squares.image = Image(300, 300, 1);
  for (int y = 0; y < 300; ++y)
    for (int x = 0; x < 300; ++x) squares.image.texel(x, y)[0] = static_cast<float>((x / 25 + y / 25) % 2);
  const std::vector<SampleMap> maps{squares};
  const FeatureImage image = feature_image(maps);
  CHECK(detect_wrap(image, detect_periods(maps)) == SampleWrap{true, true});
  CHECK(detect_wrap(image, {}) == SampleWrap{}); // its border is a line, where few texels lie at one
}

TEST_CASE("maps go on by themselves") {
  SampleMap map;
  map.image = Image(3, 2, 1);
  for (int i = 0; i < 6; ++i) map.image.data()[static_cast<std::size_t>(i)] = static_cast<float>(i);
  const std::vector<SampleMap> maps{map};
  const std::vector<SampleMap> longer = continued(maps, {8, 3});
  REQUIRE(longer.size() == 1);
  CHECK(longer[0].image.size() == Size{8, 3});
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 8; ++x)
      CHECK(longer[0].image.texel(x, y)[0] == static_cast<float>(y % 2 * 3 + x % 3));
}
