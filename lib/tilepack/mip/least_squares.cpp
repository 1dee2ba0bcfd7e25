#include "tilepack/mip/least_squares.h"

#include "tilepack/numeric/as_size.h"
#include "tilepack/tileset/border_keys.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>

namespace tilepack {
namespace {

// Tiles by the key of one of their sides or corners: the tiles that may follow across it.
using Classes = std::map<int, std::vector<int>>;

// An axis of edges: `before` is the side of the tile west or north of an edge that lies on it.
struct Axis {
  BorderPath::Side before;
  BorderPath::Side after;
};
constexpr Axis axes[] = {{BorderPath::south, BorderPath::north}, {BorderPath::east, BorderPath::west}};

// Everything about the problem but the values: shared by all channels.
class Topology {
public:
  Topology(const TileColors& colors, const PackNeighbours& pack, Size size)
      : frame(size), keys(border_keys(colors)), tiles(static_cast<int>(keys.size())),
        nodes(static_cast<int>(frame.nodes().size())) {
    for (int tile = 0; tile < tiles; ++tile)
      for (std::size_t k = 0; k < 4; ++k) {
        by_side[k][keys[as_size(tile)].sides[k]].push_back(tile);
        by_corner[k][keys[as_size(tile)].corners[k]].push_back(tile);
      }
    unknown_of_node.reserve(as_size(tiles) * as_size(nodes));
    for (int tile = 0; tile < tiles; ++tile)
      for (const BorderPath::Node& node : frame.nodes())
        unknown_of_node.push_back(unknown_at(pack, tile, node));

    first_use.assign(as_size(unknowns()) + 1, 0);
    for (const int unknown : unknown_of_node) ++first_use[as_size(unknown) + 1];
    for (std::size_t i = 1; i < first_use.size(); ++i) first_use[i] += first_use[i - 1];
    uses.resize(unknown_of_node.size());
    std::vector<int> next(first_use.begin(), first_use.end() - 1);
    for (std::size_t flat = 0; flat < unknown_of_node.size(); ++flat)
      uses[as_size(next[as_size(unknown_of_node[flat])]++)] = static_cast<int>(flat);
  }

  int unknowns() const { return tiles * frame.ring_count(); }

  // The tile that a filter standing in `tile` reads at a node, and the texel of it.
  struct Source {
    int tile = 0;
    int x = 0;
    int y = 0;
  };
  Source source(const PackNeighbours& pack, int tile, BorderPath::Node node) const {
    const Size size = frame.tile_size();
    const int dx = node.x < 0 ? -1 : node.x == size.width ? 1 : 0;
    const int dy = node.y < 0 ? -1 : node.y == size.height ? 1 : 0;
    if (pack.around.empty())
      return {tile, std::clamp(node.x, 0, size.width - 1), std::clamp(node.y, 0, size.height - 1)};
    const int place = (dy + 1) * 3 + dx + 1;
    const int there = place == 4 ? tile : pack.around[as_size(tile)][as_size(place < 4 ? place : place - 1)];
    return {there, node.x - dx * size.width, node.y - dy * size.height};
  }

  // The tiles that may lie in the plane where a pad node is, seen from `tile`; empty if no tile fits.
  const std::vector<int>& possible(int tile, BorderPath::Node node) const {
    static const std::vector<int> nobody;
    using K = BorderKeys;
    const Size size = frame.tile_size();
    const bool west = node.x < 0;
    const bool east = node.x == size.width;
    const bool north = node.y < 0;
    const bool south = node.y == size.height;
    const BorderKeys& own = keys[as_size(tile)];
    const auto find = [](const Classes& classes, int key) -> const std::vector<int>& {
      const auto found = classes.find(key);
      return found == classes.end() ? nobody : found->second;
    };
    if ((west || east) && (north || south)) {
      const K::Corner corner = north ? (west ? K::nw : K::ne) : (west ? K::sw : K::se);
      const K::Corner facing = north ? (west ? K::se : K::sw) : (west ? K::ne : K::nw);
      return find(by_corner[facing], own.corners[corner]);
    }
    const K::Side side = north ? K::north : south ? K::south : west ? K::west : K::east;
    const K::Side facing = north ? K::south : south ? K::north : west ? K::east : K::west;
    return find(by_side[facing], own.sides[side]);
  }

