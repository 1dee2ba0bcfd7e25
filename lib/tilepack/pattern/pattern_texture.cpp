#include "tilepack/pattern/pattern_texture.h"

#include "tilepack/error/error.h"
#include "tilepack/numeric/exact_math.h"
#include "tilepack/pattern/coarse_map.h"
#include "tilepack/pattern/pattern_means.h"
#include "tilepack/tileset/value_space.h"

#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>

namespace tilepack {
namespace {

constexpr int most_probes_of_pixel = 16;
constexpr int most_means_of_pixel = 4;
constexpr int most_samples = 64;
constexpr int longest_coarse_map = 8192;

// The lookups that stand for a pixel, and how much its mean over many cells counts.
struct PixelPlan {
  struct Sample {
    double u = 0, v = 0; ///< units from the pixel's centre
    double level = 0;    ///< RunLookup::level
    double weight = 1;
  };
  std::vector<Sample> samples;
  std::vector<Sample> means;
  double width_u = 0, width_v = 0; ///< of the region of a mean, units
  Filter filter = Filter::trilinear;
};

// k x k samples all over a square of `width` units round a place, instead of one.
void add_square(PixelPlan& plan, const PixelPlan::Sample& centre, int k, double width_u, double width_v,
                double weight) {
  if (!(weight > 0)) return;
  const double finer = exact_log2(k);
  for (int j = 0; j < k; ++j)
    for (int i = 0; i < k; ++i)
      plan.samples.push_back({centre.u + ((i + 0.5) / k - 0.5) * width_u,
                              centre.v + ((j + 0.5) / k - 0.5) * width_v, centre.level - finer,
                              centre.weight * weight / (k * k)});
}

Filter filter_of(PatternFilter filter) {
  if (filter == PatternFilter::nearest) return Filter::nearest;
  return filter == PatternFilter::bilinear || filter == PatternFilter::supersampled ? Filter::bilinear
                                                                                    : Filter::trilinear;
}

// Pixels of a run that lie within the scene: those after would start from its other side.
std::size_t pixels_to_border(TileCoordinate place, double step, std::int64_t units, std::size_t count) {
  if (step == 0) return count;
  const double left = step > 0 ? static_cast<double>(units - place.tile) - place.fraction
                               : static_cast<double>(place.tile) + place.fraction;
  const double pixels = std::ceil(left / std::fabs(step));
  return pixels < static_cast<double>(count) ? std::max<std::size_t>(1, static_cast<std::size_t>(pixels))
                                             : count;
}

} // namespace

struct PatternTexture::State {
  PatternGraph graph;
  PatternOptions options;
  int map = 0;
  PatternValues values;
  TextureRuns runs;
  PatternMeans means;
  PatternGrid finest{0, 0}; ///< the finest grid of all that hold tiles or patterns
  bool vectors = false;
  std::size_t channels = 0;
  mutable std::mutex building;
  mutable std::atomic<const CoarseMap*> coarse{nullptr};
  mutable std::unique_ptr<const CoarseMap> coarse_owned;

  State(const PatternGraph& of_graph, int of_map, const PatternOptions& of_options)
      : graph(of_graph), options(of_options), map(of_map), values(graph, options.time), runs(graph, values),
        means(graph, values, map) {
    const PatternMapFacts& facts = graph.maps[static_cast<std::size_t>(map)];
    vectors = facts.role == Role::normal && facts.channels >= 3;
    channels = static_cast<std::size_t>(runs.value_channels(map));
    const std::vector<bool> reached = reachable_nodes(graph);
    for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
      if (!reached[i] || source_of(graph.nodes[i].block) == nullptr) continue;
      const TileMapping& mapping = values.mapping(static_cast<NodeId>(i));
      finest.width = std::max(finest.width, mapping.x.cells);
      finest.height = std::max(finest.height, mapping.y.cells);
    }
  }

  double cells_a_unit() const {
    return std::max(static_cast<double>(finest.width) / static_cast<double>(graph.scene.width),
                    static_cast<double>(finest.height) / static_cast<double>(graph.scene.height));
  }
  bool has_coarse_map() const {
    return finest.width > 0 && finest.width <= options.coarse_map && finest.height <= options.coarse_map &&
           fits_scene(finest.width, graph.scene.width) && fits_scene(finest.height, graph.scene.height);
  }

  PixelPlan plan(const Footprint& footprint) const;
  void add_probe(PixelPlan& plan, const PixelPlan::Sample& probe) const;
  void add_ellipse(PixelPlan& plan, double major, double minor, int count, double x, double y) const;
  const CoarseMap& coarse_map() const;
  void evaluate(const PatternRun& run, const RunLookup& lookup, const RunValues& out) const;
  void add_means(const PatternRun& run, const PixelPlan& plan, double (*sums)[5]) const;
  void run(const PatternRun& run, const PixelPlan& plan, std::span<float* const> out) const;
  void finish(const RunValues& out, std::size_t count) const;
};

