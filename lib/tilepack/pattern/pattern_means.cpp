#include "tilepack/pattern/pattern_means.h"

#include "tilepack/numeric/exact_math.h"
#include "tilepack/numeric/random.h"
#include "tilepack/pattern/areas.h"

#include <algorithm>
#include <cmath>

namespace tilepack {
namespace {

constexpr int samples_a_side = 8;
constexpr std::uint64_t cells_asked = 4096;

void add_share(std::vector<double>& shares, std::int64_t index, double weight) {
  const auto at = static_cast<std::size_t>(std::clamp<std::int64_t>(index, -1, 65535) + 1);
  if (shares.size() <= at) shares.resize(at + 1);
  shares[at] += weight;
}

// What a table makes of indices.
void add_table(std::vector<double>& out, const std::vector<double>& in, const std::vector<int>& entries,
               double weight) {
  for (std::size_t i = 0; i < in.size(); ++i)
    if (in[i] > 0) add_share(out, i == 0 ? -1 : entries[(i - 1) % entries.size()], weight * in[i]);
}

// The mean of several textures by their shares; shares[1 + i] is that of means[i], what else there is, is clear.
PatternMeans::Mean mixed(const std::vector<std::pair<double, PatternMeans::Mean>>& parts) {
  PatternMeans::Mean sum;
  for (const auto& [share, part] : parts) {
    sum.cover += share * part.cover;
    for (std::size_t c = 0; c < 4; ++c) sum.value[c] += share * part.cover * part.value[c];
  }
  for (double& value : sum.value) value = sum.cover > 0 ? value / sum.cover : 0;
  for (const auto& [share, part] : parts)
    for (std::size_t c = 0; c < 4 && sum.cover > 0; ++c) {
      const double away = part.value[c] - sum.value[c];
      sum.variance[c] += share * part.cover / sum.cover * (part.variance[c] + away * away);
    }
  return sum;
}

PatternMeans::Mean over(const PatternMeans::Mean& below, const PatternMeans::Mean& top) {
  PatternMeans::Mean clear_top = below;
  clear_top.cover *= 1 - top.cover;
  PatternMeans::Mean sum = mixed({{1, clear_top}, {1, top}});
  return sum;
}

} // namespace

struct PatternMeans::Region {
  PatternPlace place;
  double width_u = 0, width_v = 0;
};

// What doesn't depend on the place is found once.
struct PatternMeans::Cache {
  std::once_flag shares_flag, mean_flag, pyramid_flag, area_flag;
  std::vector<double> shares;
  Mean mean;
  std::unique_ptr<SharePyramid> pyramid;
  double area = 0;
  std::array<double, 65> free{}; ///< free_share() by cover
  std::atomic<std::size_t> bytes{0};
};

PatternMeans::PatternMeans(const PatternGraph& of_graph, const PatternValues& of_values, int of_map)
    : graph(of_graph), values(of_values), map(of_map),
      channels(graph.maps[static_cast<std::size_t>(map)].channels -
               (graph.maps[static_cast<std::size_t>(map)].has_alpha() ? 1 : 0)),
      caches(std::make_unique<Cache[]>(graph.nodes.size())) {}
PatternMeans::~PatternMeans() = default;

std::size_t PatternMeans::bytes() const {
  std::size_t sum = 0;
  for (std::size_t i = 0; i < graph.nodes.size(); ++i) sum += caches[i].bytes;
  return sum;
}

const SharePyramid& PatternMeans::pyramid(NodeId node, const StoredMap& of_map) const {
  Cache& cache = caches[static_cast<std::size_t>(node)];
  std::call_once(cache.pyramid_flag, [&] {
    cache.pyramid = std::make_unique<SharePyramid>(of_map);
    cache.bytes += cache.pyramid->bytes();
  });
  return *cache.pyramid;
}

// By asking at places all over the region.
std::vector<double> PatternMeans::sampled(NodeId node, const Region& region) const {
  std::vector<double> shares;
  for (int j = 0; j < samples_a_side; ++j)
    for (int i = 0; i < samples_a_side; ++i) {
      const auto along = [](int k, double width) { return ((k + 0.5) / samples_a_side - 0.5) * width; };
      const PatternPlace place{{region.place.u.tile, region.place.u.fraction + along(i, region.width_u)},
                               {region.place.v.tile, region.place.v.fraction + along(j, region.width_v)}};
      add_share(shares, values.index(node, place), 1.0 / (samples_a_side * samples_a_side));
    }
  return shares;
}

// By asking in cells all over the scene.
std::vector<double> PatternMeans::everywhere(NodeId node) const {
  std::vector<double> shares;
  const auto cell = [](std::int64_t cells, const char* axis, std::uint64_t k) {
    return static_cast<std::int64_t>(random_bits(0, axis, k) % static_cast<std::uint64_t>(cells));
  };
  const PatternGrid grid = values.has_grid(node)
                               ? PatternGrid{values.mapping(node).x.cells, values.mapping(node).y.cells}
                               : graph.scene;
  const TileMapping mapping(grid, graph.scene);
  for (std::uint64_t k = 0; k < cells_asked; ++k) {
    const PatternPlace place =
        mapping.centre_of(cell(grid.width, "mean x", k), cell(grid.height, "mean y", k));
    add_share(shares, values.index(node, place), 1.0 / cells_asked);
  }
  return shares;
}

// One function a kind of index whose shares are known better than by asking around.
struct PatternMeans::SharesOf {
  const PatternMeans& means;
  NodeId node;
  const Region& region;
  using Shares = std::vector<double>;

