#include "tilepack/report/span_bench_page.h"

#include "tilepack/report/html_page.h"
#include "tilepack/report/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace tilepack {
namespace {

std::string short_number(double value) {
  if (!std::isfinite(value)) return "broken";
  return value == 0 ? "0" : fmt::format("{:.2g}", value);
}

// A row of cells; the first is a heading. A cell that starts with '!' is marked.
std::string row(const std::vector<std::string>& cells, const char* tag = "td") {
  std::string html = "<tr>";
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const bool marked = !cells[i].empty() && cells[i][0] == '!';
    const char* const kind = i == 0 ? "th" : tag;
    html += fmt::format("<{}{}>{}</{}>", kind, marked ? " class='bad'" : "",
                        escaped(marked ? cells[i].substr(1) : cells[i]), kind);
  }
  return html + "</tr>\n";
}

int color_of_method(SpanMethod method) {
  return static_cast<int>(method);
}

Plot trade_off(const SpanBench& bench, SpanPrecision precision, SpanShape shape) {
  Plot plot;
  plot.title = fmt::format("{}: error against cost, {}", name_of(precision),
                           span_cases()[static_cast<std::size_t>(shape)].name);
  plot.x_label = "ns a pixel, 32 scanlines side by side";
  plot.y_label = "largest error, pixels";
  plot.log_y = true;
  plot.x_from_zero = true;
  for (const SpanFigures& f : bench.methods) {
    if (f.precision != precision) continue;
    const std::string name(name_of(f.options.method));
    if (plot.series.empty() || plot.series.back().name != name)
      plot.series.push_back({name, {}, {}, false, true, false, color_of_method(f.options.method)});
    plot.series.back().points.emplace_back(f.side_by_side, error_of(f, shape).pixels);
    plot.series.back().labels.push_back(name_of(f.options));
  }
  return plot;
}

std::vector<std::pair<double, double>> paired(const std::vector<double>& x, const std::vector<double>& y) {
  std::vector<std::pair<double, double>> points;
  for (std::size_t i = 0; i < std::min(x.size(), y.size()); ++i)
    if (y[i] > 0) points.emplace_back(x[i], y[i]); // on a logarithm zeros would fill the lower border
  return points;
}

Plot growth(const SpanBench& bench, bool rounding) {
  Plot plot;
  plot.title = rounding ? "What rounding adds: f32 against exact arithmetic"
                        : "Error growth in f32 (dashed: bound in exact arithmetic)";
  plot.x_label = "pixel of a span of 16384, horizon 2000 behind the last";
  plot.y_label = "pixels";
  plot.log_y = true;
  int color = 0;
  for (const ErrorCurve& curve : bench.curves) {
    plot.series.push_back({curve.name,
                           paired(curve.n, rounding ? curve.rounding : curve.total),
                           {},
                           true,
                           false,
                           false,
                           color});
    if (!rounding && !curve.bound.empty() && curve.name.find("added") == std::string::npos)
      plot.series.push_back(
          {curve.name + ", bound", paired(curve.n, curve.bound), {}, true, false, true, color});
    ++color;
  }
  return plot;
}

std::string method_table(const SpanBench& bench) {
  const auto cases = span_cases();
  std::string html = "<table>\n";
  std::vector<std::string> head{"method", "", "alone", "by 32", "spread", "fused"};
  for (const SpanCase& c : cases) head.push_back(c.name);
  html += row(head, "th");
  for (const SpanFigures& f : bench.methods) {
    std::vector<std::string> cells{name_of(f.options),
                                   std::string(name_of(f.precision)),
                                   fmt::format("{:.2f}", f.one_by_one),
                                   fmt::format("{:.2f}", f.side_by_side),
                                   fmt::format("{:.0f} %", 100 * f.spread),
                                   fmt::format("{:.2f}", f.fused)};
    for (const SpanError& e : f.errors) {
      // Beyond its bound by more than the rounding of a division would be.
      const bool beyond = e.beyond > 0.01;
      cells.push_back(fmt::format("{}{} / {} ({})", beyond ? "!" : "", short_number(e.pixels),
                                  short_number(e.bound), short_number(e.texels)));
    }
    html += row(cells);
  }
  return html + "</table>\n";
}

