#include "support/images.h"

#include "tilepack/layout/de_bruijn.h"
#include "tilepack/layout/tile_index.h"
#include "tilepack/mip/least_squares.h"
#include "tilepack/mip/shared_border.h"
#include "tilepack/numeric/random.h"
#include "tilepack/tileset/border_keys.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <functional>

using namespace tilepack;

namespace {

std::size_t as_size(int i) {
  return static_cast<std::size_t>(i);
}

std::vector<Image> noise(int count, Size size, int channels, std::uint64_t seed) {
  std::vector<Image> tiles;
  for (int i = 0; i < count; ++i)
    tiles.push_back(test::noise(size.width, size.height, channels, 100 * seed + as_size(i), Depth::f32));
  return tiles;
}

// A bilinear field on texel centres -1..width, -1..height, looked up by a function, at a point of the tile.
using Texels = std::function<double(int x, int y)>;

double bilinear(const Texels& texels, double x, double y) {
  const int ix = static_cast<int>(std::floor(x - 0.5));
  const int iy = static_cast<int>(std::floor(y - 0.5));
  const double u = x - 0.5 - ix;
  const double v = y - 0.5 - iy;
  return (1 - v) * ((1 - u) * texels(ix, iy) + u * texels(ix + 1, iy)) +
         v * ((1 - u) * texels(ix, iy + 1) + u * texels(ix + 1, iy + 1));
}

// Two Gauss points in each half texel: exact for products of two bilinear fields.
struct Point {
  double at;
  double weight;
};
std::vector<Point> points(int length) {
  std::vector<Point> list;
  for (int i = 0; i < 2 * length; ++i)
    for (const double sign : {-1.0, 1.0}) list.push_back({(i + 0.5 + sign * 0.5 / std::sqrt(3.0)) / 2, 0.25});
  return list;
}

// Step (-1, 0 or 1) to the tile that a texel coordinate lies in.
int step(int i, int length) {
  return i < 0 ? -1 : i >= length ? 1 : 0;
}

struct Problem {
  TileColors colors;
  PackNeighbours pack;
  Size size;
  std::vector<Image> box;
  double jump_weight;
};

Texels read_in_pack(const Problem& p, const std::vector<Image>& stored, int tile) {
  return [&p, &stored, tile](int x, int y) {
    const int dx = step(x, p.size.width);
    const int dy = step(y, p.size.height);
    const int place = (dy + 1) * 3 + dx + 1;
    const int there =
        place == 4 ? tile : p.pack.around[as_size(tile)][as_size(place < 4 ? place : place - 1)];
    return static_cast<double>(
        stored[as_size(there)].texel(x - dx * p.size.width, y - dy * p.size.height)[0]);
  };
}

// The objective by its definition: every tile, every legal neighbourhood of it, every point. The eight
// neighbours are drawn at random, consistently with one another, `draws` times.
double brute_force_error(const Problem& p, const std::vector<Image>& stored) {
  const auto& tiles = std::get<std::vector<EdgeTile>>(p.colors);
  double total = 0;
  for (int a = 0; a < static_cast<int>(tiles.size()); ++a) {
    const Texels seen = read_in_pack(p, stored, a);
    for (const int right : {-1, 1})
      for (const int down : {-1, 1}) {
        // One quarter of the tile: the tile beside, the tile above or below, and the one diagonally across.
        double sum = 0;
        double count = 0;
        for (int e = 0; e < static_cast<int>(tiles.size()); ++e) {
          if (right > 0 ? tiles[as_size(e)].west != tiles[as_size(a)].east
                        : tiles[as_size(e)].east != tiles[as_size(a)].west)
            continue;
          for (int s = 0; s < static_cast<int>(tiles.size()); ++s) {
            if (down > 0 ? tiles[as_size(s)].north != tiles[as_size(a)].south
                         : tiles[as_size(s)].south != tiles[as_size(a)].north)
              continue;
            for (int d = 0; d < static_cast<int>(tiles.size()); ++d) {
              const EdgeTile& diagonal = tiles[as_size(d)];
              if (down > 0 ? diagonal.north != tiles[as_size(e)].south
                           : diagonal.south != tiles[as_size(e)].north)
                continue;
              if (right > 0 ? diagonal.west != tiles[as_size(s)].east
                            : diagonal.east != tiles[as_size(s)].west)
                continue;
              const Texels truth = [&](int x, int y) {
                const int dx = step(x, p.size.width);
                const int dy = step(y, p.size.height);
                const int there = dx != 0 && dy != 0 ? d : dx != 0 ? e : dy != 0 ? s : a;
                return static_cast<double>(
                    p.box[as_size(there)].texel(x - dx * p.size.width, y - dy * p.size.height)[0]);
              };
              for (const Point& py : points(p.size.height))
                for (const Point& px : points(p.size.width)) {
                  if ((px.at > p.size.width / 2.0) != (right > 0) ||
                      (py.at > p.size.height / 2.0) != (down > 0))
                    continue;
                  const double difference = bilinear(seen, px.at, py.at) - bilinear(truth, px.at, py.at);
                  sum += px.weight * py.weight * difference * difference;
                }
              count += 1;
            }
          }
        }
        total += sum / count;
      }
  }
  return total;
}

double brute_force_jump(const Problem& p, const std::vector<Image>& stored) {
  const std::vector<BorderKeys> keys = border_keys(p.colors);
  double total = 0;
  for (std::size_t a = 0; a < keys.size(); ++a)
    for (const bool below : {false, true}) {
      const auto side = below ? BorderKeys::south : BorderKeys::east;
      const auto facing = below ? BorderKeys::north : BorderKeys::west;
      double sum = 0;
      double count = 0;
      for (std::size_t b = 0; b < keys.size(); ++b) {
        if (keys[a].sides[side] != keys[b].sides[facing]) continue;
        const Texels from_a = read_in_pack(p, stored, static_cast<int>(a));
        const Texels from_b = read_in_pack(p, stored, static_cast<int>(b));
        for (const Point& q : points(below ? p.size.width : p.size.height)) {
          const double jump = below ? bilinear(from_a, q.at, p.size.height) - bilinear(from_b, q.at, 0)
                                    : bilinear(from_a, p.size.width, q.at) - bilinear(from_b, 0, q.at);
          sum += q.weight * jump * jump;
        }
        count += 1;
      }
      total += sum / count;
    }
  return total;
}

double objective(const Problem& p, const std::vector<Image>& stored) {
  return brute_force_error(p, stored) + p.jump_weight * brute_force_jump(p, stored);
}

std::vector<Image> solved(const Problem& p) {
  std::vector<Image> tiles = p.box;
  fit_borders(p.colors, p.pack, p.jump_weight, Weighting::plain, tiles);
  return tiles;
}

Problem edge_problem(Size size, int kh, int kv, double jump_weight) {
  const auto tiles = complete_edge_set(kh, kv);
  Problem p{tiles, pack_neighbours(tile_index_layout(tiles)), size, {}, jump_weight};
  p.box = noise(static_cast<int>(tiles.size()), size, 1, 3);
  // Some tiles far apart, so that no fitted value meets the ends of the range.
  p.box.front().texel(size.width / 2, size.height / 2)[0] = -10.0f;
  p.box.back().texel(size.width / 2, size.height / 2)[0] = 10.0f;
  return p;
}

bool in_ring(Size size, int x, int y) {
  return x == 0 || y == 0 || x == size.width - 1 || y == size.height - 1;
}

} // namespace

