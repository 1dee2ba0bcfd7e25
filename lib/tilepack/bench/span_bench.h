#pragma once

#include "tilepack/bench/span_study.h"
#include "tilepack/error/progress.h"
#include "tilepack/pack/pack.h"
#include "tilepack/scanline/view_spans.h"

#include <optional>
#include <string>
#include <vector>

namespace tilepack {

/// One way to step spans, with what it costs and what it gets wrong. Times in nanoseconds a pixel, medians.
struct SpanFigures {
  SpanOptions options;
  SpanPrecision precision = SpanPrecision::f32;
  double one_by_one = 0;         ///< fill_span
  double side_by_side = 0;       ///< fill_spans
  double fused = 0;              ///< fill_spans with BatchArithmetic::fused
  double spread = 0;             ///< (largest - smallest) / median of the side-by-side runs
  std::vector<SpanError> errors; ///< a case of span_cases() each
};

struct HardFigures {
  std::string name;
  std::vector<HardResult> f32, f64; ///< a StepMethod each
};

/// The ground seen in 1920 x 1080 (quick: 480 x 270), the camera rolled so that scanlines run towards the
/// horizon.
struct ViewFigures {
  SpanOptions options;
  SpanPrecision precision = SpanPrecision::f32;
  double wanted_error = 0;
  double stepping = 0; ///< ns a pixel, one thread
  ViewDifference shift;
  std::optional<double> psnr; ///< dB, against the exact picture in f64; absent where equal or not textured
  bool textured = false;
};

struct SpanBench {
  std::string target; ///< instruction set of the vectors
  std::vector<SpanFigures> methods;
  std::vector<HardFigures> hard;
  std::vector<ErrorCurve> curves;
  Size view_size;
  std::vector<ViewFigures> views;
  std::int64_t view_pixels = 0;
  double set_up = 0;    ///< of the view, ns a pixel, one thread
  double texturing = 0; ///< trilinear with the reference sampler, ns a pixel, one thread; 0 without a pack
  std::vector<std::string> advice;
};

/// "newton-direct, every 16".
std::string name_of(const SpanOptions& options);

/// The errors of one of span_cases().
const SpanError& error_of(const SpanFigures& figures, SpanShape shape);

/// Measures all of it. `pack`: whose first map is laid on the ground seen; null: the view is stepped, but not
/// textured. `quick`: one rough round of timing, a small view. Throws Error (check_failed) if an answer is
/// wrong before it is timed. Times differ from run to run, errors don't.
SpanBench span_bench(const Pack* pack, bool quick, const Progress& progress = {});

/// Which method when, one sentence a line, by fixed rules from the figures.
std::vector<std::string> span_advice(const SpanBench& bench);

/// A table for people, and JSON.
std::string span_bench_text(const SpanBench& bench);
std::string span_bench_json(const SpanBench& bench);

} // namespace tilepack
