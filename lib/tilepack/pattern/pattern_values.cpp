#include "tilepack/pattern/pattern_values.h"

#include "tilepack/numeric/exact_math.h"
#include "tilepack/pattern/areas.h"
#include "tilepack/pattern/transition_tiles.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace tilepack {
namespace {

template <typename Block>
concept OnGrid = requires(const Block& block) {
  PatternGrid{block.grid};
};
template <typename Block>
concept OnMap = requires(const Block& block) {
  block.map->grid();
};

std::int64_t whole(double number) {
  if (!(std::fabs(number) < 0x1p62)) return 0; // NaN too
  return static_cast<std::int64_t>(std::floor(number));
}

// sin(2π turns)
double sine_of_turns(double turns) {
  const double rest = turns - std::floor(turns);
  const double half = rest < 0.25 ? 2 * rest : rest < 0.75 ? 1 - 2 * rest : 2 * rest - 2;
  return exact_sine_of_half_turns(half);
}

double arithmetic(NumberOperation operation, double a, double b) {
  switch (operation) {
  case NumberOperation::add:
    return a + b;
  case NumberOperation::subtract:
    return a - b;
  case NumberOperation::multiply:
    return a * b;
  case NumberOperation::divide:
    return b == 0 ? 0 : a / b;
  case NumberOperation::minimum:
    return std::min(a, b);
  case NumberOperation::maximum:
    return std::max(a, b);
  case NumberOperation::modulo:
    return b == 0 ? 0 : a - b * std::floor(a / b);
  case NumberOperation::sine:
    return b * sine_of_turns(a);
  }
  return 0;
}

int entry_of(const std::vector<int>& entries, std::int64_t index) {
  return index < 0 ? -1 : entries[static_cast<std::size_t>(index) % entries.size()];
}

} // namespace

PatternValues::PatternValues(const PatternGraph& of_graph, double time)
    : graph(of_graph), now(time), states(of_graph.nodes.size()),
      used(std::make_unique<std::atomic<bool>[]>(of_graph.nodes.size())) {
  for (std::size_t i = 0; i < states.size(); ++i) prepare(static_cast<NodeId>(i));
}

void PatternValues::prepare(NodeId node) {
  State& state = states[static_cast<std::size_t>(node)];
  const auto of_inputs = [&](auto&& holds) {
    const std::vector<NodeInput> inputs = inputs_of(block(node));
    return std::all_of(inputs.begin(), inputs.end(),
                       [&](const NodeInput& input) { return holds(input.node); });
  };
  state.constant = of_inputs([&](NodeId input) { return same_everywhere(input); });
  state.even = of_inputs([&](NodeId input) { return stationary(input); });
  std::visit(
      [&](const auto& b) {
        using Block = std::decay_t<decltype(b)>;
        PatternGrid grid;
        if constexpr (OnGrid<Block>) grid = b.grid;
        if constexpr (OnMap<Block>) grid = b.map->grid();
        if constexpr (std::is_same_v<Block, SpritesTexture>) grid = b.sprites->grid();
        state.mapping = TileMapping(grid, graph.scene);
        constexpr bool placed = OnMap<Block> || std::is_same_v<Block, DistanceNumber>;
        state.gridded = OnGrid<Block> || OnMap<Block>;
        if constexpr (std::is_same_v<Block, RandomIndex>) {
          state.hashes[0] = CellHash(b.hash, grid, b.values, b.seed, b.stream);
          state.constant = b.values == 1;
        } else if constexpr (std::is_same_v<Block, RandomNumber>) {
          state.hashes[0] = CellHash(b.hash, grid, 1, b.seed, b.stream, 4096);
          state.constant = false;
        } else if constexpr (std::is_same_v<Block, DitheredIndex>) {
          state.coarse = TileMapping(b.coarse, graph.scene);
          state.hashes[0] = CellHash(b.hash, grid, 1, b.seed, 2 * b.stream, 4096);
          state.hashes[1] = CellHash(b.hash, grid, 1, b.seed, 2 * b.stream + 1, 4096);
        } else if constexpr (std::is_same_v<Block, TransitionTexture> ||
                             std::is_same_v<Block, BorderTexture>) {
          state.hashes[0] = CellHash(HashKind::mix, grid, b.variants, b.seed);
          if constexpr (std::is_same_v<Block, TransitionTexture>)
            state.hashes[1] = CellHash(HashKind::mix, grid, b.colors_of_material, b.seed, 1);
        }
        if (placed) state.constant = state.even = false;
      },
      block(node));
}

