#pragma once

#include "console.h"

#include "tilepack/bench/span_study.h"
#include "tilepack/scanline/view_spans.h"

#include <optional>
#include <string>
#include <vector>

namespace tilepack::cli {

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

/// What `tilepack bench --spans` prints and writes.
std::string spans_text(const SpanBench& bench);
std::string spans_json(const SpanBench& bench);
std::string spans_html(const SpanBench& bench);

struct SpanBenchArguments {
  std::string pack;   ///< empty: the view is stepped, but not textured
  std::string report; ///< HTML file, or empty
  std::string format = "text";
  bool quick = false; ///< one rough round of timing, a small view
};

/// Measures, prints, and writes the report. Throws Error (check_failed) if an answer is wrong before timing.
int bench_spans(const SpanBenchArguments& arguments, Console& console);

} // namespace tilepack::cli
