#pragma once

#include <string>
#include <vector>

namespace tilepack::cli {

/// One set of values of a plot. Values that are not finite (or not above 0 on a logarithmic axis) are left
/// out.
struct PlotSeries {
  std::string name;
  std::vector<double> x, y;
  bool line = true; ///< joined; otherwise dots
  bool dashed = false;
  int color = 0; ///< 0.. of a palette of eight that color-blind readers can tell apart
};

struct Plot {
  std::string title, x_label, y_label;
  bool log_x = false, log_y = false;
  std::vector<PlotSeries> series;
};

/// A self-contained <svg> element, 820 x 420, with axes, grid and legend; no script, no reference outside.
std::string svg_of(const Plot& plot);

/// Text with & < > " replaced, for HTML and SVG.
std::string escaped(const std::string& text);

} // namespace tilepack::cli