std::vector<bool> PatternValues::used_nodes() const {
  std::vector<bool> all;
  for (std::size_t i = 0; i < states.size(); ++i) all.push_back(used[i].load());
  return all;
}

AnimationCycle PatternValues::cycle(const AnimationIndex& b, const PatternPlace& place, NodeId rest,
                                    NodeId density) const {
  return {b.length, rest_steps(number_or(density, place, 1), number_or(rest, place, 0)),
          whole(number_or(b.phase, place, 0))};
}

// What a node on a grid gives in a cell.
struct PatternValues::IndexInCell {
  const PatternValues& values;
  const State& state;
  PatternCell cell;

  template <typename Block>
  std::int64_t operator()(const Block&) const {
    return -1; // no index on a grid
  }
  std::int64_t operator()(const StoredIndex& b) const {
    return whole(static_cast<double>(b.map->at(cell.x, cell.y)));
  }
  std::int64_t operator()(const RandomIndex&) const { return state.hashes[0].index(cell); }
  std::int64_t operator()(const PixelIndex& b) const { return b.map->at(cell.x, cell.y).material; }
  std::int64_t operator()(const DitheredIndex& b) const {
    const auto between = [](std::int64_t at, std::int64_t cells, std::int64_t areas) {
      const std::int64_t finer = cells / areas;
      return between_centres(at / finer,
                             (static_cast<double>(at % finer) + 0.5) / static_cast<double>(finer));
    };
    const BetweenCentres x = between(cell.x, b.grid.width, b.coarse.width);
    const BetweenCentres y = between(cell.y, b.grid.height, b.coarse.height);
    const auto area = [&](std::int64_t dx, std::int64_t dy) {
      return values.index(b.areas, state.coarse.centre_of(x.first + dx, y.first + dy));
    };
    const std::int64_t v1 = area(0, 0), v2 = area(1, 0), v3 = area(0, 1), v4 = area(1, 1);
    if (v1 == v2 && v1 == v3 && v1 == v4) return v1;
    return dithered(v1, v2, v3, v4, x.b, y.b, state.hashes[0].number(cell), state.hashes[1].number(cell));
  }
  std::int64_t operator()(const CornerIndex& b) const {
    const auto material = [&](std::int64_t dx, std::int64_t dy) {
      return values.index(b.material, state.mapping.centre_of(cell.x + dx, cell.y + dy));
    };
    const CornerMaterials corners{material(0, 0), material(1, 0), material(0, 1), material(1, 1)};
    const auto known = [&](std::int64_t m) { return m >= 0 && m < b.families; };
    if (!known(corners.nw) || !known(corners.ne) || !known(corners.sw) || !known(corners.se)) return -1;
    return transition_code(corners, b.families);
  }
  std::int64_t operator()(const AnimationIndex& b) const {
    const PatternPlace centre = state.mapping.centre_of(cell.x, cell.y);
    const AnimationCycle after = values.cycle(b, centre, b.rest, b.density);
    const std::int64_t step = whole(values.now);
    if (!b.changes) return after.frame(step);
    return TemporalTransition{values.cycle(b, centre, b.rest_before, b.density_before), after, b.changed}
        .frame(step);
  }
};

// What a node without a grid gives at a place.
struct PatternValues::IndexAtPlace {
  const PatternValues& values;
  const PatternPlace& place;

  template <typename Block>
  std::int64_t operator()(const Block&) const {
    return -1;
  }
  std::int64_t operator()(const ConstantIndex& b) const { return b.value; }
  std::int64_t operator()(const TableIndex& b) const {
    return entry_of(b.entries, values.index(b.index, place));
  }
  std::int64_t operator()(const MaterialIndex& b) const {
    return of_material(b, values.index(b.material, place), values.index(b.index, place));
  }
  std::int64_t operator()(const FlooredIndex& b) const {
    const std::int64_t index = whole(values.number(b.number, place));
    return b.wrap ? wrapped(index, std::int64_t{b.values}) : std::clamp<std::int64_t>(index, 0, b.values - 1);
  }
  static std::int64_t of_material(const MaterialIndex& b, std::int64_t material, std::int64_t index) {
    if (material < 0 || static_cast<std::size_t>(material) >= b.table.materials.size() || index < 0)
      return -1;
    return b.table.pattern(material, index);
  }
};