// A probe of some size: as it is, or as several samples, by how many cells it covers.
void PatternTexture::State::add_probe(PixelPlan& plan, const PixelPlan::Sample& probe) const {
  const double texels = std::exp2(probe.level);
  const double width_u = texels / graph.unit.width, width_v = texels / graph.unit.height;
  const double cells = std::max(width_u, width_v) * cells_a_unit();
  if (!(cells > 0.5)) {
    plan.samples.push_back(probe);
    return;
  }
  const double octave = exact_log2(std::min(cells, 2.0)); // -1..1
  const auto share = [&](double centre) { return std::max(0.0, 1 - std::fabs(octave - centre)); };
  add_square(plan, probe, 1, width_u, width_v, share(-1));
  add_square(plan, probe, 2, width_u, width_v, share(0));
  add_square(plan, probe, 4, width_u, width_v, share(1));
}

// An ellipse of `major` x `minor` texels of the scene, as probes along its longer axis (x, y); where it covers 4 to 16
// cells, these fade into the mean.
void PatternTexture::State::add_ellipse(PixelPlan& plan, double major, double minor, int count, double x,
                                        double y) const {
  const auto level_of_width = [](double texels) { return texels > 0x1p-60 ? exact_log2(texels) : -60.0; };
  const double cells_a_texel = std::max(1.0 / graph.unit.width, 1.0 / graph.unit.height) * cells_a_unit();
  const double area = std::min(major * cells_a_texel, 1e6) * std::min(minor * cells_a_texel, 1e6);
  const bool fades = plan.filter == Filter::trilinear && area > 4;
  const double of_mean = fades ? std::min(1.0, 0.5 * exact_log2(area) - 1) : 0;
  const auto each = [&](int probes, auto&& add) {
    for (int i = 0; i < probes; ++i) {
      const double along = probes == 1 ? 0 : (i + 0.5) / probes - 0.5;
      add(along * x * major / graph.unit.width, along * y * major / graph.unit.height);
    }
  };
  if (of_mean < 1)
    each(count, [&](double u, double v) {
      const PixelPlan::Sample probe{u, v, level_of_width(minor), (1 - of_mean) / count};
      if (plan.filter == Filter::trilinear)
        add_probe(plan, probe);
      else
        plan.samples.push_back(probe);
    });
  if (of_mean > 0) {
    const int regions = std::min(count, most_means_of_pixel);
    each(regions, [&](double u, double v) { plan.means.push_back({u, v, 0, of_mean / regions}); });
    const double width = std::max(minor, count > 1 ? major / regions : major);
    plan.width_u = width / graph.unit.width;
    plan.width_v = width / graph.unit.height;
  }
}

PixelPlan PatternTexture::State::plan(const Footprint& footprint) const {
  PixelPlan plan;
  plan.filter = filter_of(options.filter);
  if (options.filter == PatternFilter::supersampled) {
    const int k = options.samples;
    for (int j = 0; j < k; ++j)
      for (int i = 0; i < k; ++i) {
        const double across = (i + 0.5) / k - 0.5, down = (j + 0.5) / k - 0.5;
        plan.samples.push_back({across * footprint.u_across + down * footprint.u_down,
                                across * footprint.v_across + down * footprint.v_down, -64, 1.0 / (k * k)});
      }
    return plan;
  }
  const FootprintEllipse covered = ellipse_of(footprint, graph.unit);
  if (options.filter != PatternFilter::anisotropic || !(covered.major > 1)) {
    add_ellipse(plan, covered.major, covered.major, 1, 0, 0);
    return plan;
  }
  const double ratio = covered.major / std::max(covered.minor, 1.0);
  const int count =
      static_cast<int>(std::clamp(std::ceil(ratio), 1.0, static_cast<double>(most_probes_of_pixel)));
  add_ellipse(plan, covered.major, std::max(covered.minor, covered.major / most_probes_of_pixel), count,
              covered.x, covered.y);
  return plan;
}

const CoarseMap& PatternTexture::State::coarse_map() const {
  if (const CoarseMap* map_there = coarse.load(std::memory_order_acquire)) return *map_there;
  const std::scoped_lock lock(building);
  if (!coarse_owned) {
    // Isolated: while it waits for its rows, this thread must not take up other work that waits for the lock.
    tbb::this_task_arena::isolate([&] {
      coarse_owned = std::make_unique<CoarseMap>(runs, graph.output, map, graph.scene, finest, graph.unit);
    });
    coarse.store(coarse_owned.get(), std::memory_order_release);
  }
  return *coarse_owned;
}

