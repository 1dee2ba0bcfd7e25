#include "tilepack/synth/set_report.h"

#include "tilepack/numeric/side_by_side.h"
#include "tilepack/seam/source_canvas.h"
#include "tilepack/tileset/border_colors.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace tilepack {
namespace {

constexpr int whole_side = 8;
constexpr int cell_side = 16;

double rounded(double value) {
  return std::round(value * 1e4) / 1e4;
}

std::size_t at(int x, int y, int width) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
}

bool joined(SourceTexel p, SourceTexel q, int dx, int dy) {
  return q.x == p.x + dx && q.y == p.y + dy;
}

double visibility_of(std::int64_t cost, int channels) {
  return std::sqrt(static_cast<double>(cost) / (2.0 * channels));
}

double mean_of(const std::vector<double>& values) {
  return values.empty()
             ? 0.0
             : std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double p95_of(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto place = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) * 19 / 20);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

double step_of_sample(const FeatureImage& image) {
  const int stride = 1 + image.height / 1024; // rows of larger samples are as good as all of them
  double sum = 0.0;
  std::int64_t count = 0;
  for (int y = 0; y < image.height; y += stride)
    for (int x = 0; x < image.width; ++x) {
      const auto add = [&](const std::uint8_t* other) {
        sum += std::sqrt(static_cast<double>(squared_difference(image.texel(x, y), other, image.channels)) /
                         image.channels);
        ++count;
      };
      if (x + 1 < image.width) add(image.texel(x + 1, y));
      if (y + 1 < image.height) add(image.texel(x, y + 1));
    }
  return count > 0 ? sum / static_cast<double>(count) : 0.0;
}

// Texels that no whole 8 x 8 square covers. side[p] is that of the largest whole square whose south-east
// texel is p.
int texels_in_pieces(const std::vector<SourceTexel>& texels, Size size) {
  const int w = size.width;
  const int h = size.height;
  std::vector<int> side(texels.size(), 1);
  // Squares as marks at their corners, which a running sum turns into how many cover a texel.
  const int stride = w + 1;
  std::vector<int> marks(static_cast<std::size_t>(stride) * static_cast<std::size_t>(h + 1));
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      const std::size_t p = at(x, y, w);
      if (x > 0 && y > 0 && joined(texels[p - 1], texels[p], 1, 0) &&
          joined(texels[at(x, y - 1, w)], texels[p], 0, 1) &&
          joined(texels[at(x - 1, y - 1, w)], texels[p], 1, 1))
        side[p] = 1 + std::min({side[p - 1], side[at(x, y - 1, w)], side[at(x - 1, y - 1, w)]});
      if (side[p] < whole_side) continue;
      const int west = x + 1 - whole_side;
      const int north = y + 1 - whole_side;
      ++marks[at(west, north, stride)];
      --marks[at(x + 1, north, stride)];
      --marks[at(west, y + 1, stride)];
      ++marks[at(x + 1, y + 1, stride)];
    }
  int uncovered = 0;
  std::vector<int> above(static_cast<std::size_t>(stride));
  for (int y = 0; y < h; ++y) {
    int run = 0;
    for (int x = 0; x < w; ++x) {
      run += marks[at(x, y, stride)];
      above[static_cast<std::size_t>(x)] += run;
      uncovered += above[static_cast<std::size_t>(x)] == 0;
    }
  }
  return uncovered;
}

// Where the sample repeats, texels beyond it are its own.
std::size_t place_of(SourceTexel from, Size sample) {
  return at(from.x % sample.width, from.y % sample.height, sample.width);
}

// What is known of the texels of a sample, as often as it is shown beside itself.
std::vector<int> repeated(const std::vector<int>& values, Size sample, Size whole) {
  std::vector<int> result;
  result.reserve(static_cast<std::size_t>(whole.width) * static_cast<std::size_t>(whole.height));
  for (int y = 0; y < whole.height; ++y)
    for (int x = 0; x < whole.width; ++x) result.push_back(values[place_of({x, y}, sample)]);
  return result;
}

// How often each texel of the sample is shown, tiles counted as often as they show it.
std::vector<int> uses_of(const SourceMap& sources, Size sample) {
  std::vector<int> uses(static_cast<std::size_t>(sample.width) * static_cast<std::size_t>(sample.height));
  for (const auto& texels : sources.texels)
    for (const SourceTexel& from : texels) ++uses[place_of(from, sample)];
  return uses;
}