TEST_CASE("no change of any border texel lowers the objective, computed by its definition") {
  struct Case {
    Size size;
    int kv;
  };
  for (const auto& [size, kv] : {Case{{2, 2}, 2}, Case{{3, 4}, 1}, Case{{4, 5}, 1}, Case{{1, 1}, 2}})
    for (const double weight : {0.0, 4.0}) {
      const Problem p = edge_problem(size, 2, kv, weight);
      const std::vector<Image> best = solved(p);
      const double least = objective(p, best);
      CHECK(least < objective(p, p.box));
      std::uint64_t index = 0;
      for (int trial = 0; trial < 8; ++trial) {
        std::vector<Image> other = best;
        const bool single = trial % 2 == 0; // one tile, or all
        const int chosen =
            static_cast<int>(random_below(5, "tile", index++, static_cast<std::uint32_t>(best.size())));
        for (int id = 0; id < static_cast<int>(best.size()); ++id)
          for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x)
              if (in_ring(size, x, y) && (!single || id == chosen))
                other[as_size(id)].texel(x, y)[0] +=
                    (static_cast<float>(random_below(5, "change", index++, 1000)) / 1000.0f - 0.5f) * 0.1f;
        CHECK(objective(p, other) > least);
      }
    }
}

TEST_CASE("only the ring changes") {
  const Problem p = edge_problem({6, 5}, 2, 1, 4);
  const std::vector<Image> best = solved(p);
  for (std::size_t id = 0; id < best.size(); ++id)
    for (int y = 1; y < 4; ++y)
      for (int x = 1; x < 5; ++x) CHECK(best[id].texel(x, y)[0] == p.box[id].texel(x, y)[0]);
}

