#include "tilepack/transition/transition_set.h"

#include "tilepack/numeric/random.h"
#include "tilepack/numeric/side_by_side.h"
#include "tilepack/seam/label_cut.h"
#include "tilepack/synth/synthesize.h"
#include "tilepack/transition/transition_field.h"
#include "tilepack/transition/transition_guide.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace tilepack {
namespace {

// All of these were set by looking at six pairs of photos: pebbles and sand, grass and gravel, a stone wall and moss,
// leaves and cracked mud, bricks and moss. None is derived.

// Of the field: how far its noise moves borders, in weights, and the longer of its waves, as a share of a tile's side.
constexpr double field_roughness = 0.40;
constexpr double wave_of_tile = 0.40;

// By how much of a weight what stands keeps out another material.
constexpr double standing_weight = 0.30;

// How strongly the field holds borders in their place against what they cost there. The larger things are, the less: a
// border has to leave its place to go round them. Times a tile's side over the square of a thing's width.
constexpr double pull_of_thing = 5.0;
constexpr double least_pull = 0.25, most_pull = 1.2;

// Shares of a tile's side: round lattice points only their own material is seen, and so far to either side of an edge
// tiles lean to what is seen along it, next to it by this much of TransitionGuide::border_unit.
constexpr double corner_share = 0.10;
constexpr double edge_window_share = 0.25;
constexpr double side_bond = 1.0;

// Places for borders to cross an edge that are tried, in shares of its length from its middle, and how many pairs of
// tiles are looked at.
constexpr std::array edge_shifts{0.0, -0.07, 0.07, -0.14, 0.14};
constexpr int edge_looks = 6;

// What a texel of border costs is shared by the pairs of neighbours that it parts: of a border along an axis one
// beside it and two diagonal ones.
constexpr std::int64_t straight_share = 106, diagonal_share = 75; // of 256; 1 to the root of 2

using Layers = std::vector<SourceMap>;

struct TransitionWork {
  const JoinedSamples& joined;
  const TransitionGuide& guide;
  const Layers& layers;
  std::vector<CornerTile> tiles;
  TransitionField field;
  Size tile;
  ColorCounts colors;
  int materials;
  int guard;
  double pull;
  int takes; // of each tile, the best of which is kept

