#include "transport/view_table.h"

#include <algorithm>
#include <cmath>

#include "atmosphere/sensor/sensor_atmosphere.h"
#include "radiometry/polarization_frame.h"
#include "transport/sky/ground_around.h"

namespace ifov::transport {
namespace {

/// Steepest slope of a line of sight that the table is asked for, tan 85 degrees: flatter ones are on its
/// rim.
constexpr double kLeastRise = 0.0872;

/// The azimuth from the Sun's, of a line of sight or of its mirror image, that is on the counterclockwise side.
double counterclockwise(double azimuth_rad) {
  return std::atan2(std::abs(std::sin(azimuth_rad)), std::cos(azimuth_rad));
}

}  // namespace

template <class Visit>
void ViewTable::each_row(const atmosphere::SensorAtmosphere& atmosphere, Visit visit) const {
  const atmosphere::LineOfSightGrid& grid = atmosphere.lines_of_sight();
  std::size_t row = 0;
  for (const double sensor_km : grid.sensor().wanted())
    for (const double height_km : axes_[1])
      for (const double along : axes_[2])
        for (const double across : axes_[3]) visit(row++, grid.weights(sensor_km, height_km, along, across));
}

ViewTable::ViewTable(const atmosphere::SensorAtmosphere& atmosphere, math::Vec3 towards_sun,
                     const GroundAround& ground, bool polarized) {
  const double level = std::hypot(towards_sun.x, towards_sun.y);
  if (level > 0.0) sun_x_ = towards_sun.x / level, sun_y_ = towards_sun.y / level;
  const atmosphere::LineOfSightGrid& grid = atmosphere.lines_of_sight();
  axes_ = {grid.sensor().wanted(), grid.height().wanted(), grid.along().wanted(), grid.across().wanted()};
  for (double& sensor_km : axes_[0]) sensor_km -= grid.ground_km();
  const std::size_t nodes = atmosphere.node_count();
  transmittance_.resize(axes_[0].size() * axes_[1].size() * axes_[2].size() * axes_[3].size(), nodes);
  radiance_.resize(transmittance_.rows(), nodes);
  diffuse_.resize(transmittance_.rows(), nodes);
  std::vector<double> through(nodes), added(nodes), diffuse(nodes);
  each_row(atmosphere, [&](std::size_t row, const std::vector<double>& weight) {
    std::fill(through.begin(), through.end(), 0.0);
    std::fill(added.begin(), added.end(), 0.0);
    std::fill(diffuse.begin(), diffuse.end(), 0.0);
    for (std::size_t line = 0; line < weight.size(); ++line) {
      if (weight[line] == 0.0) continue;
      const atmosphere::SensorAtmosphere::LightAlongLine line_of_sight = atmosphere.line_of_sight(line);
      for (std::size_t n = 0; n < nodes; ++n) {
        through[n] += weight[line] * line_of_sight.transmittance[n];
        diffuse[n] += weight[line] * line_of_sight.diffuse_transmittance[n];
        added[n] += weight[line] * (line_of_sight.radiance[n] + ground.path(atmosphere, line, n));
      }
    }
    for (std::size_t n = 0; n < nodes; ++n) {
      transmittance_.row(row)[n] = static_cast<float>(std::max(0.0, through[n]));
      radiance_.row(row)[n] = static_cast<float>(std::max(0.0, added[n]));
      diffuse_.row(row)[n] = static_cast<float>(std::max(0.0, diffuse[n]));
    }
  });
  if (polarized && atmosphere.polarized()) polarize(atmosphere, ground);
}

void ViewTable::polarize(const atmosphere::SensorAtmosphere& atmosphere, const GroundAround& ground) {
  const atmosphere::LineOfSightGrid& grid = atmosphere.lines_of_sight();
  const std::size_t nodes = atmosphere.node_count();
  q_.resize(radiance_.rows(), nodes);
  u_.resize(radiance_.rows(), nodes);
  // Here x is towards the Sun and z up. A single line's light is that of the sensor's own geometry, whose azimuth counts
  // at the vertical, too, where the grid knows none.
  const bool single = grid.trivial();
  const double azimuth_rad = atmosphere.geometry().view_azimuth_rad;
  std::vector<radiometry::MuellerMatrix> turn;
  for (const atmosphere::LineOfSight& line : grid.lines()) {
    const radiometry::PolarizationFrame own = radiometry::meridional_frame(
        std::cos(line.zenith_rad), counterclockwise(single ? azimuth_rad : line.azimuth_rad));
    turn.push_back(turned(own, radiometry::carried({}, own.direction)));
  }
  std::vector<radiometry::StokesVector> light(nodes);
  each_row(atmosphere, [&](std::size_t row, const std::vector<double>& weight) {
    std::fill(light.begin(), light.end(), radiometry::StokesVector{});
    for (std::size_t line = 0; line < weight.size(); ++line) {
      if (weight[line] == 0.0) continue;
      const atmosphere::SensorAtmosphere::LineOfSightPolarization line_of_sight =
          atmosphere.line_of_sight_polarization(line);
      const radiometry::MuellerMatrix part = weight[line] * turn[line];
      for (std::size_t n = 0; n < nodes; ++n) {
        const radiometry::StokesVector of_ground = ground.path_stokes(atmosphere, line, n);
        light[n] += part * radiometry::StokesVector{0.0, line_of_sight.q[n] + of_ground.q,
                                                    line_of_sight.u[n] + of_ground.u, 0.0};
      }
    }
    for (std::size_t n = 0; n < nodes; ++n) {
      // Polynomials between lines may go beyond what can be.
      const double whole = static_cast<double>(radiance_.row(row)[n]);
      const double polarized = std::hypot(light[n].q, light[n].u);
      const double share = polarized > whole ? whole / polarized : 1.0;
      q_.row(row)[n] = static_cast<float>(share * light[n].q);
      u_.row(row)[n] = static_cast<float>(share * light[n].u);
    }
  });
}

std::array<const float*, 5> ViewTable::diffuse(const Weights& weights) const {
  std::array<const float*, 5> rows;
  for (std::size_t k = 0; k < rows.size(); ++k)
    rows[k] = diffuse_.row(0) + (k < weights.count ? weights.radiance[k] - radiance_.row(0) : 0);
  return rows;
}

ViewTable::Polarization ViewTable::polarization(const Weights& weights, math::Vec3 towards_sensor,
                                                const radiometry::PolarizationFrame& frame) const {
  const radiometry::PolarizationFrame upright{{0.0, 0.0, 1.0}, {sun_x_, sun_y_, 0.0}};
  const radiometry::MuellerMatrix turn = turned(radiometry::carried(upright, towards_sensor), frame);
  Polarization result;
  result.cosine = static_cast<float>(turn(1, 1));
  result.sine = static_cast<float>(turn(1, 2));
  result.side = dot(towards_sensor, upright.y()) < 0.0 ? -1.0f : 1.0f;
  for (std::size_t k = 0; k < weights.count; ++k) {
    const std::size_t row =
        static_cast<std::size_t>(weights.radiance[k] - radiance_.row(0)) / radiance_.stride();
    result.q[k] = q_.row(row);
    result.u[k] = u_.row(row);
  }
  return result;
}

radiometry::PolarizationFrame ViewTable::stokes(math::Vec3 towards_sensor, double height_m,
                                                double sensor_height_m,
                                                std::span<radiometry::StokesVector> nodes) const {
  const Weights weights = at(towards_sensor, height_m, sensor_height_m);
  const radiometry::PolarizationFrame frame = radiometry::meridional_frame(towards_sensor);
  const Polarization path = polarization(weights, towards_sensor, frame);
  const double c = static_cast<double>(path.cosine), s = static_cast<double>(path.sine);
  std::fill(nodes.begin(), nodes.end(), radiometry::StokesVector{});
  for (std::size_t k = 0; k < weights.count; ++k) {
    const double weight = static_cast<double>(weights.weight[k]);
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      const double q = static_cast<double>(path.q[k][n]), u = static_cast<double>(path.side * path.u[k][n]);
      nodes[n] += weight * radiometry::StokesVector{static_cast<double>(weights.radiance[k][n]),
                                                    c * q + s * u, c * u - s * q, 0.0};
    }
  }
  return frame;
}

