#include "support/samples.h"

#include "tilepack/exemplar/flatten.h"
#include "tilepack/exemplar/sample_traits.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <set>

using namespace tilepack;
using tilepack::testing::blobs;
using tilepack::testing::color_map;

namespace {

constexpr Size tile{32, 32};

using Value = std::function<double(int x, int y, int c)>;

Image painted(int width, int height, int channels, const Value& value) {
  Image image(width, height, channels);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < channels; ++c)
        image.texel(x, y)[static_cast<std::size_t>(c)] = static_cast<float>(value(x, y, c));
  return image;
}

SampleMap map_of(Role role, Depth depth, Image image) {
  return {"m", role, Encoding::linear, depth, std::move(image)};
}

struct Spread {
  double mean = 0;
  double deviation = 0; // over the mean
};

// Of one channel, `margin` texels from the border.
Spread spread_of(const Image& image, int channel = 0, int margin = 0) {
  double sum = 0, squares = 0, count = 0;
  for (int y = margin; y < image.height() - margin; ++y)
    for (int x = margin; x < image.width() - margin; ++x) {
      const auto v = static_cast<double>(image.texel(x, y)[static_cast<std::size_t>(channel)]);
      sum += v, squares += v * v, count += 1;
    }
  const double mean = sum / count;
  return {mean, std::sqrt(std::max(0.0, squares / count - mean * mean)) / mean};
}

int mirrored(int i, int count) {
  return i < 0 ? -1 - i : i >= count ? 2 * count - 1 - i : i;
}

// The mean of (2 reach + 1)² texels, sum by sum.
Image box_mean(const Image& image, int reach) {
  return painted(image.width(), image.height(), image.channels(), [&](int x, int y, int c) {
    double sum = 0;
    for (int j = y - reach; j <= y + reach; ++j)
      for (int i = x - reach; i <= x + reach; ++i)
        sum += static_cast<double>(image.texel(mirrored(i, image.width()),
                                               mirrored(j, image.height()))[static_cast<std::size_t>(c)]);
    return sum / ((2 * reach + 1) * (2 * reach + 1));
  });
}

Image local_mean(const Image& image, int reach) {
  return box_mean(box_mean(box_mean(image, reach), reach), reach);
}

double largest_difference(const Image& a, const Image& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.data().size(); ++i)
    largest =
        std::max(largest, std::abs(static_cast<double>(a.data()[i]) - static_cast<double>(b.data()[i])));
  return largest;
}

} // namespace

TEST_CASE("flattening subtracts or divides by a mean round each texel", "[flatten]") {
  // 37 numbers a row are no whole strips, and sides differ.
  const Image noise = blobs(37, 53, 3, 1);
  const Image local = local_mean(noise, 8);
  const double level = spread_of(local).mean;
  const double whole = spread_of(noise).mean;
  const auto over_local = [&](int x, int y, int) {
    return static_cast<double>(noise.texel(x, y)[0]) / static_cast<double>(local.texel(x, y)[0]);
  };
  const double kept = whole / spread_of(painted(37, 53, 1, over_local)).mean;
  for (const double share : {0.25, 1.0}) {
    const Image height = flattened(map_of(Role::height, Depth::f32, noise), share, {32, 40}).image;
    CHECK(largest_difference(height, painted(37, 53, 1, [&](int x, int y, int) {
                               return static_cast<double>(noise.texel(x, y)[0]) +
                                      share * (level - static_cast<double>(local.texel(x, y)[0]));
                             })) < 1e-5);
    const Image color = flattened(map_of(Role::color, Depth::f32, noise), share, {32, 40}).image;
    CHECK(largest_difference(color, painted(37, 53, 1, [&](int x, int y, int) {
                               const double ratio = kept / static_cast<double>(local.texel(x, y)[0]);
                               REQUIRE(ratio < 4);
                               return static_cast<double>(noise.texel(x, y)[0]) * (1 + share * (ratio - 1));
                             })) < 1e-5);
  }
}

