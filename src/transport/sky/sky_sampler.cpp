#include "transport/sky/sky_sampler.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace ifov::transport {
namespace {

/// Finds the interval of a rising table from 0 to 1 that holds u, and turns u into the position within it.
std::size_t descend(const double* table, std::size_t intervals, double& u) {
  const double* above = std::upper_bound(table + 1, table + intervals, u);
  const std::size_t i = static_cast<std::size_t>(above - table) - 1;
  const double width = table[i + 1] - table[i];
  u = width > 0.0 ? std::clamp((u - table[i]) / width, 0.0, 1.0) : 0.5;
  return i;
}

}  // namespace

SkySampler::SkySampler(std::vector<double> zenith_rad, std::vector<double> azimuth_rad,
                       math::Vec3 towards_sun, const std::vector<double>& brightness)
    : zenith_rad_(std::move(zenith_rad)), azimuth_rad_(std::move(azimuth_rad)) {
  const double level = std::hypot(towards_sun.x, towards_sun.y);
  if (level > 0.0) sun_x_ = towards_sun.x / level, sun_y_ = towards_sun.y / level;
  for (const double zenith : zenith_rad_) sine_squared_.push_back(std::sin(zenith) * std::sin(zenith));
  const std::size_t rings = zenith_rad_.size() - 1;
  cells_.resize(rings * azimuths());
  assert(brightness.size() == cells_.size());
  assert(std::is_sorted(zenith_rad_.begin(), zenith_rad_.end()));
  assert(std::is_sorted(azimuth_rad_.begin(), azimuth_rad_.end()));
  double total = 0.0;
  for (std::size_t z = 0; z < rings; ++z)
    for (std::size_t a = 0; a < azimuths(); ++a) {
      // The integral of the cosine over the cell and its mirror image is (sin^2 high - sin^2 low) times its width.
      const double area = (sine_squared_[z + 1] - sine_squared_[z]) * (azimuth_rad_[a + 1] - azimuth_rad_[a]);
      cells_[z * azimuths() + a] = area * brightness[z * azimuths() + a];
      total += cells_[z * azimuths() + a];
    }
  for (double& probability : cells_) probability /= total;
  rows_ = {0.0};
  for (std::size_t z = 0; z < rings; ++z) {
    double ring = 0.0;
    for (std::size_t a = 0; a < azimuths(); ++a) ring += cells_[z * azimuths() + a];
    rows_.push_back(rows_.back() + ring);
    double sum = 0.0;
    columns_.push_back(0.0);
    for (std::size_t a = 0; a < azimuths(); ++a) {
      sum += cells_[z * azimuths() + a];
      columns_.push_back(ring > 0.0 ? sum / ring
                                    : static_cast<double>(a + 1) / static_cast<double>(azimuths()));
    }
  }
  for (double& r : rows_) r /= rows_.back();
}

math::Vec3 SkySampler::sample(sampling::Point2 u) const {
  const std::size_t z = descend(rows_.data(), rows_.size() - 1, u.x);
  const double side = u.y < 0.5 ? 1.0 : -1.0;
  u.y = 2.0 * (u.y < 0.5 ? u.y : 1.0 - u.y);
  const std::size_t a = descend(&columns_[z * (azimuths() + 1)], azimuths(), u.y);
  const double sine_squared = sine_squared_[z] + u.x * (sine_squared_[z + 1] - sine_squared_[z]);
  const double azimuth = side * (azimuth_rad_[a] + u.y * (azimuth_rad_[a + 1] - azimuth_rad_[a]));
  const double sine = std::sqrt(sine_squared), c = std::cos(azimuth), s = std::sin(azimuth);
  return {sine * (c * sun_x_ - s * sun_y_), sine * (c * sun_y_ + s * sun_x_), std::sqrt(1.0 - sine_squared)};
}

double SkySampler::density(math::Vec3 direction) const {
  const double sine_squared = direction.x * direction.x + direction.y * direction.y;
  if (cells_.empty() || direction.z <= 0.0 || sine_squared >= sine_squared_.back()) return 0.0;
  const double azimuth = std::atan2(std::abs(direction.x * sun_y_ - direction.y * sun_x_),
                                    direction.x * sun_x_ + direction.y * sun_y_);
  const auto interval = [](const std::vector<double>& bounds, double x) {
    return static_cast<std::size_t>(std::upper_bound(bounds.begin() + 1, bounds.end() - 1, x) -
                                    bounds.begin()) -
           1;
  };
  const std::size_t z = interval(sine_squared_, sine_squared), a = interval(azimuth_rad_, azimuth);
  const double area = (sine_squared_[z + 1] - sine_squared_[z]) * (azimuth_rad_[a + 1] - azimuth_rad_[a]);
  return cells_[z * azimuths() + a] / area * direction.z;
}

}  // namespace ifov::transport