TEST_CASE("the heavier a jump weighs, the smaller it gets and the larger the error") {
  double last_error = 0;
  double last_jump = 1e9;
  for (const double weight : {0.0, 0.5, 2.0, 10.0, 100.0}) {
    const Problem p = edge_problem({4, 4}, 2, 1, weight);
    const std::vector<Image> best = solved(p);
    const double error = brute_force_error(p, best);
    const double jump = brute_force_jump(p, best);
    CHECK(error > last_error);
    CHECK(jump < last_jump);
    last_error = error;
    last_jump = jump;
  }
}

TEST_CASE("one color: the pack is the plane, so nothing changes") {
  const Problem p = edge_problem({4, 4}, 1, 1, 4);
  const std::vector<Image> best = solved(p);
  for (std::size_t i = 0; i < best[0].data().size(); ++i) CHECK(best[0].data()[i] == p.box[0].data()[i]);
}

TEST_CASE("a constant stays as it is, for corner colors and without a pack too") {
  const auto corners = complete_corner_set(2);
  for (const PackNeighbours& pack : {pack_neighbours(de_bruijn_layout(corners)), PackNeighbours{}}) {
    std::vector<Image> tiles(16, Image(4, 4, 4, 0.4f));
    const std::vector<Image> before = tiles;
    fit_borders(corners, pack, 4, Weighting::plain, tiles);
    CHECK(tiles == before);
  }
}

TEST_CASE("clamped tiles of a texture array: a heavy weight makes both sides of an edge one value") {
  const auto set = complete_edge_set(2, 2);
  std::vector<Image> tiles = noise(16, {6, 6}, 1, 8);
  fit_borders(set, {}, 1000, Weighting::plain, tiles);
  for (std::size_t a = 0; a < 16; ++a)
    for (std::size_t b = 0; b < 16; ++b)
      for (int i = 1; i < 5; ++i) {
        if (set[a].south == set[b].north)
          CHECK(tiles[a].texel(i, 5)[0] == Approx(tiles[b].texel(i, 0)[0]).margin(0.01));
        if (set[a].east == set[b].west)
          CHECK(tiles[a].texel(5, i)[0] == Approx(tiles[b].texel(0, i)[0]).margin(0.01));
      }
}

TEST_CASE("at no more jump the error is below that of averaged edges") {
  const Problem p = edge_problem({4, 4}, 2, 1, 0);
  std::vector<Image> averaged = p.box;
  for (const SharedTexels& group : shared_border(p.colors, p.size, MipMode::edges))
    for (const Place place : group.places) {
      double mean = 0;
      for (const int id : group.tiles)
        mean += static_cast<double>(averaged[as_size(id)].texel(place.x, place.y)[0]) /
                static_cast<double>(group.tiles.size());
      for (const int id : group.tiles)
        averaged[as_size(id)].texel(place.x, place.y)[0] = static_cast<float>(mean);
    }
  const double allowed = brute_force_jump(p, averaged);
  double least_error = 1e9;
  for (const double weight : {0.0, 0.1, 0.2, 0.4, 0.8, 1.6}) {
    Problem weighted = p;
    weighted.jump_weight = weight;
    const std::vector<Image> best = solved(weighted);
    if (brute_force_jump(p, best) <= allowed) least_error = std::min(least_error, brute_force_error(p, best));
  }
  CHECK(least_error < 0.95 * brute_force_error(p, averaged));
}