  BorderPath frame;
  std::vector<BorderKeys> keys;
  int tiles;
  int nodes;
  Classes by_side[4];
  Classes by_corner[4];
  std::vector<int> unknown_of_node; // tile * nodes + node
  std::vector<int> first_use;       // of each unknown, into `uses`; one more at the end
  std::vector<int> uses;            // indices like those of unknown_of_node

private:
  int unknown_at(const PackNeighbours& pack, int tile, BorderPath::Node node) const {
    const Source s = source(pack, tile, node);
    return s.tile * frame.ring_count() + frame.ring_index(s.x, s.y);
  }
};

// One channel: the gradient of the objective by the ring texels, halved.
class Objective {
public:
  Objective(const Topology& t, const std::vector<double>& error_offset,
            const std::vector<double>& value_offset, double weight_of_jump)
      : topology(t), error_at_box(error_offset), box(value_offset), jump_weight(weight_of_jump),
        forces(t.unknown_of_node.size()), means(as_size(t.tiles) * 4) {
    for (auto& line : means) line.resize(as_size(longest_line()));
    lines = means;
  }

  // For a change `change` of the ring texels from the box; without the constant part for `linear_only`.
  void gradient(const std::vector<double>& change, bool linear_only, std::vector<double>& out) {
    const auto every_tile = [&](auto&& f) {
      tbb::parallel_for(0, topology.tiles,
                        [&](int tile) { f(tile, as_size(tile) * as_size(topology.nodes)); });
    };
    every_tile([&](int, std::size_t first) { error_forces(first, change, linear_only); });
    if (jump_weight > 0) {
      every_tile([&](int tile, std::size_t first) { border_lines(tile, first, change, linear_only); });
      for (const Axis& axis : axes) {
        facing_means(axis.before, axis.after);
        facing_means(axis.after, axis.before);
      }
      every_tile([&](int tile, std::size_t first) { jump_forces(tile, first); });
    }
    out.resize(as_size(topology.unknowns()));
    tbb::parallel_for(0, topology.unknowns(), [&](int unknown) {
      double sum = 0;
      for (int use = topology.first_use[as_size(unknown)]; use < topology.first_use[as_size(unknown) + 1];
           ++use)
        sum += forces[as_size(topology.uses[as_size(use)])];
      out[as_size(unknown)] = sum;
    });
  }

private:
  int longest_line() const {
    return std::max(topology.frame.tile_size().width, topology.frame.tile_size().height) + 2;
  }
  std::vector<double>& line(int tile, BorderPath::Side side) { return lines[as_size(tile) * 4 + side]; }

  void error_forces(std::size_t first, const std::vector<double>& change, bool linear_only) {
    std::vector<double> e(as_size(topology.nodes));
    for (std::size_t node = 0; node < e.size(); ++node)
      e[node] = change[as_size(topology.unknown_of_node[first + node])] +
                (linear_only ? 0.0 : error_at_box[first + node]);
    for (std::size_t node = 0; node < e.size(); ++node) {
      double sum = 0;
      for (const BorderPath::Product& p : topology.frame.products(static_cast<int>(node)))
        sum += p.integral * e[as_size(p.node)];
      forces[first + node] = sum;
    }
  }

  void border_lines(int tile, std::size_t first, const std::vector<double>& change, bool linear_only) {
    const auto value = [&](int node) {
      const std::size_t unknown = as_size(topology.unknown_of_node[first + as_size(node)]);
      return change[unknown] + (linear_only ? 0.0 : box[unknown]);
    };
    for (const BorderPath::Side side :
         {BorderPath::north, BorderPath::east, BorderPath::south, BorderPath::west}) {
      const auto& crossings = topology.frame.crossings(side);
      std::vector<double>& values = line(tile, side);
      values.resize(crossings.size());
      for (std::size_t i = 0; i < crossings.size(); ++i)
        values[i] = 0.5 * (value(crossings[i].inside) + value(crossings[i].outside));
    }
  }