  int material_of(int color) const { return color / (colors.corner / materials); }
  int variant_of(std::size_t id) const {
    return static_cast<int>(id / static_cast<std::size_t>(combinations(colors)));
  }
  // The tile of a material's own set below a tile of the transition.
  std::size_t layer_tile(std::size_t id, int material) const {
    const CornerTile& c = tiles[id];
    const int own_colors = colors.corner / materials;
    const auto own = [&](int color) { // 0: another material
      return material_of(color) == material ? 1 + color % own_colors : 0;
    };
    return static_cast<std::size_t>(
        variant_of(id) * combinations({0, 0, own_colors + 1}) +
        id_in_complete_set({own(c.nw), own(c.ne), own(c.sw), own(c.se)}, own_colors + 1));
  }
  // What a tile's layer shows at a texel, of the joined sample.
  SourceTexel shown(std::size_t id, int material, int x, int y) const {
    const std::size_t own = layer_tile(id, material);
    const SourceTexel s =
        layers[static_cast<std::size_t>(material)]
            .texels[own][static_cast<std::size_t>(y) * static_cast<std::size_t>(tile.width) +
                         static_cast<std::size_t>(x)];
    const Rect& place = joined.places[static_cast<std::size_t>(material)];
    return {s.x + place.x, s.y + place.y};
  }
  std::int64_t price(double weight, SourceTexel s) const {
    const double standing = guide.standing.at(s.x, s.y) / 127.0;
    return std::llround(TransitionGuide::border_unit * pull * (2 - weight - standing_weight * standing));
  }
  bool near_corner(int along, int across, int length) const {
    const double reach = std::max<double>(guard + 1, corner_share * std::min(tile.width, tile.height));
    const double a = std::min(along, length - 1 - along) + 0.5;
    return a * a + across * across < reach * reach;
  }
};

// Sheets of a window, label by label: what each would show.
struct Sheets {
  std::vector<int> materials; // of the labels
  std::vector<SourceCanvas> canvases;
};

// What it costs that neighbours show two sheets.
std::int64_t sheets_border(const TransitionGuide& guide, const Sheets& sheets, int x, int y, int dx, int dy,
                           int a, int b) {
  const SourceCanvas& at_p = sheets.canvases[static_cast<std::size_t>(a)];
  const SourceCanvas& at_q = sheets.canvases[static_cast<std::size_t>(b)];
  const std::int64_t cost =
      guide.border_cost(at_p.at(x, y), at_p.at(x + dx, y + dy), at_q.at(x + dx, y + dy), at_q.at(x, y));
  return dx != 0 && dy != 0 ? cost * diagonal_share / 256 : cost * straight_share / 256;
}

std::vector<int> materials_of(const TransitionWork& work, const CornerTile& c) {
  std::vector<int> list{work.material_of(c.nw), work.material_of(c.ne), work.material_of(c.sw),
                        work.material_of(c.se)};
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
  return list;
}

// Which material is seen along an edge, to `reach` texels on both its sides: rows of the edge's length, north or west
// first. In the guard that holds in all tiles; further off tiles keep to it the less, the further.
struct EdgeBand {
  int reach = 0;
  Grid<std::uint8_t> seen;
  double shift = 0;
};

using EdgeBands =
    std::array<std::vector<EdgeBand>, 2>; // of vertical and horizontal edges, by first * colors + second

// What borders cost, by pair of neighbours that they part: little where they run round things, however long.
double mean_border_cost(const LabelProblem& problem, const Grid<std::uint8_t>& labels) {
  std::int64_t cost = 0;
  std::int64_t pairs = 0;
  const auto add = [&](int x, int y, int dx, int dy) {
    if (labels.at(x, y) == labels.at(x + dx, y + dy)) return;
    cost += problem.border(x, y, dx, dy, labels.at(x, y), labels.at(x + dx, y + dy));
    ++pairs;
  };
  for (int y = 0; y + 1 < labels.height; ++y)
    for (int x = 0; x + 1 < labels.width; ++x) {
      add(x, y, 1, 0);
      add(x, y, 0, 1);
    }
  return pairs > 0 ? static_cast<double>(cost) / static_cast<double>(pairs) : 0.0;
}

EdgeBand edge_band(const TransitionWork& work, bool horizontal, int first, int second) {
  const int length = horizontal ? work.tile.width : work.tile.height;
  const int depth = horizontal ? work.tile.height : work.tile.width;
  const int reach = std::clamp(static_cast<int>(depth * edge_window_share), work.guard + 1, depth / 2);
  EdgeBand band{reach,
                Grid<std::uint8_t>(length, 2 * reach, static_cast<std::uint8_t>(work.material_of(first)))};
  const int first_material = work.material_of(first);
  const int second_material = work.material_of(second);
  if (first_material == second_material) return band;

  // Tiles on both sides of the edge, some of all that may meet.
  std::vector<std::size_t> before, after;
  for (std::size_t id = 0; id < work.tiles.size(); ++id) {
    const CornerTile& c = work.tiles[id];
    if ((horizontal ? c.sw : c.ne) == first && c.se == second) before.push_back(id);
    if (c.nw == first && (horizontal ? c.ne : c.sw) == second) after.push_back(id);
  }
  std::vector<Sheets> looks(edge_looks);
  for (std::size_t g = 0; g < looks.size(); ++g) {
    const std::size_t north = before[(2 * g + 1) * before.size() / (2 * looks.size())];
    const std::size_t south = after[(2 * g + 1) * after.size() / (2 * looks.size())];
    looks[g].materials = {first_material, second_material};
    for (const int material : looks[g].materials) {
      SourceCanvas canvas(length, 2 * reach);
      for (int j = 0; j < 2 * reach; ++j)
        for (int i = 0; i < length; ++i) {
          const bool beyond = j >= reach;
          const int across = beyond ? j - reach : depth - reach + j;
          canvas.at(i, j) = horizontal ? work.shown(beyond ? south : north, material, i, across)
                                       : work.shown(beyond ? south : north, material, across, i);
        }
      looks[g].canvases.push_back(std::move(canvas));
    }
  }

  LabelProblem problem;
  problem.size = {length, 2 * reach};
  problem.labels = 2;
  problem.forced = Grid<std::int8_t>(problem.size, free_label);
  for (int j = 0; j < 2 * reach; ++j)
    for (int i = 0; i < length; ++i)
      if (work.near_corner(i, j < reach ? reach - 1 - j : j - reach, length))
        problem.forced.at(i, j) = i < length / 2 ? 0 : 1;
  problem.border = [&](int x, int y, int dx, int dy, int a, int b) {
    std::int64_t sum = 0;
    for (const Sheets& look : looks) sum += sheets_border(work.guide, look, x, y, dx, dy, a, b);
    return sum / edge_looks;
  };
  TransitionField field = work.field;
  double least = std::numeric_limits<double>::infinity();
  for (const double shift : edge_shifts) {
    field.set_shift(horizontal, first, second, shift);
    problem.prices.clear();
    for (int label = 0; label < 2; ++label)
      for (int j = 0; j < 2 * reach; ++j)
        for (int i = 0; i < length; ++i) {
          const double weight = field.edge_weight(
              horizontal, first, second, label == 0 ? first_material : second_material, i, j - reach);
          std::int64_t sum = 0;
          for (const Sheets& look : looks)
            sum += work.price(weight, look.canvases[static_cast<std::size_t>(label)].at(i, j));
          problem.prices.push_back(sum / edge_looks);
        }
    const Grid<std::uint8_t> labels = least_labels(problem);
    const double cost = mean_border_cost(problem, labels);
    if (!(cost < least)) continue;
    least = cost;
    band.shift = shift;
    for (std::size_t p = 0; p < labels.values.size(); ++p)
      band.seen.values[p] =
          static_cast<std::uint8_t>(labels.values[p] == 0 ? first_material : second_material);
  }
  return band;
}

// Settles where borders cross edges.
EdgeBands edge_bands(TransitionWork& work) {
  const auto pairs =
      static_cast<std::size_t>(work.colors.corner) * static_cast<std::size_t>(work.colors.corner);
  EdgeBands bands;
  for (auto& list : bands) list.resize(pairs);
  each_side_by_side(2 * pairs, [&](std::size_t i) {
    const int pair = static_cast<int>(i % pairs);
    bands[i / pairs][i % pairs] =
        edge_band(work, i / pairs == 1, pair / work.colors.corner, pair % work.colors.corner);
  });
  for (const bool horizontal : {false, true})
    for (int pair = 0; pair < static_cast<int>(pairs); ++pair)
      work.field.set_shift(horizontal, pair / work.colors.corner, pair % work.colors.corner,
                           bands[horizontal ? 1 : 0][static_cast<std::size_t>(pair)].shift);
  return bands;
}

// One side of a tile: which material is seen at a texel so far along it and so far from it.
struct SeenSide {
  const EdgeBand& band;
  bool inward_is_after; // the tile is the one south or east of the edge
  int seen(int along, int distance) const {
    return band.seen.at(along, inward_is_after ? band.reach + distance : band.reach - 1 - distance);
  }
};

class SeenSides {
public:
  SeenSides(const TransitionWork& transition_work, const EdgeBands& bands, const CornerTile& tile_corners)
      : work(transition_work),
        c(tile_corners), north{of(bands[1], c.nw, c.ne), true}, south{of(bands[1], c.sw, c.se), false},
        west{of(bands[0], c.nw, c.sw), true}, east{of(bands[0], c.ne, c.se), false} {}

