// Texels stored and the largest error of bilinear filtering at level 0, layout by layout, for 2, 3 and 4
// colors of tiles baked from one sample:
//
//   bench_layout_error SAMPLE [TILE_SIDE]
//
// The error is that of the value read through the pack against the same filter on the virtual texture written
// out from the tiles as they were before packing, in 8-bit steps of the encoded value. Zones: interior (the
// filter stays in one tile), edge (it crosses a border), corner (it crosses one and reads a texel in a tile's
// corner).

#include "tilepack/bake/packing.h"
#include "tilepack/image/image_file.h"
#include "tilepack/numeric/wrap.h"
#include "tilepack/sampler/reference_sampler.h"
#include "tilepack/sampler/virtual_texture.h"
#include "tilepack/synth/synthesize.h"
#include "tilepack/tileset/sequential_set.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <mutex>
#include <string>
#include <vector>

using namespace tilepack;

namespace {

// The tiles of `wanted` alone, of a complete edge-colored set.
TileSet subset(const TileSet& set, const TileColors& wanted) {
  TileSet result{set.tile_size, set.colors, wanted, {}, set.guard};
  for (const TileMap& map : set.maps) {
    TileMap& chosen = result.maps.emplace_back(TileMap{map.name, map.role, map.encoding, map.depth, {}});
    for (const EdgeTile& tile : std::get<std::vector<EdgeTile>>(wanted)) {
      const int id = id_in_complete_set(tile, set.colors.horizontal, set.colors.vertical);
      chosen.tiles.push_back(map.tiles[static_cast<std::size_t>(id)]);
    }
  }
  return result;
}

constexpr int cells = 16; // a side of the virtual texture looked at

struct LargestErrors {
  double interior = 0;
  double edge = 0;
  double corner = 0;

