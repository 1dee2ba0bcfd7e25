#include "support/images.h"

#include "tilepack/mip/mip_chain.h"
#include "tilepack/mip/shared_border.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>

using namespace tilepack;

namespace {

std::size_t as_size(int i) {
  return static_cast<std::size_t>(i);
}

TileSet edge_set(Size size, int kh, int kv) {
  return {size, {kh, kv, 0}, complete_edge_set(kh, kv), {}, 0};
}

TileSet corner_set(Size size, int k) {
  return {size, {0, 0, k}, complete_corner_set(k), {}, 0};
}

// Every texel of every tile its own random 8-bit value.
TileSet with_noise(TileSet set, int channels, Role role = Role::color, Encoding encoding = Encoding::srgb) {
  TileMap map{"map", role, encoding, Depth::u8, {}};
  for (int id = 0; id < tile_count(set.tiles); ++id) {
    const auto seed = static_cast<std::uint64_t>(id);
    map.tiles.push_back(test::noise(set.tile_size.width, set.tile_size.height, channels, seed));
  }
  set.maps.push_back(map);
  return set;
}

MipOptions with(MipMode mode) {
  MipOptions options;
  options.mode = mode;
  return options;
}

std::vector<float> texel(const TileMap& level, int id, Place place) {
  const auto t = level.tiles[as_size(id)].texel(place.x, place.y);
  return {t.begin(), t.end()};
}

std::size_t changed_texels(const TileMap& a, const TileMap& b) {
  std::size_t changed = 0;
  for (std::size_t id = 0; id < a.tiles.size(); ++id)
    for (int y = 0; y < a.tiles[id].height(); ++y)
      for (int x = 0; x < a.tiles[id].width(); ++x)
        changed += texel(a, static_cast<int>(id), {x, y}) != texel(b, static_cast<int>(id), {x, y});
  return changed;
}

} // namespace

TEST_CASE("levels halve a tile as long as both sides are even") {
  CHECK(level_count({128, 128}) == 8);
  CHECK(level_count({96, 64}) == 6);
  CHECK(level_size({96, 64}, 5) == Size{3, 2});
  CHECK(level_count({12, 4}) == 3);
  CHECK(level_size({12, 4}, 2) == Size{3, 1});
  CHECK(level_count({7, 8}) == 1);
  CHECK(level_count({1, 1}) == 1);
}

TEST_CASE("names of mip modes are those of the options") {
  CHECK(name_of(MipMode::none) == "none");
  CHECK(name_of(MipMode::box) == "box");
  CHECK(name_of(MipMode::edges) == "edges");
  CHECK(name_of(MipMode::corners) == "corners");
  CHECK(name_of(MipMode::least_squares) == "least-squares");
}

TEST_CASE("level 0 is never touched, and mode none has no other") {
  const TileSet set = with_noise(edge_set({8, 8}, 2, 2), 3);
  for (const MipMode mode :
       {MipMode::none, MipMode::box, MipMode::edges, MipMode::corners, MipMode::least_squares})
    CHECK(mip_chain(set, 0, with(mode)).front().tiles == set.maps[0].tiles);
  CHECK(mip_chain(set, 0, with(MipMode::none)).size() == 1);
}

TEST_CASE("a box level is the mean of 2^level squares of linear light, by brute force in doubles") {
  const TileSet set = with_noise(edge_set({16, 16}, 2, 1), 3);
  const auto chain = mip_chain(set, 0, with(MipMode::box));
  REQUIRE(chain.size() == 5);
  for (int level = 1; level < 5; ++level)
    for (int id = 0; id < 4; ++id)
      for (int y = 0; y < 16 >> level; ++y)
        for (int x = 0; x < 16 >> level; ++x)
          for (std::size_t c = 0; c < 3; ++c) {
            double sum = 0;
            for (int j = 0; j < 1 << level; ++j)
              for (int i = 0; i < 1 << level; ++i)
                sum += srgb_to_linear(static_cast<double>(
                    set.maps[0].tiles[as_size(id)].texel((x << level) + i, (y << level) + j)[c]));
            const double expected = linear_to_srgb(sum / (1 << (2 * level)));
            REQUIRE(texel(chain[as_size(level)], id, {x, y})[c] == Approx(expected).margin(1e-6));
          }
}

