#include "tilepack/bench/span_bench.h"
#include "tilepack/scanline/span_method.h"

#include <fmt/format.h>

#include <algorithm>

namespace tilepack {
namespace {

constexpr double negligible = 0.1;     // pixels nobody sees
constexpr double tie_factor = 1.1; // times nearer than that are a tie, and a tie goes to plain division
constexpr double busy_machine = 0.5;   // typical spread of runs, over their median
constexpr const char* judged_on = "horizon 100 pixels behind"; // SpanShape::steep

const SpanFigures& figures_of(const SpanBench& bench, SpanMethod method, int reseed) {
  return *std::find_if(bench.methods.begin(), bench.methods.end(), [&](const SpanFigures& f) {
    return f.precision == SpanPrecision::f32 && f.options.method == method && f.options.reseed == reseed;
  });
}

// Of the methods of a precision whose error on steep spans nobody sees; null if there is none.
const SpanFigures* fastest(const SpanBench& bench, SpanPrecision precision, double SpanFigures::*time) {
  const SpanFigures* best = nullptr;
  for (const SpanFigures& f : bench.methods)
    if (f.precision == precision && error_of(f, SpanShape::steep).pixels <= negligible &&
        (!best || f.*time < best->*time))
      best = &f;
  return best;
}

void advise_fastest(const SpanBench& bench, SpanPrecision precision, double SpanFigures::*time,
                    const char* how, std::vector<std::string>& advice) {
  const auto division = std::find_if(bench.methods.begin(), bench.methods.end(), [&](const SpanFigures& f) {
    return f.precision == precision && f.options.method == SpanMethod::exact;
  });
  const SpanFigures* best = fastest(bench, precision, time);
  if (division == bench.methods.end() || !best) return;
  const double best_ns = best->*time;
  const double division_ns = (*division).*time;
  advice.push_back(
      division_ns < tie_factor * best_ns
          ? fmt::format("{}, {}: plain division has won, {:.2f} ns a pixel; nothing within {} pixels ({}) is "
                        "10 % faster.",
                        name_of(precision), how, division_ns, negligible, judged_on)
          : fmt::format("{}, {}: {} is the fastest within {} pixels ({}), {:.2f} ns a pixel; division takes "
                        "{:.2f}, {:.2f} times as long.",
                        name_of(precision), how, name_of(best->options), negligible, judged_on, best_ns,
                        division_ns, division_ns / best_ns));
}

void advise_recurrence(const SpanBench& bench, std::vector<std::string>& advice) {
  const auto error = [&](SpanMethod method, int reseed, SpanShape shape) {
    return error_of(figures_of(bench, method, reseed), shape).pixels;
  };
  advice.emplace_back("One scanline at a time a recurrence waits for each of its steps, while divisions of "
                      "neighbouring pixels overlap: recurrences want many scanlines at once.");
  advice.push_back(fmt::format(
      "Of the recurrences take newton-direct: over 16384 pixels in f32 it is {:.2g} pixels off, newton "
      "{:.2g} and newton-general {:.2g}, whose coefficients are sums that drift; an exact value every 32 "
      "pixels brings newton to {:.2g}.",
      error(SpanMethod::newton_direct, 0, SpanShape::long_run),
      error(SpanMethod::newton, 0, SpanShape::long_run),
      error(SpanMethod::newton_general, 0, SpanShape::long_run),
      error(SpanMethod::newton, 32, SpanShape::long_run)));
  advice.push_back(fmt::format(
      "euler2 every 8 pixels is the most exact of them near the horizon: {:.2g} pixels where it is 5 pixels "
      "behind the last, newton-direct {:.2g}, affine every 8 pixels {:.2g}.",
      error(SpanMethod::euler2, 8, SpanShape::grazing),
      error(SpanMethod::newton_direct, 0, SpanShape::grazing),
      error(SpanMethod::affine, 8, SpanShape::grazing)));
}

// Division in f32, the first method that a textured view can be stepped by without loss.
double division_in_view(const SpanBench& bench) {
  for (const ViewFigures& view : bench.views)
    if (view.precision == SpanPrecision::f32 && view.options.method == SpanMethod::exact)
      return view.stepping;
  return 0;
}

void advise_busy(const SpanBench& bench, std::vector<std::string>& advice) {
  std::vector<double> spreads;
  for (const SpanFigures& f : bench.methods) spreads.push_back(f.spread);
  std::sort(spreads.begin(), spreads.end());
  if (const double typical = spreads[spreads.size() / 2]; typical > busy_machine)
    advice.push_back(
        fmt::format("The machine was busy: runs of one method differ by {:.0f} % of their median. "
                    "Times near each other mean nothing then; measure again.",
                    100 * typical));
}

} // namespace

std::vector<std::string> span_advice(const SpanBench& bench) {
  std::vector<std::string> advice;
  for (const SpanPrecision precision : {SpanPrecision::f32, SpanPrecision::f64}) {
    advise_fastest(bench, precision, &SpanFigures::side_by_side, "32 scanlines side by side", advice);
    advise_fastest(bench, precision, &SpanFigures::one_by_one, "one scanline at a time", advice);
  }
  advise_recurrence(bench, advice);
  if (bench.texturing > 0)
    advice.push_back(fmt::format("In a textured view all of this is small change: set-up {:.2f}, stepping "
                                 "{:.2f} (division), texturing {:.0f} ns a pixel.",
                                 bench.set_up, division_in_view(bench), bench.texturing));
  advice.push_back(fmt::format(
      "f64 is not needed: offsets from the start of a span are within {:.2g} pixels in f32 by division, over "
      "16384 pixels.",
      error_of(figures_of(bench, SpanMethod::exact, 0), SpanShape::long_run).pixels));
  advise_busy(bench, advice);
  return advice;
}

} // namespace tilepack
