#include "tilepack/bake/bake.h"
#include "tilepack/bake/bake_fields.h"
#include "tilepack/bake/prepared_sample.h"
#include "tilepack/bake/tile_size_choice.h"
#include "tilepack/error/error.h"
#include "tilepack/exemplar/object_scale.h"
#include "tilepack/numeric/side_by_side.h"
#include "tilepack/synth/framed_set_settings.h"
#include "tilepack/tileset/limits.h"
#include "tilepack/transition/joined_samples.h"
#include "tilepack/transition/transition_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace tilepack {
namespace {

using MaterialList = std::span<const TransitionMaterial>;

void check_maps_alike(MaterialList materials) {
  std::vector<std::span<const SampleMap>> maps;
  for (const TransitionMaterial& material : materials) maps.emplace_back(material.maps);
  require_joinable(maps);
}

// The largest of the sides that suit the materials, at most half of each sample's; 0: the options have a size. What is large
// needs large tiles, and what is small is shown well by any.
int side_for(MaterialList materials, const BakeOptions& options, int tiles) {
  if (!options.fit_tile_size) return 0;
  std::vector<int> sides(materials.size());
  Size least = materials.front().maps[0].image.size();
  each_side_by_side(materials.size(), [&](std::size_t m) {
    const std::vector<SampleMap>& maps = materials[m].maps;
    sides[m] = tile_side_for(maps[0].image.size(), object_scale(feature_image(maps)), tiles);
  });
  for (const TransitionMaterial& material : materials) {
    const Size size = material.maps[0].image.size();
    least = {std::min(least.width, size.width), std::min(least.height, size.height)};
  }
  return std::min(*std::max_element(sides.begin(), sides.end()), largest_tile_side_for(least, tiles));
}

// In step with the first material that repeats along an axis.
Size size_in_step(const std::vector<PreparedSample>& prepared, int side) {
  Periodicity periods;
  Size least = prepared.front().size;
  for (const PreparedSample& sample : prepared) {
    least = {std::min(least.width, sample.size.width), std::min(least.height, sample.size.height)};
    if (!sample.periods) continue;
    if (periods.x.length <= 0) periods.x = sample.periods->x;
    if (periods.y.length <= 0) periods.y = sample.periods->y;
  }
  return tile_size_in_step(periods, side, least);
}

// Of each figure the mean over the materials.
SetFigures mean_figures(const std::vector<BakedMaterial>& materials) {
  SetFigures mean;
  for (const SetFigureField& field : set_figure_fields) {
    double sum = 0;
    for (const BakedMaterial& material : materials) sum += material.report.figures.*field.value;
    mean.*field.value = std::round(sum / static_cast<double>(materials.size()) * 1e4) / 1e4;
  }
  return mean;
}

} // namespace

int usual_transition_variants(int colors, int materials) {
  if (colors > materials) return 1;
  return materials <= 2 ? 4 : materials == 3 ? 3 : 2;
}

BakeOptions transition_options(BakeOptions options, int materials, bool colors_asked, bool variants_asked) {
  if (materials < 2 || materials > limits::most_corner_colors)
    throw Error(ErrorKind::usage, field("transition"),
                fmt::format("leads between 2 to {} materials, and {} {} given", limits::most_corner_colors,
                            materials, materials == 1 ? "is" : "are"));
  if (options.synth.coloring != Coloring::corner)
    throw Error(ErrorKind::usage, field("coloring"),
                "'edge' does not go with " + field("transition") + ", whose corners are materials");
  const int colors = colors_asked ? options.synth.colors.corner : materials;
  if (colors % materials != 0 || colors > limits::most_corner_colors)
    throw Error(
        ErrorKind::usage, field("colors"),
        fmt::format("{} does not go with {} of {} materials, each of which has as many corner colors; {}",
                    colors, field("transition"), materials,
                    materials == 2 ? "use 2, or 4 for more variety" : "leave it away"));
  if (options.synth.interior == Construction::quilt)
    throw Error(ErrorKind::usage, field("interior"),
                "'quilt' does not go with " + field("transition") + "; use " + field("interior", "patch"));
  if (options.set == SetKind::sequential)
    throw Error(ErrorKind::usage, field("set"),
                "'sequential' does not go with " + field("transition") + ": any corners may meet");
  options.synth.colors.corner = colors;
  if (!variants_asked) options.synth.colors.variants = usual_transition_variants(colors, materials);
  return options;
}

