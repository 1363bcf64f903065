#include "sensor/detector/illumination.h"

#include <algorithm>
#include <cmath>

#include "sensor/detector/detector.h"
#include "sensor/detector/read_out.h"

namespace ifov::sensor {

namespace {

/// Straight between rows, and as at the last beyond.
double share_at(const std::vector<std::array<double, 2>>& rows, double height_px) {
  const auto above = std::upper_bound(rows.begin(), rows.end(), height_px,
                                      [](double height, const auto& row) { return height < row[0]; });
  if (above == rows.begin()) return rows.front()[1];
  if (above == rows.end()) return rows.back()[1];
  const auto& [from, before] = *(above - 1);
  const auto& [to, after] = *above;
  return before + (after - before) * (height_px - from) / (to - from);
}

}  // namespace

Illumination::Illumination(const Detector& detector, int columns, int lines, const ReadOut& read_out)
    : even_(!detector.is_vignetted()),
      has_lines_(read_out.kind == ReadOut::Kind::frame),
      columns_(columns),
      lines_(lines),
      rows_(detector.vignette_rows),
      focal_px_(detector.vignette_px),
      radius_px_(0.5 * (has_lines_ ? std::hypot(columns, lines) : columns)),
      terms_{detector.vignette_2, detector.vignette_4, detector.vignette_6} {}

double Illumination::at(double x_px, double y_px) const {
  if (even_) return 1.0;
  const double x = x_px - 0.5 * columns_, y = has_lines_ ? y_px - 0.5 * lines_ : 0.0, square = x * x + y * y;
  double light = 1.0;
  if (focal_px_ > 0.0) {
    const double depth = 1.0 + square / (focal_px_ * focal_px_);  // 1 / cos^2
    light /= depth * depth;
  }
  if (rows_) light *= share_at(*rows_, std::sqrt(square));
  const double s = square / (radius_px_ * radius_px_);
  return std::max(0.0, light * (1.0 + s * (terms_[0] + s * (terms_[1] + s * terms_[2]))));
}

std::vector<double> Illumination::of_line(int line) const {
  std::vector<double> light;
  if (even_) return light;
  for (int x = 0; x < columns_; ++x) light.push_back(at(x + 0.5, line + 0.5));
  return light;
}

}  // namespace ifov::sensor
