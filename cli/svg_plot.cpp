#include "svg_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace tilepack::cli {
namespace {

constexpr double left = 70, right = 540, top = 40, bottom = 370;
constexpr std::array palette{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                             "#000000", "#e69f00", "#56b4e9", "#7f7f7f"};

// One axis: data to pixels.
struct Axis {
  bool logarithmic = false;
  double low = 0, high = 1;       // data, after log10 where logarithmic
  double at_low = 0, at_high = 1; // pixels

  bool shows(double value) const { return std::isfinite(value) && (!logarithmic || value > 0); }
  double place(double value) const {
    const double v = logarithmic ? std::log10(value) : value;
    return at_low + (v - low) / (high - low) * (at_high - at_low);
  }
};

Axis axis_for(const Plot& plot, bool horizontal) {
  Axis axis;
  axis.logarithmic = horizontal ? plot.log_x : plot.log_y;
  axis.at_low = horizontal ? left : bottom;
  axis.at_high = horizontal ? right : top;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const PlotSeries& series : plot.series) {
    for (double value : horizontal ? series.x : series.y) {
      if (!axis.shows(value)) continue;
      const double v = axis.logarithmic ? std::log10(value) : value;
      low = std::min(low, v);
      high = std::max(high, v);
    }
  }
  if (!(low <= high)) return axis;
  if (axis.logarithmic) {
    low = std::floor(low);
    high = std::ceil(high);
  } else {
    low = std::min(low, 0.0);
  }
  axis.low = low;
  axis.high = high > low ? high : low + 1;
  return axis;
}

// Places of grid lines: whole powers of ten, or round steps.
std::vector<double> ticks(const Axis& axis) {
  std::vector<double> values;
  if (axis.logarithmic) {
    const int step = std::max(1, static_cast<int>((axis.high - axis.low) / 8));
    for (int e = static_cast<int>(axis.low); e <= static_cast<int>(axis.high); e += step)
      values.push_back(std::pow(10.0, e));
    return values;
  }
  const double raw = (axis.high - axis.low) / 6;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  const double step = power * (raw / power > 5 ? 10 : raw / power > 2 ? 5 : raw / power > 1 ? 2 : 1);
  for (double v = std::ceil(axis.low / step) * step; v <= axis.high + step * 1e-9; v += step)
    values.push_back(v);
  return values;
}

std::string grid(const Axis& x, const Axis& y) {
  std::string svg;
  for (double value : ticks(x)) {
    const double at = x.place(value);
    svg +=
        fmt::format("<path d='M{:.1f} {}V{}' stroke='#ddd'/><text x='{:.1f}' y='{}' text-anchor='middle'>{:g}"
                    "</text>\n",
                    at, top, bottom, at, bottom + 18, value);
  }
  for (double value : ticks(y)) {
    const double at = y.place(value);
    svg += fmt::format("<path d='M{} {:.1f}H{}' stroke='#ddd'/><text x='{}' y='{:.1f}' text-anchor='end'>{:g}"
                       "</text>\n",
                       left, at, right, left - 6, at + 4, value);
  }
  return svg + fmt::format("<path d='M{} {}V{}H{}' stroke='#333' fill='none'/>\n", left, top, bottom, right);
}

std::string drawn(const PlotSeries& series, const Axis& x, const Axis& y) {
  const char* const color = palette[static_cast<std::size_t>(series.color) % palette.size()];
  std::string path, dots;
  for (std::size_t i = 0; i < std::min(series.x.size(), series.y.size()); ++i) {
    if (!x.shows(series.x[i]) || !y.shows(series.y[i])) continue;
    const double px = x.place(series.x[i]), py = y.place(series.y[i]);
    path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", px, py);
    dots += fmt::format("<circle cx='{:.1f}' cy='{:.1f}' r='4' fill='{}'/>", px, py, color);
  }
  if (!series.line) return dots + "\n";
  return fmt::format("<path d='{}' fill='none' stroke='{}' stroke-width='1.6'{}/>\n", path, color,
                     series.dashed ? " stroke-dasharray='5 4'" : "");
}

} // namespace

std::string escaped(const std::string& text) {
  std::string out;
  for (char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

std::string svg_of(const Plot& plot) {
  const Axis x = axis_for(plot, true), y = axis_for(plot, false);
  std::string svg = fmt::format("<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 820 420' width='820' "
                                "height='420' font-family='sans-serif' font-size='11'>\n"
                                "<rect width='820' height='420' fill='#fff'/>\n"
                                "<text x='{}' y='22' font-size='14'>{}</text>\n",
                                left, escaped(plot.title));
  svg += grid(x, y);
  svg += fmt::format("<text x='{}' y='{}' text-anchor='middle'>{}</text>\n", (left + right) / 2, bottom + 38,
                     escaped(plot.x_label));
  svg += fmt::format("<text transform='translate(16 {}) rotate(-90)' text-anchor='middle'>{}</text>\n",
                     (top + bottom) / 2, escaped(plot.y_label));
  double row = top + 6;
  for (const PlotSeries& series : plot.series) {
    svg += drawn(series, x, y);
    const char* const color = palette[static_cast<std::size_t>(series.color) % palette.size()];
    svg += fmt::format("<path d='M{} {}h18' stroke='{}' stroke-width='{}'{}/><text x='{}' y='{}'>{}</text>\n",
                       right + 14, row, color, series.line ? 2 : 7,
                       series.dashed ? " stroke-dasharray='5 4'" : "", right + 38, row + 4,
                       escaped(series.name));
    row += 17;
  }
  return svg + "</svg>\n";
}

} // namespace tilepack::cli