std::string hard_spans_table(const SpanBench& bench) {
  std::string html = "<table>\n";
  std::vector<std::string> head{"case"};
  for (StepMethod c : all_contestants) head.push_back(std::string(name_of(c)));
  html += row(head, "th");
  const auto cell = [](const HardResult& single, const HardResult& full) {
    const bool bad = !std::isfinite(single.relative) || single.pixels > 1;
    const auto text = [](const HardResult& r) {
      return short_number(std::isfinite(r.relative) ? r.pixels : INFINITY);
    };
    return fmt::format("{}{} | {}", bad ? "!" : "", text(single), text(full));
  };
  for (const HardFigures& hard : bench.hard) {
    std::vector<std::string> cells{hard.name};
    for (std::size_t i = 0; i < hard.f32.size(); ++i) cells.push_back(cell(hard.f32[i], hard.f64[i]));
    html += row(cells);
  }
  return html + "</table>\n";
}

std::string view_table(const SpanBench& bench) {
  std::string html = "<table>\n";
  html += row({"method", "", "stepping, ns a pixel", "largest shift, pixels", "texels",
               "texels of the mip read", "PSNR, dB"},
              "th");
  for (const ViewFigures& v : bench.views) {
    const std::string wanted =
        v.wanted_error > 0 ? fmt::format(", re-seeded to stay within {:g} pixels", v.wanted_error) : "";
    html +=
        row({name_of(v.options) + wanted, std::string(name_of(v.precision)),
             v.stepping > 0 ? fmt::format("{:.2f}", v.stepping) : "–", short_number(v.shift.largest_pixels),
             short_number(v.shift.largest_texels), short_number(v.shift.largest_mip_texels),
             !v.textured ? "–"
             : v.psnr    ? fmt::format("{:.1f}", *v.psnr)
                         : "equal"});
  }
  return html + "</table>\n";
}

} // namespace

std::string span_bench_page(const SpanBench& bench) {
  std::string html =
      fmt::format("<h1>Perspective spans: speed against error</h1>\n<p>Vectors: {}. Times are medians of "
                  "eleven runs on this machine, in nanoseconds a pixel, both coordinates; their ratios tell "
                  "more than they do. Errors are measured against long double.</p>\n<h2>Which method "
                  "when</h2>\n<ul>\n",
                  escaped(bench.target));
  for (const std::string& line : bench.advice) html += "<li>" + escaped(line) + "</li>\n";
  html += "</ul>\n<h2>Error against cost</h2>\n<div class='row'>";
  html += svg(trade_off(bench, SpanPrecision::f32, SpanShape::steep)) +
          svg(trade_off(bench, SpanPrecision::f32, SpanShape::grazing));
  html += svg(trade_off(bench, SpanPrecision::f64, SpanShape::steep)) + "</div>\n";
  html +=
      "<p>“alone”: one scanline at a time; “by 32”: side by side in vectors, the same bits; “fused”: with "
      "fused multiply-add and, for estimate in f32, the processor's own reciprocal estimate and one Newton "
      "step (other bits on other processors). Errors: largest in pixels / the theorem's bound (largest in "
      "texels). Marked: rounding carries it more than 0.01 pixels beyond the bound.</p>\n";
  html += method_table(bench);
  html +=
      "<h2>Error growth</h2>\n<p>1/(cn + d) in f32. Euler's steps each add their rounding to all that "
      "follow. Newton corrects what went before, as long as its coefficient is right: computed afresh from n "
      "it stays at the level of division, added up as in Listing 1 the sum drifts and Newton follows it. "
      "An exact value every 64 pixels cures both.</p>\n";
  html += "<div class='row'>" + svg(growth(bench, false)) + svg(growth(bench, true)) + "</div>\n";
  html +=
      "<h2>Hard cases</h2>\n<p>Largest error in pixels, f32 | f64; “broken”: a value came out infinite or "
      "NaN. The first three columns work on a, b, c, d as they are; the others on the canonical form of a "
      "span, and keep the last pixels before the horizon for exact division. A coordinate that is constant "
      "counts 0.</p>\n";
  html += hard_spans_table(bench);
  html += fmt::format(
      "<h2>The ground in {} × {}, camera rolled</h2>\n<p>{} pixels. Set-up of all spans {:.3f} "
      "ns a pixel{}, one thread. Shifts against exact division in f64; near the horizon a pixel "
      "is thousands of level-0 texels wide, so texels of the mip level read there tell more.</p>\n",
      bench.view_size.width, bench.view_size.height, bench.view_pixels, bench.set_up,
      bench.texturing > 0 ? fmt::format(", texturing (trilinear, reference sampler) {:.0f}", bench.texturing)
                          : "");
  return html_page("Span methods", html + view_table(bench));
}

} // namespace tilepack
