#include "tilepack/bench/stress_lookups.h"

#include "tilepack/bake/packing.h"
#include "tilepack/numeric/random.h"
#include "tilepack/sampler/fast_sampler.h"
#include "tilepack/sampler/ground_truth.h"
#include "tilepack/sampler/reference_sampler.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace tilepack {
namespace {

using Value = std::array<double, 3>;
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr std::int64_t far_side = std::int64_t{1} << 31; // tiles

// Outermost texels are drawn by the color of their edge, corners are all alike: so what a filter reads across
// a border in the pack is what lies there in the virtual texture.
Image drawn_tile(const EdgeTile& tile, std::uint64_t id, Size size) {
  Image image(size.width, size.height, 3);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const bool west = x == 0, east = x == size.width - 1, north = y == 0, south = y == size.height - 1;
      std::uint64_t key = 0;
      if (!((west || east) && (north || south))) {
        const int side = north ? 1 : south ? 2 : west ? 3 : east ? 4 : 5;
        const int color = north ? tile.north : south ? tile.south : west ? tile.west : tile.east;
        key = side == 5
                  ? 1000000 * (id + 1) + static_cast<std::uint64_t>(x * 1000 + y)
                  : static_cast<std::uint64_t>(side * 100000 + color * 10000 + (north || south ? x : y));
      }
      for (std::size_t c = 0; c < 3; ++c)
        image.texel(x, y)[c] = static_cast<float>(random_below(1, "hard", key * 3 + c, 256)) / 255.0f;
    }
  return image;
}

Pack drawn_pack(Size size, int colors, VirtualSize virtual_size) {
  const auto tiles = complete_edge_set(colors, colors);
  TileSet set{size, {colors, colors, 0}, tiles, {}, 1};
  TileMap map{"color", Role::color, Encoding::srgb, Depth::u8, {}};
  for (std::size_t id = 0; id < tiles.size(); ++id) map.tiles.push_back(drawn_tile(tiles[id], id, size));
  set.maps.push_back(std::move(map));
  PackingOptions options;
  options.mips.mode = MipMode::box;
  options.virtual_size = virtual_size;
  return packed(std::move(set), options, 1);
}

double apart(const Value& a, const Value& b) {
  double worst = 0;
  for (std::size_t c = 0; c < a.size(); ++c) {
    if (!std::isfinite(a[c])) return infinity;
    worst = std::max(worst, 255 * std::fabs(a[c] - b[c]));
  }
  return worst;
}

struct Point {
  TileCoordinate x;
  TileCoordinate y;
};

Value exact(const Pack& pack, Point at, double level, Filter filter, WrapMode border = WrapMode::wrap) {
  Value out{};
  ReferenceSampler(pack, 0, default_corner_width, border).sample(at.x, at.y, level, filter, out);
  return out;
}

Value over(const Pack& pack, Point at, const Footprint& footprint) {
  Value out{};
  ReferenceSampler(pack, 0).sample(at.x, at.y, footprint, out);
  return out;
}

// The fast sampler takes tiles of 32 bits, which go round, and fractions in single precision.
Value fast(const Pack& pack, Point at, double level, Filter filter) {
  const auto tile_x = static_cast<std::int32_t>(at.x.tile);
  const auto tile_y = static_cast<std::int32_t>(at.y.tile);
  const auto x = static_cast<float>(at.x.fraction);
  const auto y = static_cast<float>(at.y.fraction);
  const auto of_level = static_cast<float>(level);
  std::array<float, 3> values{};
  const std::array<float*, 3> out{&values[0], &values[1], &values[2]};
  FastSampler(pack, 0).sample({1, &tile_x, &tile_y, &x, &y, &of_level}, filter, Weights::exact, out);
  return {static_cast<double>(values[0]), static_cast<double>(values[1]), static_cast<double>(values[2])};
}

