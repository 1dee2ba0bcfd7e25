#include "support/framed_pack.h"

#include "tilepack/numeric/wrap.h"
#include "tilepack/sampler/reference_sampler.h"
#include "tilepack/sampler/virtual_texture.h"
#include "tilepack/tileset/sequential_set.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>

using namespace tilepack;

namespace {

constexpr Size tile_size{8, 8};
constexpr int cells = 12; // a side of the virtual texture

// The stored virtual texture, filtered as graphics hardware would filter it.
class Truth {
public:
  explicit Truth(const Pack& pack, int cells_a_side = cells)
      : texture(to_linear(
            virtual_texture(pack, 0, 0,
                            {0, 0, cells_a_side * tile_size.width, cells_a_side * tile_size.height}),
            Encoding::srgb)) {}

  std::array<double, 3> at(int cell_x, int cell_y, double x, double y) const {
    const Taps across = bilinear_taps(x, tile_size.width);
    const Taps down = bilinear_taps(y, tile_size.height);
    std::array<double, 3> sum{};
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 2; ++i) {
        const double weight =
            (i == 0 ? 1.0 - across.weight : across.weight) * (j == 0 ? 1.0 - down.weight : down.weight);
        if (weight == 0.0) continue;
        const auto texel =
            texture.texel(wrapped(cell_x * tile_size.width + across.first + i, texture.width()),
                          wrapped(cell_y * tile_size.height + down.first + j, texture.height()));
        for (std::size_t c = 0; c < 3; ++c) sum[c] += weight * static_cast<double>(texel[c]);
      }
    return sum;
  }

private:
  Image texture;
};

struct LargestErrors {
  double interior = 0;
  double edge = 0;
  double corner = 0;
};

// At a fine net of points in every cell: where the filter crosses no border, one, or reads
// a corner texel.
LargestErrors largest_errors(const Pack& pack, double corner_width = default_corner_width) {
  const Truth truth(pack);
  const ReferenceSampler sampler(pack, 0, corner_width);
  LargestErrors errors;
  constexpr double points[] = {0.0, 0.01, 0.03, 0.0625, 0.2, 0.5, 0.77, 0.9375, 0.95, 0.99, 0.9999};
  for (int cell_y = 0; cell_y < cells; ++cell_y)
    for (int cell_x = 0; cell_x < cells; ++cell_x)
      for (const double y : points)
        for (const double x : points) {
          std::array<double, 3> value{};
          sampler.sample({cell_x, x}, {cell_y, y}, 0, Filter::bilinear, value);
          const std::array<double, 3> expected = truth.at(cell_x, cell_y, x, y);
          // Across one border, and near the other: within 1.5 texels a corner texel is read.
          const auto from_border = [](double f, int side) { return std::min(f, 1 - f) * side; };
          const double dx = from_border(x, tile_size.width);
          const double dy = from_border(y, tile_size.height);
          const bool edge = std::min(dx, dy) < 0.5;
          double& largest = edge && std::max(dx, dy) < 1.5 ? errors.corner
                            : edge                         ? errors.edge
                                                           : errors.interior;
          for (std::size_t c = 0; c < 3; ++c) largest = std::max(largest, std::fabs(value[c] - expected[c]));
        }
  return errors;
}

PackingOptions options_for(LayoutKind layout, MappingKind mapping = MappingKind::mix) {
  PackingOptions options;
  options.layout = layout;
  options.mapping = mapping;
  options.virtual_size = {cells, cells};
  return options;
}

} // namespace

TEST_CASE("bilinear through the de Bruijn torus is that of the virtual texture to the last bit") {
  for (const int colors : {1, 2, 3, 4}) {
    CAPTURE(colors);
    const Pack pack = packed(framed_set(complete_corner_set(colors), tile_size, 5),
                             options_for(LayoutKind::de_bruijn, MappingKind::permutation), 9);
    const LargestErrors errors = largest_errors(pack);
    CHECK(errors.interior == 0.0);
    CHECK(errors.edge == 0.0);
    CHECK(errors.corner == 0.0);
  }
}