double coverage_of(const std::vector<int>& uses, Size sample) {
  int cells = 0;
  int shown = 0;
  const int wide = std::max(1, sample.width / cell_side);
  const int high = std::max(1, sample.height / cell_side);
  for (int j = 0; j < high; ++j)
    for (int i = 0; i < wide; ++i, ++cells) {
      const int x1 = std::min(sample.width, (i + 1) * cell_side);
      const int y1 = std::min(sample.height, (j + 1) * cell_side);
      int texels = 0;
      int used = 0;
      for (int y = j * cell_side; y < y1; ++y)
        for (int x = i * cell_side; x < x1; ++x, ++texels) used += uses[at(x, y, sample.width)] > 0;
      shown += 4 * used >= texels;
    }
  return static_cast<double>(shown) / cells;
}

// What tiles show at one place of a border: sources, each with the number of tiles.
using Shown = std::vector<std::pair<SourceTexel, int>>;

void count(Shown& shown, SourceTexel from) {
  for (auto& [known, tiles] : shown)
    if (known == from) {
      ++tiles;
      return;
    }
  shown.emplace_back(from, 1);
}

// Tiles meet if the colors of a border agree, so all pairs of what is shown on its two sides are met. Without
// corner colors these are many only round corners, for the rest of a border is the same in all tiles.
double mean_across_borders(const FeatureImage& image, const SourceMap& sources) {
  const int w = sources.tile_size.width;
  const int h = sources.tile_size.height;
  const std::vector<BorderColors> colors = border_colors(sources.tiles);
  double sum = 0.0;
  double pairs = 0.0;
  for (const bool south : {false, true}) {
    std::map<std::pair<int, int>, std::pair<Shown, Shown>> met; // (color, place) → this side, the other
    for (std::size_t t = 0; t < sources.texels.size(); ++t)
      for (int i = 0; i < (south ? w : h); ++i) {
        const std::size_t last = south ? at(i, h - 1, w) : at(w - 1, i, w);
        const std::size_t first = south ? at(i, 0, w) : at(0, i, w);
        count(met[{south ? colors[t].south : colors[t].east, i}].first, sources.texels[t][last]);
        count(met[{south ? colors[t].north : colors[t].west, i}].second, sources.texels[t][first]);
      }
    for (const auto& [place, sides] : met)
      for (const auto& [p, p_tiles] : sides.first)
        for (const auto& [q, q_tiles] : sides.second) {
          const double meetings = static_cast<double>(p_tiles) * q_tiles;
          sum +=
              meetings * visibility_of(seam_cost(image, p, q, south ? 0 : 1, south ? 1 : 0), image.channels);
          pairs += meetings;
        }
  }
  return pairs > 0 ? sum / pairs : 0.0;
}

// In blocks of 4 x 4 texels, about what SampleStatistics resolves.
double distance_of(Size sample, const SampleStatistics& statistics, const std::vector<int>& uses) {
  constexpr int block = 4;
  SampleStatistics::Tally tally = statistics.empty();
  for (int y = 0; y < sample.height; y += block)
    for (int x = 0; x < sample.width; x += block) {
      int count = 0;
      for (int j = y; j < std::min(sample.height, y + block); ++j)
        for (int i = x; i < std::min(sample.width, x + block); ++i) count += uses[at(i, j, sample.width)];
      if (count > 0) statistics.add(tally, {x, y, block, block}, count);
    }
  return std::sqrt(statistics.distance(tally));
}

} // namespace

std::vector<Cut> cuts_of_tile(const FeatureImage& image, const SourceMap& sources, int tile) {
  const std::vector<SourceTexel>& texels = sources.texels[static_cast<std::size_t>(tile)];
  const int w = sources.tile_size.width;
  std::vector<Cut> cuts;
  const auto look = [&](int x, int y, int dx, int dy) {
    const SourceTexel p = texels[at(x, y, w)];
    const SourceTexel q = texels[at(x + dx, y + dy, w)];
    if (!joined(p, q, dx, dy))
      cuts.push_back({x, y, dy == 1, visibility_of(seam_cost(image, p, q, dx, dy), image.channels)});
  };
  for (int y = 0; y < sources.tile_size.height; ++y)
    for (int x = 0; x < w; ++x) {
      if (x + 1 < w) look(x, y, 1, 0);
      if (y + 1 < sources.tile_size.height) look(x, y, 0, 1);
    }
  return cuts;
}

std::vector<int> tiles_showing(const SourceMap& sources, Size sample) {
  const std::size_t count = static_cast<std::size_t>(sample.width) * static_cast<std::size_t>(sample.height);
  std::vector<int> showing(count);
  std::vector<bool> counted; // for the tile at hand
  for (const auto& texels : sources.texels) {
    counted.assign(count, false);
    for (const SourceTexel& from : texels) {
      const std::size_t p = place_of(from, sample);
      if (counted[p]) continue;
      counted[p] = true;
      ++showing[p];
    }
  }
  return showing;
}

