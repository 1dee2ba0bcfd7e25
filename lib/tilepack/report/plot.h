#pragma once

#include <string>
#include <utility>
#include <vector>

namespace tilepack {

/// A line of a plot: points in order of x. A value that isn't finite is left out and breaks the line.
struct PlotSeries {
  std::string name;
  std::vector<std::pair<double, double>> points;
  std::vector<std::string>
      labels;         ///< shown where the pointer rests on a mark; the values where there is none
  bool joined = true; ///< by a line; else marks alone
  bool marked = true; ///< a dot at each point
  bool dashed = false;
  int color = -1; ///< of the palette, turned round; -1: the series' place among all
};

struct Plot {
  std::string title;
  std::string x_label;
  std::string y_label;
  bool log_x = false; ///< decades; values of 0 and less are drawn on the lower border
  bool log_y = false;
  std::vector<PlotSeries> series;
  bool x_from_zero = false; ///< the axis of x begins at 0 where it isn't logarithmic; that of y always does
};

/// An SVG element 480 wide, of class "plot", without scripts or outside references: the plot with grid and
/// labels, and the legend below it. Letters are 13 high, so that it can be read when drawn 370 pixels wide.
std::string svg(const Plot& plot);

} // namespace tilepack