  Shares at(NodeId other) const { return means.shares(other, region.place, region.width_u, region.width_v); }

  template <typename Block>
  Shares operator()(const Block&) const {
    return means.values.stationary(node) ? means.everywhere(node) : means.sampled(node, region);
  }
  Shares operator()(const ConstantIndex& b) const {
    Shares shares;
    add_share(shares, b.value, 1);
    return shares;
  }
  Shares operator()(const RandomIndex& b) const {
    Shares shares(static_cast<std::size_t>(b.values) + 1, 1.0 / b.values);
    shares[0] = 0;
    return shares;
  }
  Shares operator()(const TableIndex& b) const {
    Shares shares;
    add_table(shares, at(b.index), b.entries, 1);
    return shares;
  }
  Shares operator()(const MaterialIndex& b) const {
    Shares shares;
    const Shares materials = at(b.material), indices = at(b.index);
    for (std::size_t m = 0; m < materials.size(); ++m) {
      if (!(materials[m] > 0)) continue;
      if (m == 0 || m > b.table.materials.size())
        add_share(shares, -1, materials[m]);
      else
        add_table(shares, indices, b.table.materials[m - 1], materials[m]);
    }
    return shares;
  }
  Shares operator()(const StoredIndex& b) const { return of_map(b, false); }
  Shares of_map(const StoredIndex& b, bool dithered) const {
    const SharePyramid& pyramid = means.pyramid(node, *b.map);
    if (!pyramid.built()) return means.sampled(node, region);
    Shares shares;
    const TileMapping& grid = means.values.mapping(node);
    const double width = std::max(region.width_u * grid.x.ratio(), region.width_v * grid.y.ratio());
    pyramid.add(grid.x.cell_of(region.place.u), grid.y.cell_of(region.place.v), width, dithered, 1, shares);
    return shares;
  }
  Shares operator()(const DitheredIndex& b) const { return interpolated(b.areas, b.coarse); }
  // Of an index that is interpolated between the centres of a grid.
  Shares interpolated(NodeId areas, PatternGrid grid) const {
    const auto* stored = std::get_if<StoredIndex>(&means.values.block(areas));
    if (stored != nullptr && stored->map->grid() == grid)
      return SharesOf{means, areas, region}.of_map(*stored, true);
    const TileMapping coarse(grid, means.graph.scene);
    if (std::max(region.width_u * coarse.x.ratio(), region.width_v * coarse.y.ratio()) > 1) return at(areas);
    const TileCoordinate u = coarse.x.cell_of(region.place.u), v = coarse.y.cell_of(region.place.v);
    const BetweenCentres x = between_centres(u.tile, u.fraction), y = between_centres(v.tile, v.fraction);
    Shares shares;
    for (int k = 0; k < 4; ++k)
      add_share(shares, means.values.index(areas, coarse.centre_of(x.first + k % 2, y.first + k / 2)),
                (k % 2 != 0 ? x.b : 1 - x.b) * (k / 2 != 0 ? y.b : 1 - y.b));
    return shares;
  }
  Shares operator()(const PixelIndex& b) const {
    const TileMapping& grid = means.values.mapping(node);
    const TileCoordinate u = grid.x.cell_of(region.place.u), v = grid.y.cell_of(region.place.v);
    const double width = std::max(region.width_u * grid.x.ratio(), region.width_v * grid.y.ratio());
    const LevelBlend blend = level_blend(width > 1 ? exact_log2(width) : 0, 40, Filter::trilinear);
    std::vector<double> of_material(static_cast<std::size_t>(b.map->materials()));
    const auto add_level = [&](int level, double weight) {
      const auto size = static_cast<double>(std::int64_t{1} << level);
      const auto between = [&](TileCoordinate c) {
        const double scaled = (static_cast<double>(c.tile) + c.fraction) / size;
        return between_centres(static_cast<std::int64_t>(std::floor(scaled)), scaled - std::floor(scaled));
      };
      const BetweenCentres x = between(u), y = between(v);
      for (int k = 0; k < 4; ++k)
        b.map->add_shares((x.first + k % 2) << level, (y.first + k / 2) << level, level,
                          weight * (k % 2 != 0 ? x.b : 1 - x.b) * (k / 2 != 0 ? y.b : 1 - y.b), of_material);
    };
    add_level(blend.fine, 1 - blend.coarse_weight);
    if (blend.coarse_weight > 0) add_level(blend.coarse, blend.coarse_weight);
    double sum = 0;
    for (const double share : of_material) sum += share; // less than 1 at the map's border
    Shares shares(of_material.size() + 1);
    for (std::size_t m = 0; m < of_material.size() && sum > 0; ++m) shares[m + 1] = of_material[m] / sum;
    return shares;
  }
};

const std::vector<double>& PatternMeans::kept_shares(NodeId node) const {
  Cache& cache = caches[static_cast<std::size_t>(node)];
  std::call_once(cache.shares_flag, [&] {
    cache.shares = std::visit(SharesOf{*this, node, Region{}}, values.block(node));
    cache.bytes += cache.shares.size() * sizeof(double);
  });
  return cache.shares;
}

std::vector<double> PatternMeans::shares(NodeId index, const PatternPlace& place, double width_u,
                                         double width_v) const {
  values.note(index);
  if (values.stationary(index)) return kept_shares(index);
  return std::visit(SharesOf{*this, index, Region{place, width_u, width_v}}, values.block(index));
}

namespace {

// The share of a plane that patterns leave free which lie anywhere in their cells, centres evenly spread, one a cell:
// squares of that area, each covering `cover` of its own. The mean over places of the product of what each leaves free.
double free_share(double area, double cover) {
  constexpr int places = 16;
  const double side = std::sqrt(area);
  const auto chance = [&](int k, double q) { // that the centre in cell k lies within half a side
    return std::max(0.0, std::min(q + side / 2, k + 1.0) - std::max(q - side / 2, static_cast<double>(k)));
  };
  double sum = 0;
  for (int j = 0; j < places; ++j)
    for (int i = 0; i < places; ++i) {
      double left = 1;
      for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x)
          left *= 1 - cover * chance(x, (i + 0.5) / places) * chance(y, (j + 0.5) / places);
      sum += left;
    }
  return sum / (places * places);
}

} // namespace

