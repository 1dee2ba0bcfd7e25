#include "tilepack/report/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace tilepack {
namespace {

constexpr double width = 640, height = 360, left = 64, right = 180, top = 34, bottom = 46;
// Distinct also for people who don't see colors well.
constexpr std::array colors{"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#444444"};

struct Axis {
  double low = 0;
  double high = 1;
  bool log = false;

  double share(double value) const {
    if (log) value = value > 0 ? std::log10(value) : low;
    return std::clamp((value - low) / (high - low), 0.0, 1.0);
  }
};

Axis axis_of(const Plot& plot, bool x) {
  const bool log = x ? plot.log_x : plot.log_y;
  double low = INFINITY;
  double high = -INFINITY;
  for (const PlotSeries& series : plot.series)
    for (const auto& [px, py] : series.points) {
      const double value = x ? px : py;
      if (!std::isfinite(value) || (log && value <= 0)) continue;
      low = std::min(low, log ? std::log10(value) : value);
      high = std::max(high, log ? std::log10(value) : value);
    }
  if (!(low <= high)) return {0, 1, log};
  if (log) return {std::floor(low), std::max(std::ceil(high), std::floor(low) + 1), true};
  if (!x) low = std::min(low, 0.0);
  return {low, high > low ? high + (x ? 0 : 0.05 * (high - low)) : low + 1, false};
}

std::vector<double> ticks(const Axis& axis) {
  std::vector<double> result;
  if (axis.log) {
    const int step = std::max(1, static_cast<int>((axis.high - axis.low) / 7 + 0.999));
    for (int e = static_cast<int>(axis.low); e <= static_cast<int>(axis.high); e += step)
      result.push_back(std::pow(10.0, e));
    return result;
  }
  const double rough = (axis.high - axis.low) / 6;
  const double decade = std::pow(10.0, std::floor(std::log10(rough)));
  const double step = decade * (rough / decade > 5   ? 10
                                : rough / decade > 2 ? 5
                                : rough / decade > 1 ? 2
                                                     : 1);
  for (double value = std::ceil(axis.low / step) * step; value <= axis.high + 1e-9 * step; value += step)
    result.push_back(std::fabs(value) < 1e-9 * step ? 0.0 : value);
  return result;
}

} // namespace

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else
      result += c;
  }
  return result;
}

std::string svg(const Plot& plot) {
  const Axis x = axis_of(plot, true);
  const Axis y = axis_of(plot, false);
  const auto px = [&](double value) { return left + x.share(value) * (width - left - right); };
  const auto py = [&](double value) { return height - bottom - y.share(value) * (height - top - bottom); };
  std::string out =
      fmt::format("<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">\n<text x=\"{}\" y=\"18\" "
                  "class=\"title\">{}</text>\n",
                  width, height, escaped(plot.title), left, escaped(plot.title));
  for (const double tick : ticks(x))
    out += fmt::format(
        "<line x1=\"{0:.1f}\" y1=\"{1}\" x2=\"{0:.1f}\" y2=\"{2}\" class=\"grid\"/><text x=\"{0:.1f}\" "
        "y=\"{3}\" class=\"tick\" text-anchor=\"middle\">{4:g}</text>\n",
        px(tick), top, height - bottom, height - bottom + 15, tick);
  for (const double tick : ticks(y))
    out += fmt::format(
        "<line x1=\"{0}\" y1=\"{1:.1f}\" x2=\"{2}\" y2=\"{1:.1f}\" class=\"grid\"/><text x=\"{3}\" "
        "y=\"{4:.1f}\" class=\"tick\" text-anchor=\"end\">{5:g}</text>\n",
        left, py(tick), width - right, left - 6, py(tick) + 4, tick);
  out += fmt::format("<text x=\"{:.1f}\" y=\"{}\" class=\"tick\" text-anchor=\"middle\">{}</text>\n",
                     (left + width - right) / 2, height - 10, escaped(plot.x_label));
  out += fmt::format("<text transform=\"translate(14 {:.1f}) rotate(-90)\" class=\"tick\" "
                     "text-anchor=\"middle\">{}</text>\n",
                     (top + height - bottom) / 2, escaped(plot.y_label));
  for (std::size_t s = 0; s < plot.series.size(); ++s) {
    const PlotSeries& series = plot.series[s];
    const char* color = colors[s % colors.size()];
    std::string line;
    for (std::size_t i = 0; i < series.points.size(); ++i) {
      const auto [vx, vy] = series.points[i];
      line += fmt::format("{:.1f},{:.1f} ", px(vx), py(vy));
      const std::string label =
          i < series.labels.size() ? series.labels[i] : fmt::format("{:g}, {:.4g}", vx, vy);
      out += fmt::format(
          "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\" fill=\"{}\"><title>{}: {}</title></circle>\n",
          px(vx), py(vy), color, escaped(series.name), escaped(label));
    }
    if (series.joined)
      out += fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.6\"/>\n", line,
                         color);
    out += fmt::format("<circle cx=\"{0}\" cy=\"{1}\" r=\"3.5\" fill=\"{2}\"/><text x=\"{3}\" y=\"{4}\" "
                       "class=\"tick\">{5}</text>\n",
                       width - right + 14, top + 8 + 18 * static_cast<double>(s), color, width - right + 22,
                       top + 12 + 18 * static_cast<double>(s), escaped(series.name));
  }
  return out + "</svg>\n";
}

} // namespace tilepack