TEST_CASE("a tilted plane becomes flat, and its mean stays", "[flatten]") {
  const auto plane = [](int x, int y, int) { return 0.25 + 0.4 * x / 127.0 + 0.1 * y / 127.0; };
  for (const Role role : {Role::color, Role::height}) {
    const SampleMap map = map_of(role, Depth::f32, painted(128, 128, 1, plane));
    const Spread before = spread_of(map.image);
    const Spread after = spread_of(flattened(map, 1, tile).image);
    CHECK(before.deviation > 0.22);
    CHECK(after.deviation < 0.06 * before.deviation);
    CHECK(spread_of(flattened(map, 1, tile).image, 0, 24).deviation < 0.003); // away from the border
    CHECK(after.mean == Approx(before.mean).epsilon(1e-5));
    CHECK(spread_of(flattened(map, 0.5, tile).image).deviation == Approx(before.deviation / 2).epsilon(0.1));
  }
}

TEST_CASE("shading goes and detail stays, in light and not in codes", "[flatten]") {
  const Image detail = blobs(256, 256, 5, 3);
  const auto reflecting = [&](int x, int y, int c) {
    return 0.1 + 0.3 * static_cast<double>(detail.texel(x, y)[static_cast<std::size_t>(c)]);
  };
  // Each channel has its own light: a hue that drifts.
  const auto light = [](int x, int, int c) { return c == 0 ? 1.6 - 1.2 * x / 255.0 : 0.6 + 0.8 * x / 255.0; };
  SampleMap map = color_map(quantised(
      from_linear(
          painted(256, 256, 3, [&](int x, int y, int c) { return reflecting(x, y, c) * light(x, y, c); }),
          Encoding::srgb),
      Depth::u8));
  const SampleMap flat = flattened(map, 1, {64, 64});
  CHECK(quantised(flat.image, Depth::u8) == flat.image);
  CHECK(flat.name == map.name);
  CHECK(flat.encoding == Encoding::srgb);
  const Image seen = to_linear(flat.image, Encoding::srgb);
  const Image given = to_linear(map.image, Encoding::srgb);
  const Image evenly_lit = painted(256, 256, 3, reflecting);
  for (int c = 0; c < 3; ++c) {
    CHECK(spread_of(seen, c).mean == Approx(spread_of(given, c).mean).epsilon(0.002));
    CHECK(spread_of(given, c).deviation > 1.2 * spread_of(evenly_lit, c).deviation);
    CHECK(spread_of(seen, c).deviation == Approx(spread_of(evenly_lit, c).deviation).epsilon(0.04));
  }
  const SampleMap maps[] = {map}, flat_maps[] = {flat};
  CHECK(sample_traits(feature_image(maps), {}, {64, 64}).shading > 0.05);
  CHECK(sample_traits(feature_image(flat_maps), {}, {64, 64}).shading < 0.01);
}

TEST_CASE("how much of a wave is taken out depends on its length over the tile's", "[flatten]") {
  const auto left = [](double length) {
    const auto wave = [&](int x, int, int) {
      return 0.5 + 0.01 * std::cos((x + 0.5) * 6.283185307 / length);
    };
    const Image image = painted(256, 128, 1, wave);
    return spread_of(flattened(map_of(Role::height, Depth::f32, image), 1, {64, 64}).image).deviation /
           spread_of(image).deviation;
  };
  CHECK(left(16) == Approx(1).margin(0.01));
  CHECK(left(32) == Approx(1).margin(0.01));
  CHECK(left(64) == Approx(0.765).margin(0.02));
  CHECK(left(128) == Approx(0.285).margin(0.03));
  CHECK(left(256) == Approx(0.09).margin(0.03));
}

