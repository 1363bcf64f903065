#include "sensor/energy_table.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace ifov::sensor {

EnergyTable::EnergyTable(int columns, int rows, double cell_px, const std::vector<double>& energy)
    : columns_(columns), rows_(rows), cell_px_(cell_px) {
  const auto width = static_cast<std::size_t>(columns), height = static_cast<std::size_t>(rows);
  summed_.assign((width + 1) * (height + 1), 0.0);
  for (std::size_t y = 0; y < height; ++y) {
    double row = 0.0;
    for (std::size_t x = 0; x < width; ++x) {
      row += energy[y * width + x];
      summed_[(y + 1) * (width + 1) + x + 1] = summed_[y * (width + 1) + x + 1] + row;
    }
  }
  const double total = summed_.back();
  if (!(total > 0.0) || !std::isfinite(total))
    throw InputError("the PSF's values must have a positive, finite sum");
  for (double& value : summed_) value /= total;
}

double EnergyTable::below(double x_px, double y_px) const {
  const double x = std::clamp(x_px / cell_px_ + 0.5 * columns_, 0.0, static_cast<double>(columns_));
  const double y = std::clamp(y_px / cell_px_ + 0.5 * rows_, 0.0, static_cast<double>(rows_));
  const auto i = std::min(static_cast<std::size_t>(x), static_cast<std::size_t>(columns_ - 1));
  const auto j = std::min(static_cast<std::size_t>(y), static_cast<std::size_t>(rows_ - 1));
  const double u = x - static_cast<double>(i), v = y - static_cast<double>(j);
  const std::size_t stride = static_cast<std::size_t>(columns_) + 1;
  const double* upper = summed_.data() + j * stride + i;
  const double* lower = upper + stride;
  return (1.0 - v) * ((1.0 - u) * upper[0] + u * upper[1]) + v * ((1.0 - u) * lower[0] + u * lower[1]);
}

double EnergyTable::within(double x0_px, double y0_px, double x1_px, double y1_px) const {
  return below(x1_px, y1_px) - below(x0_px, y1_px) - below(x1_px, y0_px) + below(x0_px, y0_px);
}

}  // namespace ifov::sensor