BakedPack baked_transition(MaterialList materials, const BakeOptions& options, const Progress& progress) {
  for (const TransitionMaterial& material : materials) check_samples(material.maps, options);
  check_maps_alike(materials);
  check_set_choice(options);
  const TileColors wanted = complete_set(options.synth.colors);
  BakedPack result;
  result.synth = options.synth;
  const int tiles_of_each =
      std::max(1, tile_count(wanted) / static_cast<int>(materials.size())); // memory is bounded by samples
  const int side = side_for(materials, options, tiles_of_each);
  std::vector<PreparedSample> prepared;
  for (const TransitionMaterial& material : materials)
    prepared.push_back(straightened_sample(material.maps, options, tile_count(wanted), side));
  if (side > 0)
    result.synth.tile_size =
        options.layout == LayoutKind::rotated ? Size{side, side} : size_in_step(prepared, side);
  const Size tile = result.synth.tile_size;
  const PackingPlan plan = planned_packing(options, wanted, tile); // before the long stage
  for (std::size_t m = 0; m < materials.size(); ++m) check_fit(prepared[m].used(materials[m].maps)[0], tile);
  result.flatten = options.flatten;
  result.flatten_chosen = options.fit_flatten;
  result.size_chosen = options.fit_tile_size;

  std::vector<std::span<const SampleMap>> used;
  for (std::size_t m = 0; m < materials.size(); ++m) {
    finish_sample(prepared[m], materials[m].maps, options, tile);
    BakedMaterial material;
    material.name = materials[m].name;
    material.wrap = prepared[m].wrap;
    material.straightened = prepared[m].straightened;
    material.flatten = prepared[m].tones.flatten;
    material.size = prepared[m].size;
    used.push_back(prepared[m].used(materials[m].maps));
    material.sample = analysed(used.back(), prepared[m].periods, halvings_to_usual(tile));
    result.materials.push_back(std::move(material));
  }
  JoinedSamples joined = tilepack::joined(used);
  std::vector<const SampleAnalysis*> analyses;
  for (const BakedMaterial& material : result.materials) analyses.push_back(&material.sample);

  TransitionSet set = transition_set(joined, analyses, result.synth, progress);
  report(progress, "figures", 0.0);
  result.transition = set.figures;
  each_side_by_side(materials.size() + 2, [&](std::size_t i) {
    if (i < materials.size()) {
      BakedMaterial& material = result.materials[i];
      material.report = set_report(material.sample, set.layers[i], material.size);
    } else if (i == materials.size()) {
      result.sample = analysed(feature_image(joined.maps), {}, halvings_to_usual(tile));
      result.report = set_report(result.sample, set.sources);
    } else {
      result.pack = packed(assembled(set.sources, joined.maps), plan, options.synth.seed, progress);
    }
  });
  result.report.figures = mean_figures(result.materials);
  result.report.landmark = {};
  result.sources = std::move(set.sources);
  result.prepared = std::move(joined.maps);
  const std::size_t colors_of_each = static_cast<std::size_t>(options.synth.colors.corner) / materials.size();
  for (const TransitionMaterial& material : materials)
    result.pack.materials.insert(result.pack.materials.end(), colors_of_each, material.name);
  result.pack.generator.version = TILEPACK_VERSION;
  result.pack.generator.options = recorded_options(options);
  result.pack.generator.seed = options.synth.seed;
  result.pack.synthesis = result.report.figures;
  return result;
}

} // namespace tilepack
