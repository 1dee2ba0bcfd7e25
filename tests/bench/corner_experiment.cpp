// The corner experiment of [Wei04]: tiles with a distinct feature at each corner, looked up without corner
// handling, from the corner pack alone, and blended, against the virtual texture itself.
//
//   bench_corner_experiment PICTURE.png [WIDTH]
//
// Prints the largest and the RMS error of the three in 8-bit steps, level by level, over the whole texture,
// and draws a piece of level 2 magnified: without handling, corner pack alone, blended, truth.

#include "tilepack/bake/packing.h"
#include "tilepack/image/image_file.h"
#include "tilepack/numeric/random.h"
#include "tilepack/numeric/wrap.h"
#include "tilepack/sampler/corner_blend.h"
#include "tilepack/sampler/reference_sampler.h"
#include "tilepack/sampler/virtual_texture.h"
#include "tilepack/mip/level_size.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdlib>

using namespace tilepack;

namespace {

constexpr int cells = 12;
constexpr int side = 32;

// Grey tiles, each with a disc of its own color in the middle, and round each corner a quarter disc whose
// color belongs to the two edges that meet there.
TileSet tiles_with_corner_features() {
  TileSet set{{side, side}, {2, 2, 0}, complete_edge_set(2, 2), {}, 1};
  TileMap map{"color", Role::color, Encoding::linear, Depth::f32, {}};
  for (const EdgeTile& tile : std::get<std::vector<EdgeTile>>(set.tiles)) {
    const int pairs[] = {tile.north * 2 + tile.west, tile.north * 2 + tile.east, tile.south * 2 + tile.west,
                         tile.south * 2 + tile.east};
    Image image(side, side, 3, 0.6f);
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        const int corner = (x >= side / 2 ? 1 : 0) + (y >= side / 2 ? 2 : 0);
        const double dx = std::min(x + 0.5, side - x - 0.5);
        const double dy = std::min(y + 0.5, side - y - 0.5);
        const double from_middle = std::hypot(x + 0.5 - side / 2, y + 0.5 - side / 2);
        const bool middle = from_middle < 8;
        if (dx * dx + dy * dy > 36 && !middle) continue;
        const int feature = middle ? 100 + static_cast<int>(map.tiles.size()) : corner * 4 + pairs[corner];
        for (std::size_t c = 0; c < 3; ++c)
          image.texel(x, y)[c] = static_cast<float>(random_below(
                                     11, "feature", static_cast<std::uint64_t>(feature) * 3 + c, 256)) /
                                 255.0f;
      }
    map.tiles.push_back(image);
  }
  set.maps.push_back(map);
  return set;
}

using Value = std::array<double, 3>;
enum class Lookup { plain, corners_alone, blended, truth };

class Experiment {
public:
  Experiment(const Pack& of_pack, int of_level, double width)
      : level(of_level), plain(of_pack, 0, 0), blended(of_pack, 0, width), corners(of_pack, 0, width),
        tile(level_size(of_pack.tile_size, of_level)),
        written(virtual_texture(of_pack, 0, of_level, {0, 0, cells * tile.width, cells * tile.height})) {}

  Value at(Lookup lookup, TileCoordinate x, TileCoordinate y) const {
    Value value{};
    if (lookup == Lookup::plain) plain.sample(x, y, level, Filter::bilinear, value);
    if (lookup == Lookup::blended) blended.sample(x, y, level, Filter::bilinear, value);
    if (lookup == Lookup::corners_alone) {
      const auto taps =
          corners.pack_texels().taps(level, corners.place(x.tile, y.tile, x.fraction, y.fraction), x.fraction,
                                     y.fraction, Filter::bilinear);
      for (int i = 0; i < taps.count; ++i)
        for (std::size_t c = 0; c < 3; ++c)
          value[c] += taps.taps[static_cast<std::size_t>(i)].weight *
                      static_cast<double>(taps.taps[static_cast<std::size_t>(i)].texel[c]);
    }
    if (lookup == Lookup::truth) {
      const Taps across = bilinear_taps(x.fraction, tile.width);
      const Taps down = bilinear_taps(y.fraction, tile.height);
      for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 2; ++i)
          for (std::size_t c = 0; c < 3; ++c)
            value[c] +=
                (i == 0 ? 1 - across.weight : across.weight) * (j == 0 ? 1 - down.weight : down.weight) *
                static_cast<double>(written.texel(
                    wrapped(static_cast<int>(x.tile) * tile.width + across.first + i, written.width()),
                    wrapped(static_cast<int>(y.tile) * tile.height + down.first + j, written.height()))[c]);
    }
    return value;
  }

