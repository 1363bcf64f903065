#include "studies/resolution_chart.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ifov::studies {

double line_pairs_per_mm(int group, int element) { return std::pow(2.0, group + (element - 1) / 6.0); }

std::vector<Outline> chart_bars(int first_group, int last_group, const ChartPlacement& placement) {
  struct Bar {
    double x, y, width, height;
  };
  std::vector<Bar> bars;
  double column = 0.0, right = 0.0, bottom = 0.0;
  for (int group = first_group; group <= last_group; ++group) {
    double row = 0.0;
    const double widest = 0.5 / line_pairs_per_mm(group, 1);
    for (int element = 1; element <= 6; ++element) {
      const double w = 0.5 / line_pairs_per_mm(group, element);
      for (int k = 0; k < 3; ++k) {
        bars.push_back({column + 2 * k * w, row, w, 5 * w});
        bars.push_back({column + 7 * w, row + 2 * k * w, 5 * w, w});
      }
      bottom = std::max(bottom, row + 5 * w);
      row += 7.5 * w;
    }
    right = std::max(right, column + 12 * widest);
    column += 16 * widest;
  }
  const double c = std::cos(placement.angle_rad), s = std::sin(placement.angle_rad);
  std::vector<Outline> outlines;
  for (const Bar& bar : bars) {
    Outline corners;
    for (const auto& [u, v] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}) {
      const double x = (bar.x + u * bar.width - 0.5 * right) * placement.px_per_mm;
      const double y = (bar.y + v * bar.height - 0.5 * bottom) * placement.px_per_mm;
      corners.push_back({placement.centre_x_px + c * x - s * y, placement.centre_y_px + s * x + c * y});
    }
    outlines.push_back(std::move(corners));
  }
  return outlines;
}

std::vector<double> covered_fraction(const std::vector<Outline>& outlines, int width_px, int height_px) {
  std::vector<double> fraction(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px), 0.0);
  for (const Outline& outline : outlines) {
    double x0 = width_px, y0 = height_px, x1 = 0.0, y1 = 0.0;
    for (const sampling::FocalPoint& p : outline) {
      x0 = std::min(x0, p.x_px);
      x1 = std::max(x1, p.x_px);
      y0 = std::min(y0, p.y_px);
      y1 = std::max(y1, p.y_px);
    }
    for (int j = std::max(0, static_cast<int>(std::floor(y0))); j < std::min<double>(height_px, y1); ++j)
      for (int i = std::max(0, static_cast<int>(std::floor(x0))); i < std::min<double>(width_px, x1); ++i)
        fraction[static_cast<std::size_t>(j * width_px + i)] +=
            area_in_rectangle(outline, i, j, i + 1, j + 1);
  }
  return fraction;
}

}  // namespace ifov::studies
