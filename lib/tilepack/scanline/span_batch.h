#pragma once

#include "tilepack/scanline/span_constants.h"

#include <new>
#include <span>
#include <vector>

namespace tilepack {

/// Memory that begins on a cache line, so that no vector straddles two.
template <class Real>
struct LineAllocator {
  using value_type = Real;
  LineAllocator() = default;
  template <class Other>
  LineAllocator(const LineAllocator<Other>&) {}
  Real* allocate(std::size_t n) {
    return static_cast<Real*>(::operator new(n * sizeof(Real), std::align_val_t(64)));
  }
  void deallocate(Real* p, std::size_t) { ::operator delete(p, std::align_val_t(64)); }
  bool operator==(const LineAllocator&) const = default;
};

/// Offsets of up to 32 spans, pixel by pixel: entry n * 32 + lane is pixel n of span `lane`. Entries at or
/// past a span's count are unspecified.
template <class Real>
struct SpanBatch {
  std::vector<Real, LineAllocator<Real>> u, v;

  Real u_at(int lane, int n) const { return u[lane_index(lane, n)]; }
  Real v_at(int lane, int n) const { return v[lane_index(lane, n)]; }
};

/// What may differ between processors.
enum class BatchArithmetic {
  repeatable, ///< one rounding an operation: bit by bit what fill_span gives, on every processor
  fused, ///< fused multiply-add where the processor has it, and for SpanMethod::estimate in float its own
         ///< reciprocal estimate with one Newton step. Vendors differ in both: for timing only.
};

/// fill_span for up to 32 spans at once, on the widest vectors the processor has (chosen at run time). The
/// batch grows as needed and keeps its memory. Errors as fill_span; std::invalid_argument for over 32 spans.
template <class Real>
void fill_spans(std::span<const Span> spans, const SpanOptions& options, SpanBatch<Real>& batch,
                BatchArithmetic arithmetic = BatchArithmetic::repeatable);

/// The instruction set fill_spans runs on here, such as "AVX2": for reports of timings.
std::string_view batch_target();

} // namespace tilepack
