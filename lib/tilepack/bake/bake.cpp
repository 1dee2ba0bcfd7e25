#include "tilepack/bake/bake.h"

#include "tilepack/bake/bake_fields.h"
#include "tilepack/bake/prepared_sample.h"
#include "tilepack/bake/tile_size_choice.h"
#include "tilepack/exemplar/period.h"
#include "tilepack/numeric/side_by_side.h"
#include "tilepack/synth/framed_set_settings.h"
#include "tilepack/tileset/sequential_set.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace tilepack {
namespace {

// What synthesis took and freed, the C library keeps until it is told.
void give_back_unused_memory() {
#ifdef __GLIBC__
  ::malloc_trim(0);
#endif
}

constexpr std::int64_t most_texels_side_by_side = 2'000'000; // of the sample

TileColors wanted_tiles(const BakeOptions& o) {
  const ColorCounts& k = o.synth.colors;
  if (o.set == SetKind::sequential) return sequential_edge_set(k.horizontal, k.vertical);
  return complete_set(k);
}

// The sources of the tiles of `wanted`, in its order: ids change.
SourceMap subset(SourceMap complete, const TileColors& wanted) {
  if (complete.tiles == wanted) return complete;
  SourceMap chosen{complete.tile_size, complete.colors, wanted, {}, complete.guard};
  for (const EdgeTile& tile : std::get<std::vector<EdgeTile>>(wanted)) {
    const int id = id_in_complete_set(tile, complete.colors.horizontal, complete.colors.vertical);
    chosen.texels.push_back(std::move(complete.texels[static_cast<std::size_t>(id)])); // no tile twice
  }
  return chosen;
}

} // namespace

Pack bake(std::span<const SampleMap> samples, const BakeOptions& options, const Progress& progress) {
  return baked(samples, options, progress).pack;
}

BakedPack baked(std::span<const SampleMap> samples, const BakeOptions& options, const Progress& progress) {
  check_samples(samples, options);
  SynthOptions synth = options.synth;
  check_set_choice(options);
  const TileColors wanted = wanted_tiles(options);
  PreparedSample prepared = straightened_sample(samples, options, tile_count(wanted));
  if (prepared.side > 0) // only squares can be turned
    synth.tile_size = options.layout == LayoutKind::rotated
                          ? Size{prepared.side, prepared.side}
                          : tile_size_in_step(*prepared.periods, prepared.side, prepared.size);
  const PackingPlan plan = planned_packing(options, wanted, synth.tile_size); // before the long stage
  check_fit(prepared.used(samples)[0], synth.tile_size);
  BakedPack result;
  result.synth = synth;
  result.size_chosen = options.fit_tile_size;
  if (options.flatten > 0 || options.fit_flatten) report(progress, "flattening", 0.0);
  finish_sample(prepared, samples, options, synth.tile_size);
  result.flatten = prepared.tones.flatten;
  result.flatten_chosen = options.fit_flatten;
  result.levelled = prepared.tones.courses.has_value();
  result.wrap = prepared.wrap;
  result.straightened = prepared.straightened;
  result.prepared = std::move(prepared.maps);
  samples = result.samples_used(samples);
  const Size size = prepared.size;
  const std::optional<Periodicity>& periods = prepared.periods;
  result.sample = analysed(samples, periods, halvings_to_usual(synth.tile_size));
  result.sources = subset(synthesize(result.sample, synth, progress), wanted);
  report(progress, "figures", 0.0);
  const auto look = [&] { result.report = set_report(result.sample, result.sources, size); };
  const auto pack = [&] {
    result.pack = packed(assembled(result.sources, samples), plan, options.synth.seed, progress);
  };
  // What a large set takes in memory, it takes one after the other.
  if (std::int64_t{size.width} * size.height > most_texels_side_by_side) {
    look();
    give_back_unused_memory();
    pack();
  } else {
    both_side_by_side(look, pack);
  }
  result.pack.generator.version = TILEPACK_VERSION;
  result.pack.generator.options = recorded_options(options);
  result.pack.generator.seed = options.synth.seed;
  result.pack.synthesis = result.report.figures;
  return result;
}

} // namespace tilepack