ViewTable::Weights ViewTable::at(math::Vec3 towards_sensor, double height_m, double sensor_height_m) const {
  const double rise = std::max(towards_sensor.z, kLeastRise);
  const std::array<double, 4> wanted{1e-3 * sensor_height_m, 1e-3 * height_m,
                                     (towards_sensor.x * sun_x_ + towards_sensor.y * sun_y_) / rise,
                                     std::abs(towards_sensor.x * sun_y_ - towards_sensor.y * sun_x_) / rise};
  const std::array<std::size_t, 4> stride{axes_[1].size() * axes_[2].size() * axes_[3].size(),
                                          axes_[2].size() * axes_[3].size(), axes_[3].size(), 1};
  // Along which axes the cell's far end is met first.
  std::array<std::pair<double, std::size_t>, 4> ahead;
  std::size_t active = 0, corner = 0;
  for (std::size_t axis = 0; axis < axes_.size(); ++axis) {
    const std::vector<double>& positions = axes_[axis];
    if (positions.size() == 1) continue;
    const auto above = std::upper_bound(positions.begin() + 1, positions.end() - 1, wanted[axis]);
    const std::size_t low = static_cast<std::size_t>(above - positions.begin()) - 1;
    corner += low * stride[axis];
    ahead[active++] = {
        std::clamp((wanted[axis] - positions[low]) / (positions[low + 1] - positions[low]), 0.0, 1.0),
        stride[axis]};
  }
  // Four at most: the farthest ahead first.
  const auto order = [&](std::size_t a, std::size_t b) {
    if (b < active && ahead[a].first < ahead[b].first) std::swap(ahead[a], ahead[b]);
  };
  order(0, 1);
  order(1, 2);
  order(0, 1);
  if (active > 3) {
    order(2, 3);
    order(1, 2);
    order(0, 1);
  }
  Weights weights;
  double left = 1.0;
  for (std::size_t k = 0; k <= active; ++k) {
    const double next = k < active ? ahead[k].first : 0.0;
    weights.transmittance[k] = transmittance_.row(corner);
    weights.radiance[k] = radiance_.row(corner);
    weights.weight[k] = static_cast<float>(left - next);
    left = next;
    if (k < active) corner += ahead[k].second;
  }
  weights.count = active + 1;
  return weights;
}

}  // namespace ifov::transport