TEST_CASE("the mean of a linear level is the mean of the finer one") {
  const TileSet set = with_noise(edge_set({32, 8}, 1, 2), 1, Role::height, Encoding::linear);
  const auto chain = mip_chain(set, 0, with(MipMode::box));
  const auto mean = [](const Image& image) {
    double sum = 0;
    for (const float v : image.data()) sum += static_cast<double>(v);
    return sum / static_cast<double>(image.data().size());
  };
  for (std::size_t level = 1; level < chain.size(); ++level)
    for (std::size_t id = 0; id < 4; ++id)
      CHECK(mean(chain[level].tiles[id]) == Approx(mean(set.maps[0].tiles[id])).epsilon(1e-6));
}

TEST_CASE("constant tiles stay constant, exactly once rounded") {
  for (const int code : {0, 1, 77, 128, 254, 255})
    for (const MipMode mode : {MipMode::box, MipMode::edges, MipMode::corners, MipMode::least_squares}) {
      TileSet set = edge_set({8, 8}, 2, 2);
      const float value = static_cast<float>(code) / 255.0f;
      set.maps.push_back(
          {"color", Role::color, Encoding::srgb, Depth::u8, std::vector<Image>(16, Image(8, 8, 4, value))});
      for (const TileMap& level : mip_chain(set, 0, with(mode)))
        for (const Image& tile : level.tiles)
          for (const float v : tile.data()) REQUIRE(quantised(v, Depth::u8) == value);
    }
}

TEST_CASE("clear texels do not color their neighbours") {
  TileSet set = edge_set({2, 2}, 1, 1);
  Image tile(2, 2, 4);
  const auto put = [&](int x, int y, std::vector<float> v) {
    std::copy(v.begin(), v.end(), tile.texel(x, y).begin());
  };
  put(0, 0, {1.0f, 0.0f, 0.0f, 0.0f}); // clear red
  put(1, 0, {0.0f, 1.0f, 0.0f, 1.0f});
  put(0, 1, {0.0f, 1.0f, 0.0f, 0.5f});
  put(1, 1, {0.0f, 0.0f, 0.0f, 0.0f});
  set.maps.push_back({"color", Role::color, Encoding::linear, Depth::u8, {tile}});
  CHECK(texel(mip_chain(set, 0, with(MipMode::edges))[1], 0, {0, 0}) ==
        std::vector<float>{0.0f, 1.0f, 0.0f, 0.375f});
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 2; ++x) tile.texel(x, y)[3] = 0.0f;
  set.maps[0].tiles[0] = tile;
  CHECK(texel(mip_chain(set, 0, with(MipMode::edges))[1], 0, {0, 0}) ==
        std::vector<float>{0.25f, 0.5f, 0.0f, 0.0f});
}