// How much of a cell its pattern covers, of which `cover` is opaque: by the mean of the squared scale.
double PatternMeans::covered(const PatternsTexture& b, NodeId node, double cover) const {
  if (b.fit == TransformFit::none) return cover;
  Cache& cache = caches[static_cast<std::size_t>(node)];
  std::call_once(cache.area_flag, [&] {
    const TileMapping& grid = values.mapping(node);
    for (std::uint64_t k = 0; k < cells_asked; ++k) {
      const auto cell = [&](std::int64_t cells, const char* axis) {
        return static_cast<std::int64_t>(random_bits(1, axis, k) % static_cast<std::uint64_t>(cells));
      };
      const PatternPlace centre = grid.centre_of(cell(grid.x.cells, "mean x"), cell(grid.y.cells, "mean y"));
      TileTransform t;
      t.scale =
          std::clamp(values.number_or(b.scale, centre, 1), 0.0, b.fit == TransformFit::shrink ? 1.0 : 1.4);
      if (b.rotation != no_node) t.turn(values.number(b.rotation, centre));
      if (b.fit == TransformFit::shrink) t.shrink_to_fit();
      cache.area += t.scale * t.scale / cells_asked;
    }
    for (std::size_t k = 0; k < cache.free.size(); ++k)
      cache.free[k] =
          free_share(cache.area, static_cast<double>(k) / static_cast<double>(cache.free.size() - 1));
  });
  if (b.fit == TransformFit::shrink || b.x == no_node || b.y == no_node) return cover * cache.area;
  const double at = std::clamp(cover, 0.0, 1.0) * static_cast<double>(cache.free.size() - 1);
  const auto before = static_cast<std::size_t>(std::min(at, static_cast<double>(cache.free.size() - 2)));
  const double rest = at - static_cast<double>(before);
  return 1 - (cache.free[before] + rest * (cache.free[before + 1] - cache.free[before]));
}