  // The material that the tile must show at a texel, -1: any.
  int forced(int x, int y) const {
    const auto [to_north, to_south, to_west, to_east] = distances(x, y);
    const double reach =
        std::max<double>(work.guard + 1, corner_share * std::min(work.tile.width, work.tile.height));
    const double dx = std::min(to_west, to_east) + 0.5;
    const double dy = std::min(to_north, to_south) + 0.5;
    if (dx * dx + dy * dy < reach * reach)
      return work.material_of(to_north <= to_south ? (to_west <= to_east ? c.nw : c.ne)
                                                   : (to_west <= to_east ? c.sw : c.se));
    if (to_north < work.guard) return north.seen(x, to_north);
    if (to_south < work.guard) return south.seen(x, to_south);
    if (to_west < work.guard) return west.seen(y, to_west);
    if (to_east < work.guard) return east.seen(y, to_east);
    return -1;
  }

  // What it costs to show a material where others are seen along the sides.
  std::int64_t bond(int material, int x, int y) const {
    const auto [to_north, to_south, to_west, to_east] = distances(x, y);
    double sum = 0;
    const auto add = [&](const SeenSide& side, int along, int distance) {
      if (distance >= side.band.reach || side.seen(along, distance) == material) return;
      const double near = 1 - static_cast<double>(distance) / side.band.reach;
      sum += near * near;
    };
    add(north, x, to_north);
    add(south, x, to_south);
    add(west, y, to_west);
    add(east, y, to_east);
    return std::llround(TransitionGuide::border_unit * side_bond * sum);
  }

private:
  const EdgeBand& of(const std::vector<EdgeBand>& list, int first, int second) const {
    return list[static_cast<std::size_t>(first * work.colors.corner + second)];
  }
  std::array<int, 4> distances(int x, int y) const {
    return {y, work.tile.height - 1 - y, x, work.tile.width - 1 - x};
  }

