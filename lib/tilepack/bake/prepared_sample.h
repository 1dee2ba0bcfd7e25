#pragma once

#include "tilepack/bake/bake_options.h"
#include "tilepack/exemplar/period.h"
#include "tilepack/exemplar/sample_wrap.h"
#include "tilepack/exemplar/tone_choice.h"
#include "tilepack/tileset/material_map.h"

#include <optional>
#include <span>
#include <vector>

namespace tilepack {

/// The maps of a sample on their way into synthesis: straightened, continued where they wrap, flattened.
struct PreparedSample {
  std::vector<SampleMap> maps;        ///< none: as given
  std::optional<Periodicity> periods; ///< where they are known already
  SampleWrap wrap;                    ///< along which axes the sample is continued by itself
  double straightened = 0;            ///< texels, the furthest that a course was moved; 0: none was
  Size size;                          ///< texels, before it is continued
  int side = 0;                       ///< of the square tile that suits the sample; 0: it was not asked for
  ToneChoice tones;                   ///< how it was flattened

  std::span<const SampleMap> used(std::span<const SampleMap> given) const {
    return maps.empty() ? given : std::span<const SampleMap>(maps);
  }
};

/// Refuses numbers of colors and variants that are out of range, and sets that there are not. Error (usage).
void check_set_choice(const BakeOptions& options);

/// Refuses maps of several sizes: Error (invalid_content).
void check_one_size(std::span<const SampleMap> samples);

/// Refuses what can't be one material, or can't be stored as the options have it. Error as of baked().
void check_samples(std::span<const SampleMap> samples, const BakeOptions& options);

/// Refuses samples that are too small for the tile.
void check_fit(const SampleMap& sample, Size tile);

/// Looks at the sample, and straightens it where it is uneven. `tiles`: of the set, for the size of tiles if options ask
/// for a fitted one; `side`: one that was settled before, 0: none was.
PreparedSample straightened_sample(std::span<const SampleMap> samples, const BakeOptions& options, int tiles,
                                   int side = 0);

/// Then, with the size of tiles settled: continues the sample where it wraps, and flattens it. Error (usage) for a
/// flatten that is no percentage.
void finish_sample(PreparedSample& sample, std::span<const SampleMap> given, const BakeOptions& options,
                   Size tile);

} // namespace tilepack
