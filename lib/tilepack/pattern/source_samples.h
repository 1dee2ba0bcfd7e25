#pragma once

#include "tilepack/pattern/pattern_source.h"
#include "tilepack/pattern/run_values.h"
#include "tilepack/sampler/filter.h"

#include <cstdint>

namespace tilepack {

/// Lookups in one source, gathered and done together.
struct SourceSamples {
  alignas(64) std::int32_t tile_x[longest_run];
  alignas(64) std::int32_t tile_y[longest_run];
  alignas(64) float x[longest_run];
  alignas(64) float y[longest_run];
  alignas(64) float level[longest_run]; ///< of the source, 0 its finest
  std::size_t count = 0;
};

/// Looks up map `map` of the graph, of `channels` values. A source without that map gives 0, of normals (0.5, 0.5, 1).
/// Coverage is the source's alpha, 1 if it has none. `finest`: the lowest level asked for, which is opened if need be. (Levels are
/// overwritten.)
struct SourceLookup {
  const PatternSource& source;
  PatternSource::Use use = PatternSource::Use::patterns;
  int map = 0;
  int channels = 0;
  bool vectors = false; ///< the map holds normals
  Filter filter = Filter::trilinear;

  void sample(SourceSamples& samples, double finest, const RunValues& out) const;

private:
  void sample_map(int of_map, SourceSamples& samples, double finest, bool alpha, int wanted,
                  const RunValues& out) const;
};

} // namespace tilepack
