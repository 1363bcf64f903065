#pragma once

#include <string>
#include <vector>

namespace ifov::studies {

/// A line through points in data coordinates.
struct PlotSeries {
  std::string name, colour;  ///< "#d55e00" or "#888"
  std::vector<double> x, y;
  bool markers_only = false;
};

/// A horizontal line across the plot, or a band around it.
struct PlotLevel {
  std::string name, colour;
  double value = 0.0, half_width = 0.0;
};

struct Plot {
  std::string title, x_label, y_label;
  bool x_log = false, y_log = false;
  double y_low = 0.0, y_high = 0.0;  ///< both 0: from the data
  std::vector<PlotLevel> levels;
  std::vector<PlotSeries> series;
};

/// An image in false colours with its scale: rows from the top, `low` to `high` over the colour map.
struct ImagePanel {
  std::string title;
  int width = 0, height = 0;
  std::vector<double> values;
  double low = 0.0, high = 1.0;
  std::string unit;
  bool heat = false;  ///< the map for temperatures and errors instead of the one for radiances and counts
};

/// A figure as files: SVG for pages, PDF for papers.
struct DrawnFigure {
  std::string svg, pdf;
};

/// Points that a logarithmic axis cannot show are left out; all others lie inside the frame.
DrawnFigure draw(const Plot& plot);
DrawnFigure draw(const ImagePanel& panel);

}  // namespace ifov::studies
