#include "tilepack/report/bake_facts.h"

#include "tilepack/exemplar/feature_image.h"
#include "tilepack/exemplar/fireflies.h"
#include "tilepack/exemplar/flatten.h"
#include "tilepack/mip/level_size.h"
#include "tilepack/report/verdict_thresholds.h"
#include "tilepack/tileset/value_space.h"

namespace tilepack {
namespace {

// Of a material as a set by itself: its corner colors, and one for where it is not shown.
BakeFacts material_facts(const BakedPack& made, const BakedMaterial& material) {
  BakeFacts facts;
  facts.report = material.report;
  facts.nature = sample_traits(material.sample.features, material.sample.periods, made.synth.tile_size);
  facts.synth = made.synth;
  facts.synth.colors.corner = 1 + made.synth.colors.corner / static_cast<int>(made.materials.size());
  facts.flatten = material.flatten;
  facts.tones_chosen = made.flatten_chosen && material.flatten > 0;
  facts.flat_drift = facts.nature.drift; // what flattening would leave is not found out
  facts.sample = material.size;
  facts.tiles = combinations(facts.synth.colors) * facts.synth.colors.variants;
  facts.size_chosen = made.size_chosen;
  facts.straightened = material.straightened;
  facts.material = material.name;
  return facts;
}

bool is_clear(const SampleMap& map) {
  if (!value_space(map).has_alpha()) return false;
  for (int y = 0; y < map.image.height(); ++y)
    for (int x = 0; x < map.image.width(); ++x)
      if (map.image.texel(x, y).back() > 0) return false;
  return true;
}

} // namespace

bool has_shading(const SampleTraits& nature) {
  return nature.shading > verdict_thresholds::shading_fair || nature.drift > verdict_thresholds::drift_fair;
}

bool shows_nothing(const BakeFacts& facts) {
  return facts.report.figures.sample_step == 0;
}

BakeFacts bake_facts(const BakedPack& made, std::span<const SampleMap> samples) {
  constexpr int worst_borders = 3;
  BakeFacts facts{made.report,
                  seam_figures(made.pack, 0, 0, worst_borders),
                  sample_traits(made.sample.features, made.sample.periods, made.synth.tile_size),
                  made.synth,
                  made.flatten,
                  0.0,
                  samples[0].image.size(),
                  tile_count(made.pack.tiles),
                  {},
                  made.size_chosen,
                  made.straightened,
                  made.flatten_chosen && made.flatten > 0,
                  made.levelled};
  if (const Pack& pack = made.pack; pack.mip_mode != MipMode::none && !pack.full_chain)
    facts.coarsest = level_size(pack.tile_size, pack.tile_levels - 1);
  if (!made.materials.empty()) {
    for (const BakedMaterial& material : made.materials)
      facts.materials.push_back(material_facts(made, material));
    facts.transition = made.transition;
    facts.sample = made.prepared.front().image.size();
    facts.size_chosen = false; // what is said of a choice is about one sample
    return facts;
  }
  facts.clear = is_clear(samples[0]);
  for (const SampleMap& map : samples)
    if (facts.fireflies.empty()) facts.fireflies = listed(fireflies(map));
  if (made.flatten < 100 && has_shading(facts.nature)) {
    std::vector<SampleMap> flat;
    for (const SampleMap& map : samples) flat.push_back(flattened(map, 1.0, made.synth.tile_size));
    facts.flat_drift = sample_traits(feature_image(flat), {}, made.synth.tile_size).drift;
  }
  return facts;
}

} // namespace tilepack