  const TransitionWork& work;
  CornerTile c;
  SeenSide north, south, west, east;
};

std::vector<SourceTexel> transition_tile(const TransitionWork& work, const EdgeBands& bands, std::size_t id) {
  const CornerTile& c = work.tiles[id];
  const Size size = work.tile;
  Sheets sheets;
  sheets.materials = materials_of(work, c);
  for (const int material : sheets.materials) {
    SourceCanvas canvas(size.width, size.height);
    for (int y = 0; y < size.height; ++y)
      for (int x = 0; x < size.width; ++x) canvas.at(x, y) = work.shown(id, material, x, y);
    sheets.canvases.push_back(std::move(canvas));
  }
  if (sheets.materials.size() == 1) return std::move(sheets.canvases.front().texels);
  const SeenSides sides(work, bands, c);
  LabelProblem problem;
  problem.size = size;
  problem.labels = static_cast<int>(sheets.materials.size());
  problem.forced = Grid<std::int8_t>(size, free_label);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const int material = sides.forced(x, y);
      if (material < 0) continue;
      const auto found = std::find(sheets.materials.begin(), sheets.materials.end(), material);
      problem.forced.at(x, y) = static_cast<std::int8_t>(found - sheets.materials.begin());
    }
  problem.border = [&](int x, int y, int dx, int dy, int a, int b) {
    return sheets_border(work.guide, sheets, x, y, dx, dy, a, b);
  };
  Grid<std::uint8_t> labels;
  double least = std::numeric_limits<double>::infinity();
  for (int take = 0; take < work.takes; ++take) {
    problem.prices.clear();
    for (std::size_t label = 0; label < sheets.materials.size(); ++label)
      for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
          problem.prices.push_back(
              work.price(work.field.weight(c, work.variant_of(id), take, sheets.materials[label], x, y),
                         sheets.canvases[label].at(x, y)) +
              sides.bond(sheets.materials[label], x, y));
    Grid<std::uint8_t> taken = least_labels(problem);
    const double cost = mean_border_cost(problem, taken);
    if (!(cost < least)) continue;
    least = cost;
    labels = std::move(taken);
  }
  std::vector<SourceTexel> texels;
  texels.reserve(labels.values.size());
  for (std::size_t p = 0; p < labels.values.size(); ++p)
    texels.push_back(sheets.canvases[labels.values[p]].texels[p]);
  return texels;
}

Layers material_layers(std::span<const SampleAnalysis* const> materials, const SynthOptions& options,
                       const Progress& progress) {
  SynthOptions own = options;
  own.colors.corner = 1 + options.colors.corner / static_cast<int>(materials.size()); // 0: another is shown
  Layers layers;
  for (std::size_t m = 0; m < materials.size(); ++m) {
    own.seed = m == 0 ? options.seed : random_bits(options.seed, "layer", m);
    const Progress part = [&](std::string_view stage, double done) {
      report(progress, stage, (static_cast<double>(m) + done) / static_cast<double>(materials.size()));
    };
    layers.push_back(synthesize(*materials[m], own, part));
  }
  return layers;
}

