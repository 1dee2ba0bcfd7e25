#pragma once

#include <string>
#include <utility>
#include <vector>

namespace tilepack {

/// A line of a plot: points in order of x; `joined` false draws marks alone, each with its label if there is
/// one.
struct PlotSeries {
  std::string name;
  std::vector<std::pair<double, double>> points;
  std::vector<std::string> labels;
  bool joined = true;
};

struct Plot {
  std::string title;
  std::string x_label;
  std::string y_label;
  bool log_x = false; ///< decades; values of 0 and less are drawn on the lower border
  bool log_y = false;
  std::vector<PlotSeries> series;
};

/// An SVG element of 640 x 360, without scripts or outside references.
std::string svg(const Plot& plot);

/// `text` with &, <, > and " as entities.
std::string escaped(const std::string& text);

} // namespace tilepack