// In pieces that lie within the scene.
void PatternTexture::State::evaluate(const PatternRun& run, const RunLookup& lookup,
                                     const RunValues& out) const {
  for (std::size_t first = 0; first < run.count;) {
    PatternRun part = run.part(first, run.count - first);
    part.place.u = within(part.place.u, graph.scene.width, WrapMode::wrap);
    part.place.v = within(part.place.v, graph.scene.height, WrapMode::wrap);
    part.count = pixels_to_border(part.place.u, part.step_u, graph.scene.width, part.count);
    part.count = pixels_to_border(part.place.v, part.step_v, graph.scene.height, part.count);
    runs.evaluate(graph.output, part, lookup, out.from(first));
    first += part.count;
  }
}

void PatternTexture::State::add_means(const PatternRun& run, const PixelPlan& plan, double (*sums)[5]) const {
  const TileMapping mapping(finest, graph.scene);
  const bool stored = has_coarse_map();
  for (std::size_t i = 0; i < run.count; ++i)
    for (const PixelPlan::Sample& at : plan.means) {
      PatternPlace place = run.at(i);
      place.u.fraction += at.u;
      place.v.fraction += at.v;
      std::array<double, 4> value{};
      double cover = 0;
      if (stored) {
        const double width = std::max(plan.width_u, plan.width_v) * cells_a_unit();
        coarse_map().add(mapping.x.cell_of(place.u), mapping.y.cell_of(place.v), width, at.weight, value,
                         cover);
      } else {
        const PatternMeans::Mean mean = means.mean(graph.output, place, plan.width_u, plan.width_v);
        cover = at.weight * mean.cover;
        for (std::size_t c = 0; c < channels; ++c) value[c] = cover * mean.value[c];
      }
      for (std::size_t c = 0; c < channels; ++c) sums[i][c] += value[c];
      sums[i][4] += cover;
    }
}

// At most longest_run pixels.
void PatternTexture::State::run(const PatternRun& run, const PixelPlan& plan,
                                std::span<float* const> out) const {
  RunBuffer buffer;
  RunValues to = buffer.view(); // straight where they go
  for (std::size_t c = 0; c < channels; ++c) to.value[c] = out[c];
  if (out.size() > channels) to.cover = out[channels];
  if (plan.samples.size() == 1 && plan.means.empty()) {
    evaluate(run, {map, plan.samples[0].level, plan.filter}, to);
    return finish(to, run.count);
  }
  double sums[longest_run][5] = {};
  for (const PixelPlan::Sample& sample : plan.samples) {
    PatternRun moved = run;
    moved.place.u.fraction += sample.u;
    moved.place.v.fraction += sample.v;
    evaluate(moved, {map, sample.level, plan.filter}, buffer.view());
    for (std::size_t i = 0; i < run.count; ++i) {
      const double share = sample.weight * static_cast<double>(buffer.cover[i]);
      for (std::size_t c = 0; c < channels; ++c)
        sums[i][c] += share * static_cast<double>(buffer.value[c][i]);
      sums[i][4] += share;
    }
  }
  if (!plan.means.empty()) add_means(run, plan, sums);
  for (std::size_t i = 0; i < run.count; ++i) {
    const double cover = sums[i][4];
    for (std::size_t c = 0; c < channels; ++c)
      to.value[c][i] = cover > 0 ? static_cast<float>(sums[i][c] / cover) : 0.0f;
    to.cover[i] = static_cast<float>(std::min(cover, 1.0));
  }
  finish(to, run.count);
}

// Values and cover as the map has them: what isn't covered is clear, or 0.
void PatternTexture::State::finish(const RunValues& out, std::size_t count) const {
  const bool alpha = graph.maps[static_cast<std::size_t>(map)].has_alpha();
  int not_covered = 0;
  for (std::size_t i = 0; i < count; ++i) not_covered += out.cover[i] != 1.0f ? 1 : 0;
  for (std::size_t c = 0; c < channels && not_covered > 0; ++c) {
    const float nothing = !vectors ? 0.0f : c < 2 ? 0.5f : 1.0f;
    float* value = out.value[c];
    for (std::size_t i = 0; i < count; ++i) {
      const float cover = out.cover[i];
      value[i] = alpha ? (cover > 0 ? value[i] : 0.0f) : value[i] * cover + (1 - cover) * nothing;
    }
  }
  if (!vectors || options.filter == PatternFilter::nearest) return;
  for (std::size_t i = 0; i < count; ++i) {
    std::array<float, 3> normal{out.value[0][i], out.value[1][i], out.value[2][i]};
    renormalise(std::span<float>(normal));
    for (std::size_t c = 0; c < 3; ++c) out.value[c][i] = normal[c];
  }
}

