#include "tilepack/measure/seams.h"

#include "tilepack/layout/place_tiles.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace tilepack {
namespace {

double step(std::span<const float> a, std::span<const float> b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    sum += std::abs(static_cast<double>(a[i]) - static_cast<double>(b[i]));
  return sum;
}

struct Inside {
  double sum = 0; // of steps, over texels and channels
  std::int64_t count = 0;
  double mean() const { return count > 0 ? sum / static_cast<double>(count) : 0; }
};

Inside inside_steps(const Image& tile, Side side) {
  Inside inside;
  const int wide = side == Side::east ? tile.width() - 1 : tile.width();
  const int high = side == Side::east ? tile.height() : tile.height() - 1;
  for (int y = 0; y < high; ++y)
    for (int x = 0; x < wide; ++x)
      inside.sum += step(tile.texel(x, y), side == Side::east ? tile.texel(x + 1, y) : tile.texel(x, y + 1));
  inside.count = static_cast<std::int64_t>(wide) * high * tile.channels();
  return inside;
}

// A pair without any texture inside: a flat border is right, any step is wrong without measure.
double ratio_of(double across, double inside) {
  constexpr double largest = 1e6;
  if (inside > 0) return std::min(largest, across / inside);
  return across > 0 ? largest : 1;
}

struct Measured {
  BorderStep border;
  double across = 0; // mean step
};

Measured measured(const std::vector<float>& here, const std::vector<float>& there, std::size_t channels,
                  double inside) {
  Measured result;
  const std::size_t texels = here.size() / channels;
  std::vector<double> steps(texels);
  for (std::size_t i = 0; i < texels; ++i)
    steps[i] = step(std::span(here).subspan(i * channels, channels),
                    std::span(there).subspan(i * channels, channels)) /
               static_cast<double>(channels);
  double sum = 0;
  for (const double s : steps) sum += s;
  result.across = sum / static_cast<double>(texels);
  result.border.ratio = ratio_of(result.across, inside);
  const std::size_t window = std::min<std::size_t>(seam_window, texels);
  double run = 0;
  double worst = -1;
  for (std::size_t i = 0; i < texels; ++i) {
    run += steps[i];
    if (i >= window) run -= steps[i - window];
    if (i + 1 >= window && run > worst) {
      worst = run;
      result.border.window_at = static_cast<int>(i + 1 - window);
    }
  }
  result.border.window = ratio_of(std::max(0.0, worst) / static_cast<double>(window), inside);
  return result;
}

bool worse(const BorderStep& a, const BorderStep& b) {
  if (a.window != b.window) return a.window > b.window;
  return std::tuple(a.tile, a.side, a.neighbour) < std::tuple(b.tile, b.side, b.neighbour);
}

// What one axis needs of each tile: steps inside it, and the texels by which it meets its neighbours.
struct TileSides {
  std::vector<Inside> inside;
  std::vector<std::vector<float>> leaving;  // on `side`
  std::vector<std::vector<float>> entering; // on the side that faces it
};

Side facing(Side side) {
  return side == Side::east ? Side::west : Side::north;
}

TileSides sides_of(const std::vector<Image>& tiles, Side side) {
  TileSides sides{std::vector<Inside>(tiles.size()), std::vector<std::vector<float>>(tiles.size()),
                  std::vector<std::vector<float>>(tiles.size())};
  tbb::parallel_for(std::size_t{0}, tiles.size(), [&](std::size_t i) {
    const Rect whole{0, 0, tiles[i].width(), tiles[i].height()};
    sides.inside[i] = inside_steps(tiles[i], side);
    sides.leaving[i] = values_of(tiles[i], whole, {side, 1, 0});
    sides.entering[i] = values_of(tiles[i], whole, {facing(side), 1, 0});
  });
  return sides;
}

// All tiles by the color of the side that faces `side`.
std::map<int, std::vector<int>> tiles_by_facing_color(const Pack& pack, Side side) {
  std::map<int, std::vector<int>> tiles;
  for (int i = 0; i < tile_count(pack.tiles); ++i)
    tiles[border_key(pack.tiles, i, facing(side))].push_back(i);
  return tiles;
}

void keep_worst(std::vector<BorderStep>& list, std::size_t most) {
  std::sort(list.begin(), list.end(), worse);
  if (list.size() > most) list.resize(most);
}

struct Found {
  double across = 0;
  std::int64_t pairs = 0;
  std::vector<BorderStep> worst;
};

// Every pair that tile `i` begins.
Found pairs_of(int i, Side side, const TileSides& sides, const std::vector<int>& neighbours,
               std::size_t channels, std::size_t kept) {
  Found found;
  for (const int j : neighbours) {
    Measured pair = measured(sides.leaving[i], sides.entering[j], channels,
                             (sides.inside[i].mean() + sides.inside[j].mean()) / 2);
    pair.border.tile = i;
    pair.border.side = side;
    pair.border.neighbour = j;
    found.across += pair.across;
    ++found.pairs;
    found.worst.push_back(pair.border);
  }
  keep_worst(found.worst, kept);
  return found;
}

} // namespace

SeamFigures seam_figures(const Pack& pack, int map, int level, int list) {
  const Image& image = pack.maps[static_cast<std::size_t>(map)].levels[static_cast<std::size_t>(level)];
  const std::vector<Image> tiles = tiles_at_level(image, pack.layout, pack.tile_size, level);
  const auto channels = static_cast<std::size_t>(image.channels());
  const auto kept = static_cast<std::size_t>(std::max(0, list));
  SeamFigures figures;
  double across = 0;
  double within = 0;
  std::int64_t steps_within = 0;
  for (const Side side : {Side::east, Side::south}) {
    const TileSides sides = sides_of(tiles, side);
    for (const Inside& inside : sides.inside) {
      within += inside.sum;
      steps_within += inside.count;
    }
    const auto by_color = tiles_by_facing_color(pack, side);
    std::vector<Found> found(tiles.size());
    tbb::parallel_for(0, static_cast<int>(tiles.size()), [&](int i) {
      const auto neighbours = by_color.find(border_key(pack.tiles, i, side));
      if (neighbours != by_color.end())
        found[i] = pairs_of(i, side, sides, neighbours->second, channels, kept);
    });
    for (const Found& some : found) {
      across += some.across;
      figures.pairs += some.pairs;
      figures.worst.insert(figures.worst.end(), some.worst.begin(), some.worst.end());
    }
  }
  keep_worst(figures.worst, kept);
  if (figures.pairs > 0)
    figures.seam = ratio_of(across / static_cast<double>(figures.pairs),
                            steps_within > 0 ? within / static_cast<double>(steps_within) : 0);
  return figures;
}

} // namespace tilepack