  // What the tiles across `side` read on average, for every key of that side: kept with the first tile of
  // the key.
  void facing_means(BorderPath::Side side, BorderPath::Side facing) {
    for (const auto& [key, tiles] : topology.by_side[side]) {
      std::vector<double>& mean = means[as_size(tiles.front()) * 4 + side];
      mean.assign(topology.frame.crossings(side).size(), 0.0);
      const auto across = topology.by_side[facing].find(key);
      if (across == topology.by_side[facing].end()) continue;
      for (const int tile : across->second)
        for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += line(tile, facing)[i];
      for (double& v : mean) v /= static_cast<double>(across->second.size());
    }
  }

  void jump_forces(int tile, std::size_t first) {
    std::vector<double> deviation;
    std::vector<double> force;
    for (const Axis& axis : axes)
      for (const BorderPath::Side side : {axis.before, axis.after}) {
        const BorderPath::Side facing = side == axis.before ? axis.after : axis.before;
        const int key = topology.keys[as_size(tile)].sides[side];
        const auto& own = topology.by_side[side].at(key);
        const auto across = topology.by_side[facing].find(key);
        if (across == topology.by_side[facing].end()) continue;
        const std::vector<double>& mean = means[as_size(own.front()) * 4 + side];
        deviation = line(tile, side);
        for (std::size_t i = 0; i < deviation.size(); ++i) deviation[i] -= mean[i];
        BorderPath::integrate(deviation, force);
        // Each edge is counted once for each tile before it.
        const double share = side == axis.before ? 1.0
                                                 : static_cast<double>(across->second.size()) /
                                                       static_cast<double>(own.size());
        const auto& crossings = topology.frame.crossings(side);
        for (std::size_t i = 0; i < force.size(); ++i) {
          const double f = 0.5 * jump_weight * share * force[i];
          forces[first + as_size(crossings[i].inside)] += f;
          forces[first + as_size(crossings[i].outside)] += f;
        }
      }
  }