// What lies at a point, by three filters in level 0: `wanted` in the texture written out. In single precision
// another place may be promised.
HardLookup point_case(const Pack& pack, std::string input, std::string promise, Point given, Point wanted,
                      std::optional<Point> wanted_in_floats = {}) {
  const GroundTruth truth = GroundTruth::of_level_0(pack, 0);
  HardLookup result{std::move(input), std::move(promise), 0, 0.0};
  for (const Filter filter : {Filter::nearest, Filter::bilinear, Filter::trilinear}) {
    const auto at = [&](Point point) {
      Value value{};
      truth.sample(point.x, point.y, 0, filter, value);
      return value;
    };
    result.reference = std::max(result.reference, apart(exact(pack, given, 0, filter), at(wanted)));
    result.fast =
        std::max(*result.fast, apart(fast(pack, given, 0, filter), at(wanted_in_floats.value_or(wanted))));
  }
  return result;
}

HardLookup level_case(const Pack& pack, std::string input, std::string promise, double given, double wanted) {
  const Point at{{2, 0.3}, {4, 0.8}};
  HardLookup result{std::move(input), std::move(promise), 0, 0.0};
  for (const Filter filter : {Filter::nearest, Filter::bilinear, Filter::trilinear}) {
    const Value value = exact(pack, at, wanted, filter);
    result.reference = std::max(result.reference, apart(exact(pack, at, given, filter), value));
    result.fast = std::max(*result.fast, apart(fast(pack, at, given, filter), value));
  }
  return result;
}

void add_coordinates(const Pack& pack, std::vector<HardLookup>& cases) {
  const TileCoordinate x{3, 0.4};
  const TileCoordinate y{2, 0.7};
  const double below_one = std::nextafter(1.0, 0.0);
  const auto add = [&](const char* input, const char* promise, Point given, Point wanted) {
    cases.push_back(point_case(pack, input, promise, given, wanted));
  };
  add("on a border", "what the texture has there", {{3, 0.0}, y}, {{3, 0.0}, y});
  add("on a corner of tiles", "what the texture has there", {{3, 0.0}, {2, 0.0}}, {{3, 0.0}, {2, 0.0}});
  add("fraction 1 - 2^-24, the last float below 1", "that place", {{3, 1 - 0x1p-24}, y},
      {{3, 1 - 0x1p-24}, y});
  cases.push_back(point_case(pack, "fraction 1 - 2^-53, the last double below 1",
                             "that place; as a float, the border", {{3, below_one}, y}, {{3, below_one}, y},
                             Point{{4, 0.0}, y}));
  add("fraction 1", "the next tile's border", {{3, 1.0}, y}, {{4, 0.0}, y});
  add("fraction -1e-20, which no double keeps apart from 1", "the border itself", {{3, -1e-20}, y},
      {{3, 0.0}, y});
  cases.push_back(point_case(pack, "fraction -1e-9, which no float keeps apart from 1",
                             "that place; as a float, the border", {{3, -1e-9}, y}, {{3, -1e-9}, y},
                             Point{{3, 0.0}, y}));
  add("negative tiles and fractions", "the texture wraps", {{-1, -6.6}, {-14, 0.7}}, {{-8, 0.4}, {2, 0.7}});
  add("fraction NaN", "counts as 0", {{3, nan}, y}, {{3, 0.0}, y});
  add("fraction infinite", "counts as 0", {x, {2, infinity}}, {x, {2, 0.0}});
  add("fraction 1e30 tiles", "counts as 0", {x, {2, -1e30}}, {x, {2, 0.0}});
}

void add_far(std::vector<HardLookup>& cases) {
  const Pack pack = drawn_pack({8, 8}, 2, {far_side, far_side});
  const TileCoordinate y{5, 0.3};
  cases.push_back(point_case(pack, "2^24 + 1.5 texels from the origin, as tile + fraction",
                             "nothing lost (a float in texels would be off by 0.5)", {{1 << 21, 1.5 / 8}, y},
                             {{1 << 21, 1.5 / 8}, y}));
  cases.push_back(point_case(pack, "tile 2^31 - 1, the last", "nothing lost",
                             {{far_side - 1, 0.4}, {far_side - 1, 0.9}},
                             {{far_side - 1, 0.4}, {far_side - 1, 0.9}}));
  cases.push_back(point_case(pack, "tile -2^31, the first again", "the texture wraps", {{-far_side, 0.4}, y},
                             {{0, 0.4}, y}));
}

void add_levels(const Pack& pack, std::vector<HardLookup>& cases) {
  const double last = pack.tile_levels - 1;
  cases.push_back(level_case(pack, "level past the last", "the last", last + 0.75, last));
  cases.push_back(level_case(pack, "level infinite", "the last", infinity, last));
  cases.push_back(level_case(pack, "level below 0", "level 0", -2.5, 0));
  cases.push_back(level_case(pack, "level NaN", "level 0", nan, 0));
}

