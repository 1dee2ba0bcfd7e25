#pragma once

#include "tilepack/scanline/span_constants.h"

/// The vector kernel below fill_spans: internal to span_batch.
namespace tilepack {

/// One entry a scanline. `last` is its last pixel to step to, -1 for none.
template <class Real>
struct SpanLanes {
  alignas(64) Real bend[scanlines_side_by_side] = {};
  alignas(64) Real du[scanlines_side_by_side] = {};
  alignas(64) Real dv[scanlines_side_by_side] = {};
  alignas(64) Real last[scanlines_side_by_side] = {};
};

struct LaneRun {
  SpanMethod method = SpanMethod::exact;
  int piece = 1;      ///< pixels between seeds
  int pixels = 0;     ///< of every lane
  bool fused = false; ///< BatchArithmetic::fused
};

void step_lanes(const SpanLanes<float>& lanes, const LaneRun& run, float* u, float* v);
void step_lanes(const SpanLanes<double>& lanes, const LaneRun& run, double* u, double* v);

} // namespace tilepack