PatternTexture::PatternTexture(const PatternGraph& graph, int map, const PatternOptions& options) {
  check_pattern_graph(graph);
  if (map < 0 || static_cast<std::size_t>(map) >= graph.maps.size())
    throw Error(ErrorKind::usage, field("map"),
                fmt::format("{}; the scene has maps 0 to {}", map, graph.maps.size() - 1));
  if (!(std::fabs(options.time) <= 0x1p40))
    throw Error(ErrorKind::usage, field("time"),
                fmt::format("{}; steps of time are up to 2^40", options.time));
  if (options.samples < 1 || options.samples > most_samples || options.coarse_map < 0 ||
      options.coarse_map > longest_coarse_map)
    throw Error(
        ErrorKind::usage, "filter",
        fmt::format("{} samples a side and a coarse map of {}; there are 1 to {} samples, and maps to {}",
                    options.samples, options.coarse_map, most_samples, longest_coarse_map));
  state = std::make_unique<State>(graph, map, options);
}
PatternTexture::~PatternTexture() = default;

int PatternTexture::channels() const {
  return state->graph.maps[static_cast<std::size_t>(state->map)].channels;
}

void PatternTexture::sample(TileCoordinate u, TileCoordinate v, const Footprint& footprint,
                            std::span<double> out) const {
  std::array<float, 4> values{};
  std::array<float*, 4> to{};
  for (std::size_t c = 0; c < 4; ++c) to[c] = &values[c];
  const PatternRun run{{normalised(u), normalised(v)}, 0, 0, 1};
  state->run(run, state->plan(footprint), {to.data(), out.size()});
  for (std::size_t c = 0; c < out.size(); ++c) out[c] = static_cast<double>(values[c]);
}

void PatternTexture::sample_run(const PatternRun& run, const Footprint& footprint,
                                std::span<float* const> out) const {
  const PixelPlan plan = state->plan(footprint);
  PatternRun whole = run;
  whole.place = {normalised(run.place.u), normalised(run.place.v)};
  for (std::size_t first = 0; first < run.count; first += longest_run) {
    std::array<float*, 4> to{};
    for (std::size_t c = 0; c < out.size(); ++c) to[c] = out[c] + first;
    state->run(whole.part(first, std::min(longest_run, run.count - first)), plan, {to.data(), out.size()});
  }
}

std::vector<bool> PatternTexture::used_nodes() const {
  return state->values.used_nodes();
}

std::size_t PatternTexture::bytes() const {
  const CoarseMap* coarse = state->coarse.load();
  return state->means.bytes() + (coarse == nullptr ? 0 : coarse->bytes());
}

PatternTexture::Mean PatternTexture::mean_error(const PatternPlace& place, const Footprint& footprint) const {
  const FootprintEllipse covered = ellipse_of(footprint, state->graph.unit);
  const double width_u = covered.major / state->graph.unit.width,
               width_v = covered.major / state->graph.unit.height;
  const PatternMeans::Mean mean = state->means.mean(state->graph.output, place, width_u, width_v);
  Mean result;
  const bool alpha = static_cast<std::size_t>(channels()) > state->channels;
  for (std::size_t c = 0; c < state->channels; ++c)
    result.value.push_back(mean.value[c] * (alpha ? 1 : mean.cover));
  if (alpha) result.value.push_back(mean.cover);
  const double cells =
      width_u * width_v * static_cast<double>(state->finest.width) *
      static_cast<double>(state->finest.height) /
      (static_cast<double>(state->graph.scene.width) * static_cast<double>(state->graph.scene.height));
  for (std::size_t c = 0; c < state->channels; ++c)
    result.error = std::max(result.error, std::sqrt(mean.variance[c] / std::max(cells, 1.0)));
  return result;
}

std::int64_t index_at(const PatternGraph& graph, NodeId node, const PatternPlace& place, double time) {
  if (node < 0 || static_cast<std::size_t>(node) >= graph.nodes.size() ||
      kind_of(graph.nodes[static_cast<std::size_t>(node)].block) != ValueKind::index)
    throw Error(ErrorKind::usage, "node", fmt::format("number {} gives no index", node));
  return PatternValues(graph, time).index(node, place);
}

double number_at(const PatternGraph& graph, NodeId node, const PatternPlace& place, double time) {
  if (node < 0 || static_cast<std::size_t>(node) >= graph.nodes.size() ||
      kind_of(graph.nodes[static_cast<std::size_t>(node)].block) != ValueKind::number)
    throw Error(ErrorKind::usage, "node", fmt::format("number {} gives no number", node));
  return PatternValues(graph, time).number(node, place);
}

} // namespace tilepack