void add_footprints(const Pack& pack, std::vector<HardLookup>& cases) {
  const Point at{{2, 3.5 / 8}, {4, 2.5 / 8}};
  const auto add = [&](const char* input, const char* promise, double off) {
    cases.push_back({input, promise, off, {}});
  };
  const Value texel = exact(pack, at, 0, Filter::nearest);
  add("footprint zero, at a texel's centre", "the texel", apart(over(pack, at, {}), texel));
  add("footprint NaN", "counts as 0", apart(over(pack, at, {nan, nan, nan, nan}), texel));
  const Footprint whole{0x1p40, 0, 0, 0x1p40};
  add("footprint infinite", "as 2^40 tiles",
      apart(over(pack, at, {infinity, 0, 0, -infinity}), over(pack, at, whole)));
  add("footprint larger than the texture", "128 texels of the coarsest level either way, about the mean",
      apart(over(pack, at, {1e6, 0, 0, 1e6}), over(pack, at, whole)));
  const double wide = 40.0 / 8;
  add("footprint 10^6 times as long as wide", "as one 64 times as long",
      apart(over(pack, at, {wide, 0, 0, wide * 1e-6}), over(pack, at, {wide, 0, 0, wide / max_anisotropy})));
}

// At borders, corners and inside, against the texture written out.
HardLookup tile_case(Size size, int colors, const char* input) {
  const Pack pack = drawn_pack(size, colors, {6, 5});
  HardLookup result{input, "as any other: what the texture has", 0, 0.0};
  for (const double x : {0.0, 0.05, 0.5, 0.93})
    for (const double y : {0.0, 0.31, 0.99}) {
      const Point at{{3, x}, {-2, y}};
      const HardLookup here = point_case(pack, "", "", at, at);
      result.reference = std::max(result.reference, here.reference);
      result.fast = std::max(*result.fast, *here.fast);
    }
  return result;
}

void add_borders(const Pack& pack, std::vector<HardLookup>& cases) {
  const TileCoordinate y{2, 3.5 / 8};
  const auto add = [&](const char* input, const char* promise, WrapMode border, double given, double wanted) {
    double off = 0;
    for (const Filter filter : {Filter::nearest, Filter::bilinear, Filter::trilinear})
      off = std::max(off, apart(exact(pack, {{0, given}, y}, 0, filter, border),
                                exact(pack, {{0, wanted}, y}, 0, filter, border)));
    cases.push_back({input, promise, off, {}});
  };
  add("clamp, on the texture's border", "its outermost texel", WrapMode::clamp, 0.0, 0.5 / 8);
  add("clamp, 10^12 tiles beyond it", "its outermost texel", WrapMode::clamp, 1e12, 8 - 0.5 / 8);
  add("mirror, 3.3 tiles beyond", "3.3 tiles within", WrapMode::mirror, -3.3, 3.3);
}

} // namespace

std::vector<HardLookup> stress_lookups() {
  const Pack pack = drawn_pack({8, 8}, 2, {8, 8});
  std::vector<HardLookup> cases;
  add_coordinates(pack, cases);
  add_far(cases);
  add_levels(pack, cases);
  add_footprints(pack, cases);
  cases.push_back(tile_case({1, 1}, 2, "tiles of one texel"));
  cases.push_back(tile_case({7, 5}, 2, "tiles of 7 x 5 texels, which have one level"));
  cases.push_back(tile_case({13, 13}, 3, "tiles of a prime side, 3 colors"));
  cases.push_back(tile_case({8, 8}, 1, "K = 1: a single tile"));
  add_borders(pack, cases);
  return cases;
}

std::string hard_lookups_text(const std::vector<HardLookup>& cases) {
  std::string text =
      "  input                                                     reference       fast  promised\n";
  for (const HardLookup& c : cases)
    text += fmt::format("  {:<55} {:>11.2g} {:>10}  {}{}\n", c.input, c.reference,
                        c.fast ? fmt::format("{:.2g}", *c.fast) : "-", c.promise, c.kept() ? "" : "  BROKEN");
  return text;
}

} // namespace tilepack