TEST_CASE("normals are averaged as vectors and renormalised") {
  TileSet set = edge_set({4, 4}, 1, 1);
  Image tile(4, 4, 3);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x) { // leaning east, and west, by turns; the south-west quarter straight up
      const bool straight = x < 2 && y >= 2;
      const float lean = straight ? 0.0f : x % 2 == 0 ? 0.8f : -0.8f;
      tile.texel(x, y)[0] = lean * 0.5f + 0.5f;
      tile.texel(x, y)[1] = 0.5f;
      tile.texel(x, y)[2] = (straight ? 1.0f : 0.6f) * 0.5f + 0.5f;
    }
  tile.texel(3, 0)[0] = 0.9f; // one column of the north-east quarter leans the same way as the other
  tile.texel(3, 1)[0] = 0.9f;
  set.maps.push_back({"normal", Role::normal, Encoding::linear, Depth::u8, {tile}});
  const auto chain = mip_chain(set, 0, with(MipMode::box));
  for (const TileMap& level : {chain[1], chain[2]})
    for (int y = 0; y < level.tiles[0].height(); ++y)
      for (int x = 0; x < level.tiles[0].width(); ++x) {
        const auto n = texel(level, 0, {x, y});
        double squares = 0;
        for (const float v : n) squares += std::pow(static_cast<double>(v) * 2 - 1, 2);
        CHECK(squares == Approx(1.0).margin(1e-6));
      }
  CHECK(texel(chain[1], 0, {0, 0})[2] == Approx(1.0f));
  CHECK(texel(chain[1], 0, {1, 0})[0] == Approx(0.9f));
  // The vector of level 2 is the mean of sixteen vectors, not of four renormalised ones.
  const double x = 0.8 / 4;
  const double z = (3 * 0.6 + 1.0) / 4;
  CHECK(texel(chain[2], 0, {0, 0})[0] == Approx(x / std::hypot(x, z) * 0.5 + 0.5).margin(1e-6));
}

TEST_CASE("sanitized texels are equal in every bit, and nothing else has changed") {
  const Size sizes[] = {{16, 16}, {24, 8}, {8, 2}, {12, 4}};
  for (const Size size : sizes)
    for (const bool by_corner : {false, true})
      for (const MipMode mode : {MipMode::edges, MipMode::corners}) {
        const TileSet set = with_noise(by_corner ? corner_set(size, 2) : edge_set(size, 2, 3), 3);
        const auto box = mip_chain(set, 0, with(MipMode::box));
        const auto chain = mip_chain(set, 0, with(mode));
        REQUIRE(chain.size() == static_cast<std::size_t>(level_count(size)));
        for (int level = 1; level < level_count(size); ++level) {
          std::vector<Image> untouched = chain[as_size(level)].tiles;
          for (const SharedTexels& group : shared_border(set.tiles, level_size(size, level), mode))
            for (const Place place : group.places) {
              std::vector<double> mean(3);
              for (const int id : group.tiles) {
                const auto value = texel(chain[as_size(level)], id, place);
                REQUIRE(value == texel(chain[as_size(level)], group.tiles.front(), place));
                const auto before = texel(box[as_size(level)], id, place);
                for (std::size_t c = 0; c < 3; ++c)
                  mean[c] += srgb_to_linear(static_cast<double>(before[c])) /
                             static_cast<double>(group.tiles.size());
                std::copy(before.begin(), before.end(),
                          untouched[as_size(id)].texel(place.x, place.y).begin());
              }
              for (std::size_t c = 0; c < 3; ++c)
                REQUIRE(texel(chain[as_size(level)], group.tiles.front(), place)[c] ==
                        Approx(linear_to_srgb(mean[c])).margin(1e-6));
            }
          REQUIRE(untouched == box[as_size(level)].tiles);
        }
      }
}

TEST_CASE("tiles of one color share each row and column, those of another have their own") {
  const TileSet set = with_noise(edge_set({16, 16}, 2, 2), 1, Role::height, Encoding::linear);
  const TileMap level = mip_chain(set, 0, with(MipMode::edges))[1];
  const auto& tiles = std::get<std::vector<EdgeTile>>(set.tiles);
  const auto equal = [&](int a, int b, Place from, Place step) {
    for (int i = 0; i < 6; ++i) {
      const Place place{from.x + i * step.x, from.y + i * step.y};
      if (texel(level, a, place) != texel(level, b, place)) return false;
    }
    return true;
  };
  for (int a = 0; a < 16; ++a)
    for (int b = 0; b < 16; ++b) {
      const EdgeTile& s = tiles[as_size(a)];
      const EdgeTile& t = tiles[as_size(b)];
      REQUIRE(equal(a, b, {1, 0}, {1, 0}) == (s.north == t.north));
      REQUIRE(equal(a, b, {1, 7}, {1, 0}) == (s.south == t.south));
      REQUIRE(equal(a, b, {0, 1}, {0, 1}) == (s.west == t.west));
      REQUIRE(equal(a, b, {7, 1}, {0, 1}) == (s.east == t.east));
    }
}

