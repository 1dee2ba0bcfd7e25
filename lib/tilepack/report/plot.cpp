#include "tilepack/report/plot.h"

#include "tilepack/report/html_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace tilepack {
namespace {

// Of the plot with its labels, without the legend.
constexpr double width = 480, height = 340, left = 72, right = 24, top = 34, bottom = 48;
constexpr double legend_row = 19;
// Distinct also for people who don't see colors well.
constexpr std::array palette{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                             "#e69f00", "#56b4e9", "#444444", "#999999"};

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
  if (!x || plot.x_from_zero) low = std::min(low, 0.0);
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

struct Frame {
  Axis x;
  Axis y;
  double at_x(double value) const { return left + x.share(value) * (width - left - right); }
  double at_y(double value) const { return height - bottom - y.share(value) * (height - top - bottom); }
};

const char* color_of(const PlotSeries& series, std::size_t place) {
  return palette[(series.color < 0 ? place : static_cast<std::size_t>(series.color)) % palette.size()];
}

std::string grid(const Frame& frame) {
  std::string out;
  for (const double tick : ticks(frame.x))
    out += fmt::format("<path d=\"M{0:.1f} {1}V{2}\" stroke=\"#e2e2e2\"/><text x=\"{0:.1f}\" y=\"{3}\" "
                       "text-anchor=\"middle\">{4:g}</text>\n",
                       frame.at_x(tick), top, height - bottom, height - bottom + 17, tick);
  for (const double tick : ticks(frame.y))
    out += fmt::format("<path d=\"M{0} {1:.1f}H{2}\" stroke=\"#e2e2e2\"/><text x=\"{3}\" y=\"{4:.1f}\" "
                       "text-anchor=\"end\">{5:g}</text>\n",
                       left, frame.at_y(tick), width - right, left - 5, frame.at_y(tick) + 4.5, tick);
  return out;
}

std::string stroke(const PlotSeries& series, const char* color) {
  return fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"1.8\"{}", color,
                     series.dashed ? " stroke-dasharray=\"5 4\"" : "");
}

std::string drawn(const PlotSeries& series, const Frame& frame, const char* color) {
  std::string line;
  std::string marks;
  bool broken = true;
  for (std::size_t i = 0; i < series.points.size(); ++i) {
    const auto [x, y] = series.points[i];
    if (!std::isfinite(x) || !std::isfinite(y)) {
      broken = true;
      continue;
    }
    line += fmt::format("{}{:.1f} {:.1f}", broken ? "M" : "L", frame.at_x(x), frame.at_y(y));
    broken = false;
    const std::string label = i < series.labels.size() ? series.labels[i] : fmt::format("{:g}, {:.4g}", x, y);
    marks += fmt::format(
        "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\" fill=\"{}\"><title>{}: {}</title></circle>\n",
        frame.at_x(x), frame.at_y(y), color, escaped(series.name), escaped(label));
  }
  std::string out;
  if (series.joined && !line.empty()) out = fmt::format("<path d=\"{}\" {}/>\n", line, stroke(series, color));
  return series.marked ? out + marks : out;
}

// Two columns where all names are short enough for half the width.
int legend_columns(const Plot& plot) {
  constexpr std::size_t longest = 27;
  return std::all_of(plot.series.begin(), plot.series.end(),
                     [](const PlotSeries& series) { return series.name.size() <= longest; })
             ? 2
             : 1;
}

std::string legend_entry(const PlotSeries& series, const char* color, double x, double y) {
  std::string out;
  if (series.joined) out += fmt::format("<path d=\"M{} {:.1f}h20\" {}/>", x, y, stroke(series, color));
  if (series.marked)
    out += fmt::format("<circle cx=\"{}\" cy=\"{:.1f}\" r=\"3.5\" fill=\"{}\"/>", x + 10, y, color);
  return out + fmt::format("<text x=\"{}\" y=\"{:.1f}\">{}</text>\n", x + 27, y + 4.5, escaped(series.name));
}

} // namespace

std::string svg(const Plot& plot) {
  const Frame frame{axis_of(plot, true), axis_of(plot, false)};
  const double legend_top = height + 10;
  const int columns = legend_columns(plot);
  const auto rows = (static_cast<int>(plot.series.size()) + columns - 1) / columns;
  const double whole_height = legend_top + legend_row * rows + 6;
  std::string out = fmt::format(
      "<svg class=\"plot\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" "
      "height=\"{1}\" role=\"img\" aria-label=\"{2}\" font-family=\"sans-serif\" font-size=\"13\" "
      "fill=\"#333\">\n<rect width=\"{0}\" height=\"{1}\" fill=\"#fafafa\"/>\n<text x=\"12\" y=\"20\" "
      "font-weight=\"bold\" font-size=\"{3}\">{2}</text>\n",
      width, whole_height, escaped(plot.title), plot.title.size() > 56 ? 13 : 15);
  out += grid(frame);
  out += fmt::format("<text x=\"{:.1f}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n",
                     (left + width - right) / 2, height - 8, escaped(plot.x_label));
  out +=
      fmt::format("<text transform=\"translate(14 {:.1f}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
                  (top + height - bottom) / 2, escaped(plot.y_label));
  for (std::size_t s = 0; s < plot.series.size(); ++s) {
    const char* color = color_of(plot.series[s], s);
    out += drawn(plot.series[s], frame, color);
    const int number = static_cast<int>(s);
    out += legend_entry(plot.series[s], color, 12 + number % columns * (width - 12) / columns,
                        legend_top + legend_row * (number / columns + 0.5));
  }
  return out + "</svg>\n";
}

} // namespace tilepack
