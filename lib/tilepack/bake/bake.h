#pragma once

#include "tilepack/bake/bake_options.h"
#include "tilepack/error/progress.h"
#include "tilepack/exemplar/sample_wrap.h"
#include "tilepack/synth/set_report.h"
#include "tilepack/synth/synthesize.h"
#include "tilepack/transition/transition_set.h"

#include <span>
#include <string>
#include <vector>

namespace tilepack {

/// Sample maps → straightening → flattening → synthesis → layout → mips → mapping → pack, in memory. `samples[0]` is
/// the main map; all are as prepare_maps() leaves them.
///
/// Throws Error: usage for options that are out of range, contradict each
/// other or would make a texture over most_texels_a_level; invalid_content for samples of unequal sizes or
/// too small, or with values that the depth asked for can't hold;
/// and what the stages throw. Deterministic as they are.
Pack bake(std::span<const SampleMap> samples, const BakeOptions& options, const Progress& progress = {});

/// A material of a transition (baked_transition), as a set by itself.
struct BakedMaterial {
  std::string name;
  SampleAnalysis sample;   ///< as used: after straightening and flattening
  SetReport report;        ///< of its tiles, shown whole
  SampleWrap wrap;         ///< along which axes the sample was continued by itself
  double straightened = 0; ///< texels, the furthest that a course was moved
  int flatten = 0;         ///< percent, as used
  Size size;               ///< of the sample, before it was continued
};

/// A pack and how it came about, for reports.
struct BakedPack {
  Pack pack;
  SampleAnalysis sample;       ///< as used: after straightening and flattening
  SourceMap sources;           ///< where the pack's tiles come from, by the pack's ids
  SetReport report;            ///< of these sources
  SynthOptions synth;          ///< as used: tile_size is the fitted one
  int flatten = 0;             ///< percent, as used: as in the options, or as tone_choice() has it
  bool flatten_chosen = false; ///< it follows the sample
  bool levelled = false;       ///< flattening went course by course, each of them by itself
  bool size_chosen = false;    ///< synth.tile_size was found to suit the sample

  SampleWrap wrap; ///< along which axes the sample was continued by itself

  /// Texels, the furthest that a course was moved; 0: the sample was not straightened.
  double straightened = 0;

  std::vector<BakedMaterial> materials; ///< of a transition, by corner color; else none
  TransitionFigures transition;         ///< of a transition

  /// The sample maps after straightening and flattening and, where they wrap, continued by a tile to the east and
  /// south, which all above is about; none if they are used as given.
  std::vector<SampleMap> prepared;

  /// The sample maps that the tiles are copied from. `given`: those that baked() got.
  std::span<const SampleMap> samples_used(std::span<const SampleMap> given) const {
    return prepared.empty() ? given : std::span<const SampleMap>(prepared);
  }
};

/// As bake, which returns the pack alone.
BakedPack baked(std::span<const SampleMap> samples, const BakeOptions& options,
                const Progress& progress = {});

/// One of the materials that a transition leads between.
struct TransitionMaterial {
  std::string name;            ///< as the pack calls it (Pack::materials)
  std::vector<SampleMap> maps; ///< in register, as prepare_maps() leaves them
};

/// How many variants each combination gets unless a number is asked for: where each material has one color, few tiles are
/// pure, and they fill all of the plane but its borders.
int usual_transition_variants(int colors, int materials);

/// The options of a transition of so many materials: corner coloring, as many colors for each. `variants_asked`: options have the
/// number that was asked for. Throws Error (usage) for options that a transition can't follow: another number of
/// materials than 2 to 4, edge colors, a number of colors that is no multiple (`colors_asked`: there is one), quilted insides, an incomplete set.
BakeOptions transition_options(BakeOptions options, int materials, bool colors_asked, bool variants_asked);

/// As baked(), but of a complete set whose corner colors are materials: transition_set(). `options`: as
/// transition_options() gives them. All materials get tiles of one size: unless one is asked for, the largest of those that
/// suit each, in step with the first material that repeats.
///
/// The result's sample, sources, report and prepared maps are about the joined sample (transition/joined_samples.h), its
/// figures about the materials, each as a set by itself, in the mean.
BakedPack baked_transition(std::span<const TransitionMaterial> materials, const BakeOptions& options,
                           const Progress& progress = {});

} // namespace tilepack