private:
  int level;
  ReferenceSampler plain;
  ReferenceSampler blended;
  CornerTexels corners;
  Size tile;
  Image written;
};

void print_errors(const Experiment& experiment, int level) {
  fmt::print("| {} |", level);
  for (const Lookup lookup : {Lookup::plain, Lookup::corners_alone, Lookup::blended}) {
    double largest = 0;
    double sum = 0;
    double count = 0;
    constexpr int steps = 48; // lookups along a tile
    for (int j = 0; j < cells * steps; ++j)
      for (int i = 0; i < cells * steps; ++i) {
        const TileCoordinate x{i / steps, (i % steps + 0.37) / steps};
        const TileCoordinate y{j / steps, (j % steps + 0.37) / steps};
        const Value got = experiment.at(lookup, x, y);
        const Value wanted = experiment.at(Lookup::truth, x, y);
        for (std::size_t c = 0; c < 3; ++c) {
          const double d = 255 * std::fabs(got[c] - wanted[c]);
          largest = std::max(largest, d);
          sum += d * d;
          ++count;
        }
      }
    fmt::print(" {:.1f} / {:.2f} |", largest, std::sqrt(sum / count));
  }
  fmt::print("\n");
}

Image picture(const Experiment& experiment) {
  constexpr int pixels = 96; // a tile
  constexpr int tiles = 3;
  constexpr int gap = 8;
  Image image(4 * (tiles * pixels + gap) - gap, tiles * pixels, 3, 1.0f);
  int panel = 0;
  for (const Lookup lookup : {Lookup::plain, Lookup::corners_alone, Lookup::blended, Lookup::truth}) {
    for (int j = 0; j < tiles * pixels; ++j)
      for (int i = 0; i < tiles * pixels; ++i) {
        const Value v = experiment.at(lookup, {i / pixels, (i % pixels + 0.5) / pixels},
                                      {j / pixels, (j % pixels + 0.5) / pixels});
        for (std::size_t c = 0; c < 3; ++c)
          image.texel(panel * (tiles * pixels + gap) + i, j)[c] = static_cast<float>(v[c]);
      }
    ++panel;
  }
  return image;
}

} // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    fmt::print(stderr, "usage: bench_corner_experiment PICTURE.png [WIDTH]\n");
    return 1;
  }
  try {
    PackingOptions options;
    options.corner_pack = true;
    options.mips.mode = MipMode::box;
    options.virtual_size = {cells, cells};
    options.mapping = MappingKind::mix;
    const Pack pack = packed(tiles_with_corner_features(), options, 1);
    const double width = argc > 2 ? std::atof(argv[2]) : default_corner_width;
    fmt::print("Largest / RMS error, blend width {} texels\n\n| level | no handling | corner pack alone | "
               "blended |\n"
               "|---|---|---|---|\n",
               width);
    for (int level = 0; level < 4; ++level) print_errors(Experiment(pack, level, width), level);
    write_image(argv[1], picture(Experiment(pack, 2, width)), Depth::u8, Encoding::srgb);
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench_corner_experiment: {}\n", error.what());
    return 1;
  }
  return 0;
}
