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

struct Found {
  double across = 0;
  std::int64_t pairs = 0;
  std::vector<BorderStep> worst;
};

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
    const Side facing = side == Side::east ? Side::west : Side::north;
    std::vector<Inside> inside(tiles.size());
    std::vector<std::vector<float>> leaving(tiles.size());
    std::vector<std::vector<float>> entering(tiles.size());
    std::map<int, std::vector<int>> by_key;
    tbb::parallel_for(std::size_t{0}, tiles.size(), [&](std::size_t i) {
      const Rect whole{0, 0, tiles[i].width(), tiles[i].height()};
      inside[i] = inside_steps(tiles[i], side);
      leaving[i] = values_of(tiles[i], whole, {side, 1, 0});
      entering[i] = values_of(tiles[i], whole, {facing, 1, 0});
    });
    for (int i = 0; i < static_cast<int>(tiles.size()); ++i) {
      by_key[border_key(pack.tiles, pack.colors, i, facing)].push_back(i);
      within += inside[i].sum;
      steps_within += inside[i].count;
    }
    std::vector<Found> found(tiles.size());
    tbb::parallel_for(0, static_cast<int>(tiles.size()), [&](int i) {
      const auto neighbours = by_key.find(border_key(pack.tiles, pack.colors, i, side));
      if (neighbours == by_key.end()) return;
      Found& mine = found[i];
      for (const int j : neighbours->second) {
        Measured pair =
            measured(leaving[i], entering[j], channels, (inside[i].mean() + inside[j].mean()) / 2);
        pair.border.tile = i;
        pair.border.side = side;
        pair.border.neighbour = j;
        mine.across += pair.across;
        ++mine.pairs;
        mine.worst.push_back(pair.border);
      }
      std::sort(mine.worst.begin(), mine.worst.end(), worse);
      if (mine.worst.size() > kept) mine.worst.resize(kept);
    });
    for (const Found& some : found) {
      across += some.across;
      figures.pairs += some.pairs;
      figures.worst.insert(figures.worst.end(), some.worst.begin(), some.worst.end());
    }
  }
  std::sort(figures.worst.begin(), figures.worst.end(), worse);
  if (figures.worst.size() > kept) figures.worst.resize(kept);
  if (figures.pairs > 0)
    figures.seam = ratio_of(across / static_cast<double>(figures.pairs),
                            steps_within > 0 ? within / static_cast<double>(steps_within) : 0);
  return figures;
}

} // namespace tilepack