std::vector<int> pieces_of_tile(const SourceMap& sources, int tile) {
  const std::vector<SourceTexel>& texels = sources.texels[static_cast<std::size_t>(tile)];
  const int w = sources.tile_size.width;
  const int h = sources.tile_size.height;
  std::vector<int> piece(texels.size(), -1);
  std::vector<int> open;
  int next = 0;
  for (std::size_t start = 0; start < texels.size(); ++start) {
    if (piece[start] >= 0) continue;
    piece[start] = next;
    open.assign(1, static_cast<int>(start));
    while (!open.empty()) {
      const int p = open.back();
      open.pop_back();
      const int x = p % w;
      const int y = p / w;
      const auto visit = [&](int dx, int dy) {
        if (x + dx < 0 || x + dx >= w || y + dy < 0 || y + dy >= h) return;
        const std::size_t q = at(x + dx, y + dy, w);
        if (piece[q] >= 0 || !joined(texels[static_cast<std::size_t>(p)], texels[q], dx, dy)) return;
        piece[q] = next;
        open.push_back(static_cast<int>(q));
      };
      visit(1, 0);
      visit(-1, 0);
      visit(0, 1);
      visit(0, -1);
    }
    ++next;
  }
  return piece;
}

SetReport set_report(const SampleAnalysis& analysed, const SourceMap& sources, Size repeat) {
  const FeatureImage& image = analysed.features;
  const Size whole{image.width, image.height};
  const Size sample = repeat.width > 0 ? repeat : whole;
  const std::size_t tiles = sources.texels.size();
  const double tile_texels =
      static_cast<double>(sources.tile_size.width) * static_cast<double>(sources.tile_size.height);
  SetReport report;
  report.tiles.resize(tiles);
  std::vector<std::vector<double>> visibilities(tiles);
  std::vector<std::int64_t> often(tiles);
  std::vector<int> showing = tiles_showing(sources, sample);
  tbb::parallel_for(std::size_t{0}, tiles, [&](std::size_t t) {
    TileFigures& tile = report.tiles[t];
    for (const Cut& cut : cuts_of_tile(image, sources, static_cast<int>(t)))
      visibilities[t].push_back(cut.visibility);
    tile.cut_length = static_cast<int>(visibilities[t].size());
    tile.cut_mean = rounded(mean_of(visibilities[t]));
    tile.cut_p95 = rounded(p95_of(visibilities[t]));
    tile.in_pieces = rounded(texels_in_pieces(sources.texels[t], sources.tile_size) / tile_texels);
    int alone = 0;
    for (const SourceTexel& from : sources.texels[t]) {
      const int shown = showing[place_of(from, sample)];
      alone += shown == 1;
      often[t] += 2 * static_cast<std::size_t>(shown) >= tiles;
    }
    tile.fresh = rounded(alone / tile_texels);
  });

  if (sample != whole) showing = repeated(showing, sample, whole);
  report.landmark = most_seen(analysed.saliency, whole, showing, tiles);
  showing = {}; // of a large sample as large as what follows
  const std::vector<int> uses = uses_of(sources, sample);

  std::vector<double> all;
  for (const auto& some : visibilities) all.insert(all.end(), some.begin(), some.end());
  SetFigures& f = report.figures;
  const double tile_number = static_cast<double>(tiles);
  f.cut_length = rounded(static_cast<double>(all.size()) / tile_number);
  f.cut_mean = rounded(mean_of(all));
  f.cut_p95 = rounded(p95_of(std::move(all)));
  both_side_by_side(
      [&] {
        f.border_mean = rounded(mean_across_borders(image, sources));
        f.sample_step = rounded(step_of_sample(image));
        report.tones = tone_breaks(image, sources);
      },
      [&] { f.histogram_distance = rounded(distance_of(sample, analysed.statistics, uses)); });
  for (const TileFigures& tile : report.tiles) {
    f.in_pieces += tile.in_pieces / tile_number;
    f.fresh += tile.fresh / tile_number;
  }
  f.in_pieces = rounded(f.in_pieces);
  f.fresh = rounded(f.fresh);
  f.shown_often = rounded(static_cast<double>(std::accumulate(often.begin(), often.end(), std::int64_t{0})) /
                          (tile_texels * tile_number));
  double squares = 0.0;
  for (const int n : uses) squares += static_cast<double>(n) * n;
  f.distinct_tiles = rounded(tile_texels * tile_number * tile_number / squares);
  f.coverage = rounded(coverage_of(uses, sample));
  return report;
}

} // namespace tilepack