  void take(const LargestErrors& other) {
    interior = std::max(interior, other.interior);
    edge = std::max(edge, other.edge);
    corner = std::max(corner, other.corner);
  }
};

double distance_to_border(double fraction, int side) {
  return std::min(fraction, 1 - fraction) * side;
}

LargestErrors errors_of_row(const Pack& pack, const Image& truth, const ReferenceSampler& sampler, int cell_y,
                            double y) {
  // Close to the borders densely, elsewhere a few places between texels.
  constexpr double points[] = {0.0,  0.001, 0.003, 0.006, 0.01,  0.014,  0.02,  0.1,   0.303,
                               0.57, 0.81,  0.98,  0.986, 0.992, 0.9965, 0.999, 0.9999};
  const Size tile = pack.tile_size;
  const auto channels = static_cast<std::size_t>(pack.maps[0].channels);
  LargestErrors errors;
  for (int cell_x = 0; cell_x < cells; ++cell_x)
    for (const double x : points) {
      std::array<double, 4> value{};
      sampler.sample({cell_x, x}, {cell_y, y}, 0, Filter::bilinear, std::span(value.data(), channels));
      const Taps across = bilinear_taps(x, tile.width);
      const Taps down = bilinear_taps(y, tile.height);
      const double dx = distance_to_border(x, tile.width);
      const double dy = distance_to_border(y, tile.height);
      const bool edge = std::min(dx, dy) < 0.5;
      double& largest = edge && std::max(dx, dy) < 1.5 ? errors.corner : edge ? errors.edge : errors.interior;
      for (std::size_t c = 0; c < channels; ++c) {
        double expected = 0;
        for (int j = 0; j < 2; ++j)
          for (int i = 0; i < 2; ++i)
            expected += (i == 0 ? 1 - across.weight : across.weight) *
                        (j == 0 ? 1 - down.weight : down.weight) *
                        static_cast<double>(
                            truth.texel(wrapped(cell_x * tile.width + across.first + i, truth.width()),
                                        wrapped(cell_y * tile.height + down.first + j, truth.height()))[c]);
        largest = std::max(largest, 255 * std::fabs(linear_to_srgb(value[c]) - linear_to_srgb(expected)));
      }
    }
  return errors;
}

LargestErrors largest_errors(const Pack& pack, const TileSet& set) {
  const Size tile = set.tile_size;
  const Image truth =
      to_linear(virtual_texture(pack, set.maps[0].tiles, {0, 0, cells * tile.width, cells * tile.height}),
                set.maps[0].encoding);
  const ReferenceSampler sampler(pack, 0);
  constexpr double rows[] = {0.0, 0.0025, 0.007, 0.0125, 0.019, 0.25, 0.6, 0.985, 0.993, 0.999};
  LargestErrors errors;
  std::mutex taking;
  tbb::parallel_for(0, cells, [&](int cell_y) {
    for (const double y : rows) {
      const LargestErrors row = errors_of_row(pack, truth, sampler, cell_y, y);
      const std::lock_guard lock(taking);
      errors.take(row);
    }
  });
  return errors;
}

std::int64_t texels_stored(const Pack& pack) {
  const auto texels = [](const Image& image) { return std::int64_t{image.width()} * image.height(); };
  std::int64_t sum = texels(pack.maps[0].levels[0]);
  if (pack.corner_pack) sum += texels(pack.corner_pack->maps[0].levels[0]);
  return sum;
}

void print_row(int colors, const std::string& name, const TileSet& set, const PackingOptions& options) {
  const Pack pack = packed(set, options, 1);
  const LargestErrors errors = largest_errors(pack, set);
  fmt::print("| {} | {} | {} | {} | {:.1f} | {:.1f} | {:.1f} |\n", colors, name, tile_count(set.tiles),
             texels_stored(pack), errors.interior, errors.edge, errors.corner);
}

TileSet synthesized(const SampleMap& sample, Coloring coloring, Construction interior, int colors,
                    int tile_side) {
  SynthOptions options;
  options.tile_size = {tile_side, tile_side};
  options.coloring = coloring;
  options.colors = coloring == Coloring::edge ? ColorCounts{colors, colors, 0} : ColorCounts{0, 0, colors};
  options.interior = interior;
  options.effort = 1;
  options.seed = 1;
  return assembled(synthesize(std::span(&sample, 1), options), std::span(&sample, 1));
}

} // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    fmt::print(stderr, "usage: bench_layout_error SAMPLE [TILE_SIDE]\n");
    return 1;
  }
  try {
    const int side = argc > 2 ? std::atoi(argv[2]) : 64;
    ImageFile file = read_image(argv[1]);
    const SampleMap sample{"color", Role::color, file.encoding, file.depth, std::move(file.image)};
    fmt::print(
        "| colors | layout | tiles | texels | interior | edge | corner |\n|---|---|---|---|---|---|---|\n");
    for (const int colors : {2, 3, 4}) {
      PackingOptions options;
      options.virtual_size = {cells, cells};
      options.mapping = MappingKind::mix;
      // Quilted tiles leave their corners free; those with an inside of their own share one corner patch.
      const TileSet quilted = synthesized(sample, Coloring::edge, Construction::quilt, colors, side);
      const TileSet edges = synthesized(sample, Coloring::edge, Construction::framed, colors, side);
      print_row(colors, "tile-index, quilted", quilted, options);
      options.corner_pack = true;
      print_row(colors, "tile-index, quilted, and corner pack", quilted, options);
      options.corner_pack = false;
      print_row(colors, "tile-index, one corner patch", edges, options);
      options.layout = LayoutKind::array;
      options.array.border = 1;
      print_row(colors, "array, quilted, border 1", quilted, options);
      options.array.border = 0;
      options.layout = LayoutKind::de_bruijn;
      print_row(colors, "de-bruijn, corner colors",
                synthesized(sample, Coloring::corner, Construction::framed, colors, side), options);
      options.layout = LayoutKind::rotated;
      options.mapping = MappingKind::index;
      const TileSet few = subset(edges, sequential_edge_set(colors, colors));
      options.rotated.scheme = RotatedScheme{colors, colors, 1};
      print_row(colors, fmt::format("rotated {}, matching", formula(*options.rotated.scheme)), few, options);
      options.rotated.gutter = 2;
      print_row(colors, fmt::format("rotated {}, gutter 2", formula(*options.rotated.scheme)), few, options);
      options.rotated.gutter.reset();
      options.rotated.scheme.reset();
      print_row(colors, "rotated, best plan", few, options);
    }
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench_layout_error: {}\n", error.what());
    return 1;
  }
  return 0;
}