std::int64_t PatternValues::index_in_cell(NodeId node, PatternCell cell) const {
  note(node);
  return std::visit(IndexInCell{*this, states[static_cast<std::size_t>(node)], cell}, block(node));
}

std::int64_t PatternValues::index(NodeId node, const PatternPlace& place) const {
  if (has_grid(node)) return index_in_cell(node, mapping(node).cell_of(place));
  note(node);
  return std::visit(IndexAtPlace{*this, place}, block(node));
}

PatternValues::Stretch PatternValues::stretch(NodeId node, const PatternRun& run, std::size_t i) const {
  if (has_grid(node)) {
    const GridWalk walk(mapping(node), run);
    if (const auto* pixels = std::get_if<PixelIndex>(&block(node));
        pixels && run.step_u > 0 && run.step_v == 0) {
      note(node);
      const PatternCell cell = walk.cell(walk.spot(i));
      const PixelMap::Run known = pixels->map->at(cell.x, cell.y);
      return {known.material, walk.end_before(i, static_cast<double>(known.end - cell.x))};
    }
    return {index_in_cell(node, walk.cell(walk.spot(i))), walk.stretch_end(i)};
  }
  if (same_everywhere(node)) return {index(node, run.at(i)), run.count};
  if (const auto* table = std::get_if<TableIndex>(&block(node))) {
    note(node);
    const Stretch input = stretch(table->index, run, i);
    return {entry_of(table->entries, input.value), input.end};
  }
  if (const auto* table = std::get_if<MaterialIndex>(&block(node))) {
    note(node);
    const Stretch material = stretch(table->material, run, i), input = stretch(table->index, run, i);
    return {IndexAtPlace::of_material(*table, material.value, input.value),
            std::min(material.end, input.end)};
  }
  return {index(node, run.at(i)), i + 1};
}

double PatternValues::smooth_number(const StoredNumber& b, const State& state,
                                    const PatternPlace& place) const {
  const TileCoordinate u = state.mapping.x.cell_of(place.u), v = state.mapping.y.cell_of(place.v);
  const BetweenCentres x = between_centres(u.tile, u.fraction), y = between_centres(v.tile, v.fraction);
  const auto at = [&](std::int64_t dx, std::int64_t dy) {
    return static_cast<double>(b.map->at(x.first + dx, y.first + dy));
  };
  const double upper = at(0, 0) + x.b * (at(1, 0) - at(0, 0)), lower = at(0, 1) + x.b * (at(1, 1) - at(0, 1));
  return upper + y.b * (lower - upper);
}

struct PatternValues::NumberAtPlace {
  const PatternValues& values;
  const State& state;
  const PatternPlace& place;

  template <typename Block>
  double operator()(const Block&) const {
    return 0;
  }
  double operator()(const ConstantNumber& b) const { return b.value; }
  double operator()(const RandomNumber& b) const {
    return b.low + (b.high - b.low) * state.hashes[0].number(state.mapping.cell_of(place));
  }
  double operator()(const StoredNumber& b) const {
    const PatternCell cell = state.mapping.cell_of(place);
    const double value =
        b.smooth ? values.smooth_number(b, state, place) : static_cast<double>(b.map->at(cell.x, cell.y));
    return value * b.scale + b.offset;
  }
  double operator()(const TimeNumber&) const { return values.now; }
  double operator()(const DistanceNumber& b) const {
    const double x = along(place.u, values.number(b.x, place), values.graph.scene.width);
    const double y = along(place.v, values.number(b.y, place), values.graph.scene.height);
    return std::sqrt(x * x + y * y);
  }
  double operator()(const IndexedNumber& b) const {
    return static_cast<double>(values.index(b.index, place));
  }
  double operator()(const ArithmeticNumber& b) const {
    return arithmetic(b.operation, values.number(b.a, place), values.number(b.b, place));
  }

  static double along(TileCoordinate at, double to, std::int64_t units) {
    const TileCoordinate away = normalised({at.tile, at.fraction - to});
    const auto side = static_cast<double>(units);
    const double distance = static_cast<double>(wrapped(away.tile, units)) + away.fraction;
    return std::min(distance, side - distance);
  }
};

double PatternValues::number(NodeId node, const PatternPlace& place) const {
  note(node);
  return std::visit(NumberAtPlace{*this, states[static_cast<std::size_t>(node)], place}, block(node));
}

} // namespace tilepack
