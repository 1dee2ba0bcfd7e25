#include "tilepack/scanline/span_batch.h"

#include "tilepack/scanline/span_constants.h"
#include "tilepack/scanline/span_lanes.h"
#include "tilepack/scanline/span_method.h"

#include <hwy/targets.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

namespace tilepack {

template <class Real>
void fill_spans(std::span<const Span> spans, const SpanOptions& options, SpanBatch<Real>& batch,
                BatchArithmetic arithmetic) {
  check_reseed(options);
  if (spans.size() > scanlines_side_by_side) {
    throw std::invalid_argument(std::to_string(spans.size()) + " spans in a batch; at most " +
                                std::to_string(scanlines_side_by_side) + " fit");
  }
  SpanLanes<Real> lanes;
  std::array<int, scanlines_side_by_side> steppable{};
  int longest = 0, deepest = 0;
  for (std::size_t i = 0; i < spans.size(); ++i) {
    lanes.bend[i] = static_cast<Real>(spans[i].bend);
    lanes.du[i] = static_cast<Real>(spans[i].du);
    lanes.dv[i] = static_cast<Real>(spans[i].dv);
    steppable[i] = steppable_pixels(spans[i], options, rounding_unit<Real>);
    lanes.last[i] = static_cast<Real>(steppable[i] - 1);
    longest = std::max(longest, spans[i].count);
    deepest = std::max(deepest, steppable[i]);
  }
  const std::size_t entries = static_cast<std::size_t>(longest) * scanlines_side_by_side;
  if (batch.u.size() < entries) {
    batch.u.resize(entries);
    batch.v.resize(entries);
  }

  // The piece's length may depend on the longest span only where the method has a single piece.
  const int piece = piece_length(options, deepest);
  step_lanes(lanes, {options.method, piece, deepest, arithmetic == BatchArithmetic::fused}, batch.u.data(),
             batch.v.data());

  for (std::size_t i = 0; i < spans.size(); ++i) {
    for (int n = steppable[i]; n < spans[i].count; ++n) {
      const std::size_t at = lane_index(static_cast<int>(i), n);
      batch.u[at] = static_cast<Real>(exact_offset(spans[i].du, spans[i], n));
      batch.v[at] = static_cast<Real>(exact_offset(spans[i].dv, spans[i], n));
    }
  }
}

template void fill_spans(std::span<const Span>, const SpanOptions&, SpanBatch<float>&, BatchArithmetic);
template void fill_spans(std::span<const Span>, const SpanOptions&, SpanBatch<double>&, BatchArithmetic);

} // namespace tilepack