PatternMeans::Mean PatternMeans::of_patterns(const PatternsTexture& b, NodeId node,
                                             const std::vector<double>& shares) const {
  const PatternSource& source = *b.source;
  const int coarsest = source.facts().levels - 1, alpha_map = source.facts().alpha_map;
  const auto* means =
      source.has(map) ? &source.levels(map, PatternSource::Use::patterns, coarsest).means : nullptr;
  const auto* alphas =
      alpha_map < 0 ? nullptr : &source.levels(alpha_map, PatternSource::Use::patterns, coarsest);
  std::vector<std::pair<double, Mean>> parts;
  for (std::size_t i = 1; i < shares.size(); ++i) {
    if (!(shares[i] > 0) || static_cast<int>(i - 1) >= source.facts().tiles) continue;
    Mean part;
    for (std::size_t c = 0; means != nullptr && c < static_cast<std::size_t>(channels); ++c)
      part.value[c] = static_cast<double>((*means)[i - 1][c]);
    part.cover = 1;
    if (alphas != nullptr) {
      const auto last = static_cast<std::size_t>(alphas->patterns->channels() - 1);
      part.cover = static_cast<double>(alphas->means[i - 1][last]);
    }
    parts.emplace_back(shares[i], part);
  }
  Mean sum = mixed(parts);
  sum.cover = covered(b, node, sum.cover);
  return sum;
}

struct PatternMeans::MeanOf {
  const PatternMeans& means;
  NodeId node;
  const Region& region;

  Mean at(NodeId other) const { return means.mean(other, region.place, region.width_u, region.width_v); }
  std::vector<double> shares(NodeId index) const {
    return means.shares(index, region.place, region.width_u, region.width_v);
  }
  Mean chosen(const std::vector<NodeId>& textures, const std::vector<double>& weights) const {
    std::vector<std::pair<double, Mean>> parts;
    for (std::size_t i = 1; i < weights.size() && i <= textures.size(); ++i)
      if (weights[i] > 0) parts.emplace_back(weights[i], at(textures[i - 1]));
    return mixed(parts);
  }

  template <typename Block>
  Mean operator()(const Block&) const {
    return {}; // sprites: clear
  }
  Mean operator()(const ConstantTexture& b) const {
    Mean mean;
    const std::vector<double>& value = b.values[static_cast<std::size_t>(means.map)];
    const auto count = static_cast<std::size_t>(means.channels);
    for (std::size_t c = 0; c < count && c < value.size(); ++c) mean.value[c] = value[c];
    mean.cover = value.empty() ? 0 : value.size() > count ? value.back() : 1;
    return mean;
  }
  Mean operator()(const WangTexture& b) const {
    Mean mean;
    mean.cover = 1;
    if (!b.source->has(means.map)) return mean;
    const auto& levels = b.source->levels(means.map, PatternSource::Use::wang, b.source->facts().levels - 1);
    for (std::size_t c = 0; c < static_cast<std::size_t>(means.channels); ++c) {
      mean.value[c] = levels.mean[c];
      mean.variance[c] = levels.deviation[c] * levels.deviation[c];
    }
    if (b.source->facts().alpha_map == means.map)
      mean.cover = levels.mean[static_cast<std::size_t>(levels.wang->channels() - 1)];
    return mean;
  }
  Mean operator()(const PatternsTexture& b) const { return means.of_patterns(b, node, shares(b.index)); }
  Mean operator()(const SelectTexture& b) const { return chosen(b.textures, shares(b.index)); }
  Mean operator()(const TransitionTexture& b) const { return chosen(b.textures, shares(b.material)); }
  Mean operator()(const BorderTexture& b) const {
    const std::vector<double> weights = shares(b.material);
    const auto family = static_cast<std::size_t>(b.family + 1);
    const double inside = family < weights.size() ? weights[family] : 0;
    return mixed({{inside, at(b.inside)}, {1 - inside, at(b.below)}});
  }
  Mean operator()(const HeightBlendTexture& b) const {
    return chosen(b.textures, SharesOf{means, b.areas, region}.interpolated(b.areas, b.grid));
  }
  Mean operator()(const LayersTexture& b) const {
    Mean sum = at(b.textures[0]);
    for (std::size_t i = 1; i < b.textures.size(); ++i) sum = over(sum, at(b.textures[i]));
    return sum;
  }
  Mean operator()(const MovedTexture& b) const {
    PatternPlace place = region.place;
    place.u.fraction -= means.values.number_or(b.x, region.place, 0);
    place.v.fraction -= means.values.number_or(b.y, region.place, 0);
    return means.mean(b.texture, place, region.width_u, region.width_v);
  }
};

PatternMeans::Mean PatternMeans::mean(NodeId texture, const PatternPlace& place, double width_u,
                                      double width_v) const {
  values.note(texture);
  if (!values.stationary(texture))
    return std::visit(MeanOf{*this, texture, Region{place, width_u, width_v}}, values.block(texture));
  Cache& cache = caches[static_cast<std::size_t>(texture)];
  std::call_once(cache.mean_flag, [&] {
    cache.mean = std::visit(MeanOf{*this, texture, Region{}}, values.block(texture));
  });
  return cache.mean;
}

} // namespace tilepack
