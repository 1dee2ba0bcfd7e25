#pragma once

#include "tilepack/json/json_value.h"
#include "tilepack/layout/layout_search.h"
#include "tilepack/pack/pack.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace tilepack {

/// What is to be known of layouts without waste: tiles of which side, how far apart, and on which image the
/// loss of turning them is measured.
struct LayoutQuestion {
  int tile_side = 128; ///< texels, 1..4096
  int gutter = 0;      ///< texels round each tile, 0..tile_side
  bool power_of_two = false;
  std::optional<SampleMap> sample; ///< absent: no loss is measured
};

struct LayoutAnswer {
  LayoutCandidate candidate;
  double wasted_percent = 0;     ///< of the texture
  std::vector<RoundTrip> losses; ///< of storing windows of the sample and reading them back
};

/// For one count of tiles: its layouts, best first, beside padding to powers of two.
struct LayoutAnswers {
  int tiles = 0;
  std::vector<LayoutAnswer> layouts;
  std::int64_t padded_texels = 0; ///< of the padded texture
  double padded_percent = 0;      ///< of it that stays empty
};

/// Throws as layout_plans() and round_trips() do.
LayoutAnswers layout_answers(int tiles, const LayoutQuestion& question);

/// Counts of tiles up to `most` that a layout holds without waste, rising.
std::vector<int> counts_without_waste(int most);

JsonValue layout_answers_value(const LayoutAnswers& answers);

} // namespace tilepack
