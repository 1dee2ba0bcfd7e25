// How fast pattern textures are evaluated, in the four columns of the paper's table [LN03, section 6], beside its frames a
// second; and what a pack costs inside a scene against the same pack through the fast sampler. Prints the tables of
// lib/tilepack/pattern/PATTERNS.md:
//
//   build/release/tests/bench_pattern_speed [ROUNDS]

#include "tilepack/bench/timing.h"
#include "tilepack/numeric/random.h"
#include "tilepack/pattern/pattern_texture.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string>
#include <vector>

using namespace tilepack;

namespace {

constexpr int side = 64;
constexpr int picture_width = 640, picture_height = 480;

std::shared_ptr<const PatternSource> patterns(int count, std::uint64_t seed) {
  std::vector<Image> images;
  for (int i = 0; i < count; ++i) {
    Image image(side, side, 3);
    std::uint64_t at = static_cast<std::uint64_t>(i) << 32;
    for (float& value : image.data())
      value = static_cast<float>(random_below(seed, "pattern", at++, 256)) / 255.0f;
    images.push_back(std::move(image));
  }
  return source_of(
      std::make_shared<const Pack>(pattern_pack(images, {"color", Role::color, Encoding::srgb, Depth::u8})),
      "patterns");
}

PatternGraph scene(std::int64_t units) {
  PatternGraph graph;
  graph.scene = {units, units};
  graph.unit = {side, side};
  graph.maps = {{"color", Role::color, 3}};
  return graph;
}

NodeId add(PatternGraph& graph, PatternBlock block) {
  graph.nodes.push_back({fmt::format("node {}", graph.nodes.size()), std::move(block)});
  graph.output = static_cast<NodeId>(graph.nodes.size()) - 1;
  return graph.output;
}

NodeId areas_of(PatternGraph& graph) {
  Grid<float> areas(8, 8);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) areas.at(x, y) = static_cast<float>((x * 5 + y * 3) % 7 < 3);
  return add(graph, StoredIndex{std::make_shared<StoredMap>(areas)});
}

std::vector<int> mostly(int first) {
  std::vector<int> map;
  for (int i = 0; i < 64; ++i) map.push_back(first + (i < 40 ? i % 4 : i % 8));
  return map;
}

// 0 basic, 1 areas map, 2 dithered areas map, 3 that and transitions.
PatternGraph column(int number, std::int64_t units, HashKind hash) {
  PatternGraph graph = scene(units);
  const auto source = patterns(16, 1);
  const auto random = [&](int values) { return add(graph, RandomIndex{graph.scene, values, 5, 0, hash}); };
  if (number == 0) {
    add(graph, PatternsTexture{source, graph.scene, random(16)});
    return graph;
  }
  NodeId material = areas_of(graph);
  if (number >= 2) material = add(graph, DitheredIndex{material, {8, 8}, graph.scene, 9, 1, hash});
  const NodeId any = random(64);
  if (number < 3) {
    const NodeId index = add(graph, MaterialIndex{material, any, {{mostly(0), mostly(8)}}});
    add(graph, PatternsTexture{source, graph.scene, index});
    return graph;
  }
  std::vector<NodeId> families;
  for (int family = 0; family < 2; ++family)
    families.push_back(
        add(graph, PatternsTexture{source, graph.scene, add(graph, TableIndex{any, mostly(8 * family)})}));
  add(graph, TransitionTexture{material, graph.scene, families, patterns(16, 2)});
  return graph;
}

struct Picture {
  const PatternTexture& texture;
  double level = 0;
  std::int64_t units = 1 << 20; ///< of the scene: pictures start at one place of its areas

  void row(int y) const {
    thread_local std::array<std::vector<float>, 3> values;
    std::array<float*, 3> out{};
    for (std::size_t c = 0; c < 3; ++c) {
      values[c].resize(picture_width);
      out[c] = values[c].data();
    }
    const double step = std::exp2(level) / side;
    texture.sample_run(
        {{{units / 1024 * 500, 0.253}, {units / 1024 * 311, 0.127 + y * step}}, step, 0, picture_width},
        {step, 0, 0, step}, out);
  }
  void all() const {
    for (int y = 0; y < picture_height; ++y) row(y);
  }
};

// The same places through a sampler, a row a call, arrays filled as a renderer must.
struct PlainPicture {
  const FastSampler& sampler;
  double level = 0;

  void all() const {
    std::array<std::vector<float>, 3> values;
    std::vector<float> x(picture_width), y(picture_width), levels(picture_width);
    std::vector<std::int32_t> tile_x(picture_width), tile_y(picture_width);
    std::array<float*, 3> out{};
    for (std::size_t c = 0; c < 3; ++c) {
      values[c].resize(picture_width);
      out[c] = values[c].data();
    }
    const double step = std::exp2(level) / side;
    for (int row = 0; row < picture_height; ++row) {
      for (std::size_t i = 0; i < picture_width; ++i) {
        x[i] = static_cast<float>(0.253 + static_cast<double>(i) * step);
        y[i] = static_cast<float>(0.127 + row * step);
        tile_x[i] = 500;
        tile_y[i] = 311;
        levels[i] = static_cast<float>(level);
      }
      sampler.sample({picture_width, tile_x.data(), tile_y.data(), x.data(), y.data(), levels.data()},
                     Filter::trilinear, Weights::exact, out);
    }
  }
};