  const Topology& topology;
  const std::vector<double>& error_at_box;
  const std::vector<double>& box;
  double jump_weight;
  std::vector<double> forces;             // by tile and node
  std::vector<std::vector<double>> means; // by tile and side
  std::vector<std::vector<double>> lines; // by tile and side
};

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

// The zero of the gradient, by conjugate gradients. The matrix is symmetric and positive: the error's part
// alone is. The start is no change.
std::vector<double> minimiser(Objective& objective, std::size_t unknowns) {
  constexpr int most_steps = 200;
  constexpr double enough = 1e-5; // of the first residual: far below a step of 16 bits
  std::vector<double> change(unknowns, 0.0);
  std::vector<double> residual;
  objective.gradient(change, false, residual);
  for (double& r : residual) r = -r;
  std::vector<double> direction = residual;
  std::vector<double> image;
  double size = dot(residual, residual);
  const double goal = size * enough * enough;
  for (int step = 0; step < most_steps && size > goal; ++step) {
    objective.gradient(direction, true, image);
    const double length = size / dot(direction, image);
    for (std::size_t i = 0; i < unknowns; ++i) {
      change[i] += length * direction[i];
      residual[i] -= length * image[i];
    }
    const double next = dot(residual, residual);
    for (std::size_t i = 0; i < unknowns; ++i) direction[i] = residual[i] + next / size * direction[i];
    size = next;
  }
  return change;
}

void fit_channel(const Topology& topology, const PackNeighbours& pack, double jump_weight,
                 std::size_t channel, std::vector<Image>& tiles) {
  const auto box_value = [&](int tile, int x, int y) {
    return static_cast<double>(tiles[as_size(tile)].texel(x, y)[channel]);
  };
  const Size size = topology.frame.tile_size();
  std::vector<double> box(as_size(topology.unknowns()));
  std::vector<double> error(topology.unknown_of_node.size(), 0.0);
  tbb::parallel_for(0, topology.tiles, [&](int tile) {
    for (int node = 0; node < topology.nodes; ++node) {
      const BorderPath::Node at = topology.frame.nodes()[as_size(node)];
      if (topology.frame.in_ring(at)) {
        box[as_size(tile * topology.frame.ring_count() + topology.frame.ring_index(at.x, at.y))] =
            box_value(tile, at.x, at.y);
        continue;
      }
      const std::vector<int>& possible = topology.possible(tile, at);
      if (possible.empty()) continue;
      const int x = at.x < 0 ? size.width - 1 : at.x == size.width ? 0 : at.x;
      const int y = at.y < 0 ? size.height - 1 : at.y == size.height ? 0 : at.y;
      double mean = 0;
      for (const int other : possible) mean += box_value(other, x, y);
      mean /= static_cast<double>(possible.size());
      const Topology::Source read = topology.source(pack, tile, at);
      error[as_size(tile) * as_size(topology.nodes) + as_size(node)] =
          box_value(read.tile, read.x, read.y) - mean;
    }
  });

  Objective objective(topology, error, box, jump_weight);
  const std::vector<double> change = minimiser(objective, box.size());
  for (int tile = 0; tile < topology.tiles; ++tile)
    for (int node = 0; node < topology.nodes; ++node) {
      if (!topology.frame.in_ring(topology.frame.nodes()[as_size(node)])) continue;
      const BorderPath::Node at = topology.frame.nodes()[as_size(node)];
      const std::size_t unknown =
          as_size(tile * topology.frame.ring_count() + topology.frame.ring_index(at.x, at.y));
      tiles[as_size(tile)].texel(at.x, at.y)[channel] = static_cast<float>(box[unknown] + change[unknown]);
    }
}

// The smallest and the largest value of each channel over all tiles.
std::vector<std::pair<float, float>> ranges(const std::vector<Image>& tiles) {
  const auto first = tiles.front().texel(0, 0);
  std::vector<std::pair<float, float>> range;
  for (const float v : first) range.emplace_back(v, v);
  for (const Image& tile : tiles)
    for (std::size_t i = 0; i < tile.data().size(); ++i) {
      auto& [low, high] = range[i % range.size()];
      low = std::min(low, tile.data()[i]);
      high = std::max(high, tile.data()[i]);
    }
  return range;
}

void multiply_by_alpha(Image& tile) {
  const std::size_t channels = as_size(tile.channels());
  auto& v = tile.data();
  for (std::size_t i = 0; i < v.size(); i += channels)
    for (std::size_t c = 0; c + 1 < channels; ++c) v[i + c] *= v[i + channels - 1];
}

} // namespace

void fit_borders(const TileColors& colors, const PackNeighbours& neighbours, double jump_weight,
                 Weighting weighting, std::vector<Image>& tiles) {
  if (tiles.empty() || tiles.front().empty()) return;
  const Topology topology(colors, neighbours, tiles.front().size());
  const bool by_alpha = weighting == Weighting::by_alpha;
  std::vector<Image> fitted = tiles;
  if (by_alpha) std::for_each(fitted.begin(), fitted.end(), multiply_by_alpha);
  const int channels = tiles.front().channels();
  tbb::parallel_for(0, channels, [&](int channel) {
    fit_channel(topology, neighbours, jump_weight, as_size(channel), fitted);
  });

  const auto range = ranges(tiles);
  const std::size_t last = as_size(channels) - 1;
  for (std::size_t id = 0; id < tiles.size(); ++id)
    for (const BorderPath::Node& node : topology.frame.nodes()) {
      if (!topology.frame.in_ring(node)) continue;
      const auto from = fitted[id].texel(node.x, node.y);
      const auto to = tiles[id].texel(node.x, node.y);
      if (by_alpha && !(from[last] > 0.0f)) continue; // clear: its color is nobody's business
      for (std::size_t c = 0; c <= last; ++c) {
        const float value = by_alpha && c < last ? from[c] / from[last] : from[c];
        to[c] = std::clamp(value, range[c].first, range[c].second);
      }
    }
}

} // namespace tilepack