TEST_CASE("what is not light or height, and share 0, stays as it is", "[flatten]") {
  const Image noise = blobs(64, 64, 2, 3);
  for (const Role role : {Role::normal, Role::roughness, Role::data})
    CHECK(flattened(map_of(role, Depth::u8, noise), 1, tile).image == noise);
  for (const Role role : {Role::color, Role::height})
    CHECK(flattened(map_of(role, Depth::u8, noise), 0, tile).image == noise);
  const Image grey(48, 40, 3, 102.0f / 255.0f); // nothing to take out, and no code is lost on the way
  CHECK(flattened(color_map(grey), 1, tile).image == grey);
}

TEST_CASE("alpha weighs what is averaged and stays", "[flatten]") {
  // An even color on a ground that isn't seen, whatever it holds.
  for (const int channels : {2, 4}) {
    const Image image = painted(96, 96, channels, [&](int x, int y, int c) {
      const bool seen = (x / 12 + y / 12) % 2 == 0 || x < 20;
      return c == channels - 1 ? (seen ? 1.0 : 0.0) : seen ? 0.4 : x / 95.0;
    });
    const Image flat = flattened(map_of(Role::color, Depth::f32, image), 1, tile).image;
    for (int y = 0; y < 96; ++y)
      for (int x = 0; x < 96; ++x) {
        REQUIRE(flat.texel(x, y).back() == image.texel(x, y).back());
        if (image.texel(x, y).back() > 0) REQUIRE(flat.texel(x, y)[0] == Approx(0.4f).epsilon(1e-4));
      }
  }
  const Image unseen = painted(64, 64, 4, [](int x, int, int c) { return c == 3 ? 0.0 : x / 63.0; });
  CHECK(flattened(map_of(Role::color, Depth::f32, unseen), 1, tile).image == unseen);
}

TEST_CASE("black, white and a sun stay within bounds", "[flatten]") {
  const Image black(64, 64, 3, 0.0f);
  CHECK(flattened(color_map(black), 1, tile).image == black);
  // Half black, half grey: black stays black, and what is nearly black stays dark.
  const Image halves =
      painted(128, 64, 1, [](int x, int, int) { return x < 64 ? (x == 3 ? 0.001 : 0.0) : 0.5; });
  const Image lit = flattened(map_of(Role::color, Depth::f32, halves), 1, tile).image;
  CHECK(lit.texel(0, 9)[0] == 0.0f);
  CHECK(lit.texel(3, 9)[0] < 0.008f); // the level is twice the mean: the grey half stays as bright
  CHECK(lit.texel(120, 9)[0] == Approx(0.5).epsilon(0.1));
  // Integers end at 1.
  const Image spots = painted(128, 64, 1, [](int x, int y, int) {
    return x > 90 ? 0.9 : (x + y) % 9 == 0 ? 1.0 : 0.05;
  });
  for (const Depth depth : {Depth::u8, Depth::u16}) {
    const Image flat = flattened(map_of(Role::color, depth, spots), 1, tile).image;
    CHECK(*std::max_element(flat.data().begin(), flat.data().end()) == 1.0f);
    const Image low = flattened(map_of(Role::height, depth, spots), 1, tile).image;
    CHECK(*std::min_element(low.data().begin(), low.data().end()) == 0.0f);
  }
  // A sun in a dark sky, up to the largest values that a bake takes.
  for (const float sun : {60000.0f, 1e30f})
    for (const Role role : {Role::color, Role::height}) {
      const Depth depth = sun > 65504.0f ? Depth::f32 : Depth::f16;
      const Image sky = painted(96, 96, 3, [&](int x, int y, int) {
        return x == 70 && y == 20 ? static_cast<double>(sun) : x < 40 ? 60000.0 : -0.01;
      });
      const Image flat = flattened(map_of(role, depth, sky), 1, tile).image;
      CHECK(std::all_of(flat.data().begin(), flat.data().end(), [](float v) { return std::isfinite(v); }));
    }
  const Image tall = painted(96, 96, 1, [](int x, int, int) { return x < 48 ? 65504.0 : -65504.0; });
  const Image held = flattened(map_of(Role::height, Depth::f16, tall), 1, tile).image;
  CHECK(std::all_of(held.data().begin(), held.data().end(), [](float v) { return std::abs(v) <= 65504.0f; }));
  // A finer depth than the sample's keeps what rounding to its own would take.
  const auto distinct = [](const Image& image) {
    return std::set<float>(image.data().begin(), image.data().end()).size();
  };
  const SampleMap coarse = map_of(Role::height, Depth::u8, spots);
  const SampleMap fine = flattened(coarse, 1, tile, Depth::u16);
  CHECK(fine.depth == Depth::u16);
  CHECK(distinct(fine.image) > 1000);
  CHECK(distinct(flattened(coarse, 1, tile).image) <= 256);
  CHECK(quantised(fine.image, Depth::u8) == flattened(coarse, 1, tile).image);
  const Image tiny(4, 5, 3, 0.5f); // a tile may be larger than the image
  CHECK(flattened(color_map(quantised(tiny, Depth::u8)), 1, {64, 64}).image == quantised(tiny, Depth::u8));
}