TransitionWork transition_work(const JoinedSamples& joined, const TransitionGuide& guide,
                               const Layers& layers, const SynthOptions& options) {
  const Size tile = options.tile_size;
  const int materials = static_cast<int>(joined.places.size());
  const double side = std::min(tile.width, tile.height);
  return {joined,
          guide,
          layers,
          std::get<std::vector<CornerTile>>(complete_set(options.colors)),
          TransitionField(tile, options.colors.corner / materials, field_roughness, wave_of_tile * side,
                          options.seed),
          tile,
          options.colors,
          materials,
          std::max(1, options.guard),
          std::clamp(pull_of_thing * side / (guide.thing * guide.thing), least_pull, most_pull),
          options.effort < 2   ? 1
          : options.effort < 6 ? 3
                               : 6};
}

TransitionFigures figures_of(const TransitionWork& work, const SourceMap& sources) {
  const JoinedSamples& joined = work.joined;
  const TransitionGuide& guide = work.guide;
  constexpr int inside_from = 128; // of 255: half of structure_range texels from all outlines
  TransitionFigures figures;
  std::vector<std::int64_t> shown(joined.places.size());
  std::int64_t length = 0, through = 0, straight = 0, straight_through = 0;
  int mixed_tiles = 0;
  const int w = sources.tile_size.width;
  const int h = sources.tile_size.height;
  const auto& tiles = std::get<std::vector<CornerTile>>(sources.tiles);
  for (std::size_t id = 0; id < tiles.size(); ++id) {
    const auto& texels = sources.texels[id];
    for (const SourceTexel s : texels) ++shown[static_cast<std::size_t>(joined.material_at(s.x))];
    const CornerTile& c = tiles[id];
    if (materials_of(work, c).size() == 1) continue;
    ++mixed_tiles;
    const auto is_inside = [&](SourceTexel s) { return guide.inside.at(s.x, s.y) >= inside_from; };
    for (int y = 0; y < h; ++y)
      for (int x = 0; x < w; ++x) {
        const auto p =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(w) + static_cast<std::size_t>(x);
        const auto look = [&](std::size_t q) {
          if (joined.material_at(texels[p].x) == joined.material_at(texels[q].x)) return;
          ++length;
          through += is_inside(texels[p]) || is_inside(texels[q]);
        };
        if (x + 1 < w) look(p + 1);
        if (y + 1 < h) look(p + static_cast<std::size_t>(w));
        if (x == w / 2 || y == h / 2) {
          ++straight;
          straight_through += is_inside(texels[p]);
        }
      }
  }
  const auto share = [](std::int64_t part, std::int64_t whole) {
    return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : 0.0;
  };
  figures.border_length = share(length, mixed_tiles);
  figures.through_things = share(through, length);
  figures.expected = share(straight_through, straight);
  const std::int64_t all = static_cast<std::int64_t>(tiles.size()) * w * h;
  for (const std::int64_t count : shown) figures.shown.push_back(share(count, all));
  return figures;
}

} // namespace

TransitionSet transition_set(const JoinedSamples& joined, std::span<const SampleAnalysis* const> materials,
                             const SynthOptions& options, const Progress& progress) {
  TransitionSet set;
  set.layers = material_layers(materials, options, progress);
  report(progress, "transition", 0.0);
  const TransitionGuide guide = transition_guide(joined, materials);
  TransitionWork work = transition_work(joined, guide, set.layers, options);
  const EdgeBands bands = edge_bands(work);
  report(progress, "transition", 0.2);
  set.sources = SourceMap{options.tile_size, options.colors, complete_set(options.colors), {}, options.guard};
  set.sources.texels.resize(work.tiles.size());
  each_side_by_side(work.tiles.size(),
                    [&](std::size_t id) { set.sources.texels[id] = transition_tile(work, bands, id); });
  set.figures = figures_of(work, set.sources);
  report(progress, "transition", 1.0);
  return set;
}

} // namespace tilepack