// A pack of edge-colored tiles; what is in them does not matter to the time.
std::shared_ptr<const Pack> wang_pack() {
  Pack pack;
  pack.tile_size = {side, side};
  pack.colors = {2, 2, 0};
  std::vector<EdgeTile> tiles;
  for (int id = 0; id < 16; ++id) tiles.push_back({id / 8, id / 4 % 2, id / 2 % 2, id % 2});
  pack.tiles = tiles;
  std::vector<Image> images;
  for (int i = 0; i < 16; ++i) {
    Image image(side, side, 3);
    std::uint64_t at = static_cast<std::uint64_t>(i) << 32;
    for (float& value : image.data()) value = static_cast<float>(random_below(3, "tile", at++, 256)) / 255.0f;
    images.push_back(std::move(image));
  }
  Pack set = pattern_pack(images, {"color", Role::color, Encoding::srgb, Depth::u8});
  set.colors = pack.colors;
  set.tiles = pack.tiles;
  set.mapping = mix_mapping({1 << 20, 1 << 20}, 5);
  return std::make_shared<const Pack>(std::move(set));
}

double seconds_of(const Picture& picture, int threads, int rounds) {
  tbb::task_arena arena(threads);
  double best = 1e9;
  for (int round = 0; round < rounds; ++round) {
    const double start = bench_time().wall;
    arena.execute([&] { tbb::parallel_for(0, picture_height, [&](int y) { picture.row(y); }); });
    best = std::min(best, bench_time().wall - start);
  }
  return best;
}

// Of times of the same round each: the middle one.
double ratio_of(const std::vector<double>& times, const std::vector<double>& others) {
  std::vector<double> ratios;
  for (std::size_t round = 0; round < times.size(); ++round) ratios.push_back(times[round] / others[round]);
  return median(ratios);
}

} // namespace

int main(int argc, char** argv) {
  const int rounds = argc > 1 ? std::max(1, std::atoi(argv[1])) : 15;
  constexpr double pixels = static_cast<double>(picture_width) * picture_height;
  constexpr std::array<const char*, 4> names{"basic", "areas map", "dithered areas map",
                                             "dithered, with transitions"};
  constexpr std::array<double, 4> paper{24.5, 15.5, 8.5, 1.1};
  for (const HashKind hash : {HashKind::mix, HashKind::chain}) {
    std::vector<PatternTexture*> textures;
    std::vector<std::unique_ptr<PatternTexture>> owned;
    std::vector<std::function<void()>> works;
    for (int c = 0; c < 4; ++c) {
      owned.push_back(std::make_unique<PatternTexture>(column(c, 1 << 20, hash), 0));
      works.push_back([texture = owned.back().get()] { Picture{*texture}.all(); });
    }
    const auto times = in_turn(works, {rounds, 0.02}, pixels);
    fmt::print("| hash {} | M texels/s, 1 thread | ratio | 2 threads, by the clock | paper, frames of 640 x "
               "480 | ratio |\n|---|---|---|---|---|---|\n",
               name_of(hash));
    for (std::size_t c = 0; c < 4; ++c) {
      const double ns = median(times[c]);
      fmt::print("| {} | {:.1f} | {:.2f} | {:.1f} | {} | {:.2f} |\n", names[c], 1000 / ns,
                 ratio_of(times[0], times[c]), pixels / seconds_of({*owned[c]}, 2, rounds) / 1e6, paper[c],
                 paper[c] / paper[0]);
    }
    fmt::print("\n");
  }

  std::vector<std::unique_ptr<PatternTexture>> sizes;
  std::vector<std::function<void()>> works;
  constexpr std::array<int, 3> bits{10, 15, 20};
  for (const int c : {0, 3})
    for (const int b : bits) {
      const std::int64_t units = std::int64_t{1} << b;
      sizes.push_back(std::make_unique<PatternTexture>(column(c, units, HashKind::mix), 0));
      works.push_back([texture = sizes.back().get(), units] { Picture{*texture, 0, units}.all(); });
    }
  const auto by_size = in_turn(works, {rounds, 0.02}, pixels);
  fmt::print(
      "| virtual texture | basic, time against the smallest | dithered, with transitions |\n|---|---|---|\n");
  for (std::size_t b = 0; b < bits.size(); ++b)
    fmt::print("| 2^{0} x 2^{0} cells | {1:.2f} | {2:.2f} |\n", bits[b], ratio_of(by_size[b], by_size[0]),
               ratio_of(by_size[3 + b], by_size[3]));

  const auto pack = wang_pack();
  PatternGraph graph = scene(1 << 20);
  add(graph, WangTexture{source_of(pack, "pack"), graph.scene});
  const PatternTexture inside(graph, 0);
  PatternGraph chosen = graph;
  const NodeId areas = areas_of(chosen);
  add(chosen, SelectTexture{areas, {0, 0}});
  const PatternTexture select(chosen, 0);
  const FastSampler sampler(*pack, 0);
  fmt::print("\n| pack, trilinear | fast sampler, ns a texel | the pack as a scene | ratio | chosen by an "
             "areas map | ratio |\n"
             "|---|---|---|---|---|---|\n");
  for (const double level : {0.0, 0.5, 2.5}) {
    const auto times = in_turn({[&] {
                                  PlainPicture{sampler, level}.all();
                                },
                                [&] {
                                  Picture{inside, level}.all();
                                },
                                [&] {
                                  Picture{select, level}.all();
                                }},
                               {rounds, 0.02}, pixels);
    fmt::print("| level {} | {:.2f} | {:.2f} | {:.3f} | {:.2f} | {:.3f} |\n", level, median(times[0]),
               median(times[1]), ratio_of(times[1], times[0]), median(times[2]),
               ratio_of(times[2], times[0]));
  }
}