TEST_CASE("threads do not change what is flattened", "[flatten]") {
  const SampleMap map = color_map(blobs(200, 120, 7, 4));
  const Image many = flattened(map, 0.7, tile).image;
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  CHECK(flattened(map, 0.7, tile).image == many);
}

TEST_CASE("courses are made alike in tone, each by itself, and joints stay", "[flatten]") {
  // Boards of 16 texels, the last cut off, each of a tone of its own that drifts along it; a dark joint of 2 texels.
  const int period = 16;
  const Image boards = painted(96, 88, 3, [&](int x, int y, int c) {
    const double tone = 0.3 + 0.08 * ((y / period * 7) % 5) + 0.05 * c + 0.001 * x;
    return (y % period < 2 ? 0.1 : 1.0) * tone * ((x * 5 + y * 3) % 7 == 0 ? 0.9 : 1.0);
  });
  const SampleMap flat = flattened(map_of(Role::color, Depth::f32, boards), 1.0, {96, 32}, {},
                                   EvenCourses{CourseAxis::y, period, 0.0});
  const auto mean_of = [](const Image& image, int from, int to, int x0, int x1) {
    double sum = 0;
    for (int y = from; y < to; ++y)
      for (int x = x0; x < x1; ++x) sum += static_cast<double>(image.texel(x, y)[0]);
    return sum / ((to - from) * (x1 - x0));
  };
  const double before = mean_of(boards, 4, 14, 24, 72), after = mean_of(flat.image, 4, 14, 24, 72);
  CHECK(std::abs(mean_of(boards, 20, 30, 24, 72) / before - 1) > 0.2);
  for (int board = 1; board < 5; ++board)
    CHECK(mean_of(flat.image, board * period + 4, board * period + 14, 24, 72) ==
          Approx(after).epsilon(0.02));
  CHECK(mean_of(flat.image, 82, 88, 24, 72) == Approx(after).epsilon(0.03)); // what is left of the last
  CHECK(mean_of(flat.image, 16, 18, 24, 72) == Approx(0.1 * after).epsilon(0.2));
  CHECK(spread_of(flat.image).mean == Approx(spread_of(boards).mean).epsilon(0.01));

  // The same along the other axis.
  const auto turned = [](const Image& image) {
    return painted(image.height(), image.width(), 3, [&](int x, int y, int c) {
      return static_cast<double>(image.texel(y, x)[static_cast<std::size_t>(c)]);
    });
  };
  const SampleMap other = flattened(map_of(Role::color, Depth::f32, turned(boards)), 1.0, {32, 96}, {},
                                    EvenCourses{CourseAxis::x, period, 0.0});
  CHECK(largest_difference(turned(other.image), flat.image) < 1e-5);
}