TEST_CASE("in every tile and at every lattice point, corner-colored packs are filtered without any error") {
  constexpr int side = 40;
  for (const int colors : {2, 3, 4}) {
    CAPTURE(colors);
    PackingOptions options = options_for(LayoutKind::de_bruijn);
    options.virtual_size = {side, side};
    const Pack pack = packed(framed_set(complete_corner_set(colors), tile_size, 5), options, 9);
    const Truth truth(pack, side);
    const ReferenceSampler sampler(pack, 0);
    int wrong = 0;
    const auto compare = [&](int cell_x, int cell_y, double x, double y) {
      std::array<double, 3> value{};
      sampler.sample({cell_x, x}, {cell_y, y}, 0, Filter::bilinear, value);
      if (value != truth.at(cell_x, cell_y, x, y)) ++wrong;
    };
    std::vector<bool> seen(static_cast<std::size_t>(tile_count(pack.tiles)));
    for (int cell_y = 0; cell_y < side; ++cell_y)
      for (int cell_x = 0; cell_x < side; ++cell_x) {
        for (const double x : {0.01, 0.1, 0.93})
          for (const double y : {0.02, 0.17, 0.99}) compare(cell_x, cell_y, x, y);
        const auto tile = static_cast<std::size_t>(tile_at(pack.mapping, pack.colors, cell_x, cell_y));
        if (seen[tile]) continue;
        seen[tile] = true;
        // Four places a texel along each axis, texel centres and borders among them.
        for (int j = 0; j < 4 * tile_size.height; ++j)
          for (int i = 0; i < 4 * tile_size.width; ++i)
            compare(cell_x, cell_y, i / (4.0 * tile_size.width), j / (4.0 * tile_size.height));
      }
    CHECK(wrong == 0);
    CHECK(std::find(seen.begin(), seen.end(), false) == seen.end());
  }
}

TEST_CASE("an edge pack is exact along edges and wrong at corners; the corner pack mends these") {
  for (const ColorCounts colors : {ColorCounts{2, 2, 0}, ColorCounts{3, 2, 0}, ColorCounts{3, 3, 0}}) {
    CAPTURE(colors.horizontal, colors.vertical);
    PackingOptions options = options_for(LayoutKind::tile_index);
    const TileSet set = framed_set(complete_edge_set(colors.horizontal, colors.vertical), tile_size, 5);
    const LargestErrors plain = largest_errors(packed(set, options, 9));
    CHECK(plain.interior == 0.0);
    CHECK(plain.edge == 0.0);
    CHECK(plain.corner > 0.1);
    options.corner_pack = true;
    Pack pack = packed(set, options, 9);
    pack.corner_pack->width = 4; // as wide as mending takes, whatever it does elsewhere
    CHECK(pack.corner_pack->columns == colors.horizontal * colors.horizontal);
    CHECK(pack.corner_pack->maps.at(0).levels.size() == pack.maps.at(0).levels.size());
    CHECK(largest_errors(pack).corner == 0.0);
    CHECK(largest_errors(pack, 0.0).corner == plain.corner); // width 0 leaves it aside
  }
}

TEST_CASE("as wide as the pack allows, the corner pack never adds to the largest error") {
  const TileSet framed = framed_set(complete_edge_set(2, 2), tile_size, 5);
  // Corners that all tiles share, and quarters that follow from the two edges at their corner.
  TileSet shared = framed;
  TileSet quartered = framed;
  for (std::size_t id = 0; id < 16; ++id) {
    const EdgeTile colors = std::get<std::vector<EdgeTile>>(framed.tiles)[id];
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 8; ++x) {
        const bool corner = (x == 0 || x == 7) && (y == 0 || y == 7);
        if (corner) std::ranges::fill(shared.maps[0].tiles[id].texel(x, y), 1.0f);
        const int across = y < 4 ? colors.north : colors.south;
        const int down = x < 4 ? colors.west : colors.east;
        for (std::size_t c = 0; c < 3; ++c)
          quartered.maps[0].tiles[id].texel(x, y)[c] =
              framed.maps[0].tiles[static_cast<std::size_t>(across * 2 + down)].texel(x, y)[c];
      }
  }
  PackingOptions options = options_for(LayoutKind::tile_index);
  options.corner_pack = true;
  struct Case {
    const TileSet* set;
    double width;
    double at_most; // of the largest error without a corner pack
  };
  for (const Case& c : {Case{&framed, 1.25, 0.5}, Case{&shared, 0.0, 0.0}, Case{&quartered, 3.5, 0.0}}) {
    const Pack pack = packed(*c.set, options, 9);
    CAPTURE(c.width);
    CHECK(pack.corner_pack->width == c.width);
    const auto largest = [](const LargestErrors& e) { return std::max({e.interior, e.edge, e.corner}); };
    CHECK(largest(largest_errors(pack, 32)) <= c.at_most * largest(largest_errors(pack, 0.0)) + 1e-15);
  }
}