TEST_CASE("corner texels: left alone by edges, one value for all or for each corner color by corners") {
  const Place south_east{7, 7};
  const TileSet edges = with_noise(edge_set({16, 16}, 2, 2), 1, Role::height, Encoding::linear);
  CHECK(texel(mip_chain(edges, 0, with(MipMode::edges))[1], 3, south_east) ==
        texel(mip_chain(edges, 0, with(MipMode::box))[1], 3, south_east));
  const TileMap shared = mip_chain(edges, 0, with(MipMode::corners))[1];
  for (int id = 1; id < 16; ++id) CHECK(texel(shared, id, south_east) == texel(shared, 0, south_east));

  const TileSet corners = with_noise(corner_set({16, 16}, 2), 1, Role::height, Encoding::linear);
  const TileMap by_color = mip_chain(corners, 0, with(MipMode::corners))[1];
  const auto& tiles = std::get<std::vector<CornerTile>>(corners.tiles);
  for (int a = 0; a < 16; ++a)
    for (int b = 0; b < 16; ++b)
      CHECK((texel(by_color, a, south_east) == texel(by_color, b, south_east)) ==
            (tiles[as_size(a)].se == tiles[as_size(b)].se));
}

TEST_CASE("a tile of one texel: edges leave it alone, corners make all tiles one") {
  for (const bool by_corner : {false, true}) {
    const TileSet set = with_noise(by_corner ? corner_set({2, 2}, 2) : edge_set({2, 2}, 2, 2), 3);
    CHECK(mip_chain(set, 0, with(MipMode::edges))[1].tiles == mip_chain(set, 0, with(MipMode::box))[1].tiles);
    const TileMap one = mip_chain(set, 0, with(MipMode::corners))[1];
    for (const Image& tile : one.tiles) CHECK(tile == one.tiles.front());
  }
}

TEST_CASE("with one color there is nothing to sanitize") {
  const TileSet set = with_noise(edge_set({16, 16}, 1, 1), 3);
  const auto box = mip_chain(set, 0, with(MipMode::box));
  for (const MipMode mode : {MipMode::edges, MipMode::corners}) {
    const auto chain = mip_chain(set, 0, with(mode));
    for (std::size_t level = 0; level < box.size(); ++level)
      CHECK(changed_texels(chain[level], box[level]) == 0);
  }
}

TEST_CASE("levels under the guard band are left as they are") {
  TileSet set = with_noise(edge_set({32, 32}, 2, 2), 1, Role::height, Encoding::linear);
  set.guard = 5;
  CHECK(exact_through_guard(5, 2));
  CHECK_FALSE(exact_through_guard(5, 3));
  CHECK(exact_through_guard(0, 0));
  CHECK_FALSE(exact_through_guard(0, 1));
  const auto box = mip_chain(set, 0, with(MipMode::box));
  const auto chain = mip_chain(set, 0, with(MipMode::corners));
  CHECK(chain[1].tiles == box[1].tiles);
  CHECK(chain[2].tiles == box[2].tiles);
  CHECK(changed_texels(chain[3], box[3]) > 0);
}

TEST_CASE("one thread and many give the same bits") {
  const TileSet set = with_noise(edge_set({64, 64}, 2, 2), 4);
  for (const MipMode mode : {MipMode::edges, MipMode::corners, MipMode::least_squares}) {
    const auto many = mip_chain(set, 0, with(mode));
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const auto alone = mip_chain(set, 0, with(mode));
    for (std::size_t level = 0; level < many.size(); ++level) CHECK(alone[level].tiles == many[level].tiles);
  }
}