TEST_CASE("an array with borders is exact along edges; without, it is clamped there") {
  const TileSet set = framed_set(complete_corner_set(2), tile_size, 5);
  PackingOptions options = options_for(LayoutKind::array);
  CHECK(largest_errors(packed(set, options, 9)).edge > 0.1);
  options.array.border = 1;
  const LargestErrors errors = largest_errors(packed(set, options, 9));
  CHECK(errors.interior == 0.0);
  CHECK(errors.edge == 0.0);
  CHECK(errors.corner == 0.0); // corner colors tell the diagonal neighbour's corner too
}

TEST_CASE("a rotated layout that isn't turned is exact along matching edges") {
  PackingOptions options = options_for(LayoutKind::rotated, MappingKind::index);
  options.rotated.scheme = RotatedScheme{2, 0, 2};
  const LargestErrors errors =
      largest_errors(packed(framed_set(sequential_edge_set(2, 2), tile_size, 5), options, 9));
  CHECK(errors.interior < 1e-12);
  CHECK(errors.edge < 1e-12);
}

TEST_CASE("a turned layout is read at the turned place") {
  // All tiles of one color: whatever the turn, the filter finds that color.
  TileSet set = framed_set(sequential_edge_set(2, 2), tile_size, 5);
  for (Image& tile : set.maps[0].tiles) tile = Image(8, 8, 3, 0.2f);
  PackingOptions options = options_for(LayoutKind::rotated, MappingKind::index);
  for (const RotatedScheme scheme : {RotatedScheme{2, 2, 1}, RotatedScheme{2, 0, 2}}) {
    options.rotated.scheme = scheme;
    const LargestErrors errors = largest_errors(packed(set, options, 9));
    CHECK(std::max({errors.interior, errors.edge, errors.corner}) < 1e-7);
  }
  // A slope along each tile: bilinear keeps it, so what is read is the place itself.
  for (Image& tile : set.maps[0].tiles)
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 8; ++x)
        for (std::size_t c = 0; c < 3; ++c)
          tile.texel(x, y)[c] = static_cast<float>(3 * x + 7 * y + 20) / 255.0f;
  set.maps[0].encoding = Encoding::linear;
  set.maps[0].depth = Depth::f32;
  options.rotated.scheme = RotatedScheme{2, 2, 1};
  options.rotated.gutter = 2;
  options.rotated.turn_filter = ResampleFilter::bicubic;
  const Pack pack = packed(set, options, 9);
  const ReferenceSampler sampler(pack, 0);
  double worst = 0;
  for (double y = 0.4; y <= 0.6; y += 0.05)
    for (double x = 0.4; x <= 0.6; x += 0.05) {
      std::array<double, 3> value{};
      sampler.sample({3, x}, {4, y}, 0, Filter::bilinear, value);
      worst = std::max(worst, std::fabs(value[1] - (3 * (8 * x - 0.5) + 7 * (8 * y - 0.5) + 20) / 255));
    }
  CHECK(worst < 1e-6);
}

TEST_CASE("the corner weight is 1 at corners, 0 beyond its width, and smooth") {
  const Size tile{64, 64};
  CHECK(corner_weight(0, 0, tile, 8) == 1.0);
  CHECK(corner_weight(0.5 / 64, 1 - 1.4 / 64, tile, 8) == 1.0);
  CHECK(corner_weight(8.0 / 64, 0, tile, 8) == 0.0);
  CHECK(corner_weight(0.5, 0.5, tile, 8) == 0.0);
  // Continuous, and its slope too, along a line through a corner and the middle of a tile.
  const double step = 1e-4;
  for (const double width : {2.0, 8.0, 32.0, 1000.0})
    for (double x = 0; x < 1 - 2 * step; x += step) {
      const double a = corner_weight(x, 0.01, tile, width);
      const double b = corner_weight(x + step, 0.01, tile, width);
      const double c = corner_weight(x + 2 * step, 0.01, tile, width);
      REQUIRE((a >= 0 && a <= 1));
      REQUIRE(std::fabs(a - b) < 0.01);
      REQUIRE(std::fabs(a - 2 * b + c) < 1e-3);
    }
  // A level of one texel a tile still blends.
  CHECK(corner_weight(0.1, 0.1, {1, 1}, 4) > 0.5);
}
