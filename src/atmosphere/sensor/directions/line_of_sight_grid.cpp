#include "atmosphere/sensor/directions/line_of_sight_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace ifov::atmosphere {
namespace {

/// Slopes that differ by less are one: 0.06 degrees at the nadir.
constexpr double kOneSlope = 1e-3;
/// Of the finer positions, in slope, and how many there are at most.
constexpr double kWantedStep = 0.03;
constexpr std::size_t kMostWanted = 97;
/// Images do not reach what is opposite lower Suns.
constexpr double kSteepestSun_rad = 1.4;
/// Lower surfaces are taken for ground.
constexpr double kOneHeight_km = 0.002;
/// Altitudes of the sensor that differ by less are one.
constexpr double kOneAltitude_km = 1e-3;

/// Points for a range whose half is this, in asinh(slope), which is how fast the path's length grows.
std::size_t points_for(double half) {
  return half < 0.03 ? 2 : half < 0.1 ? 3 : half < 0.25 ? 4 : half < 0.45 ? 5 : half < 0.8 ? 6 : 8;
}

std::size_t below(const std::vector<double>& positions, double x) {
  const auto above = std::upper_bound(positions.begin() + 1, positions.end() - 1, x);
  return static_cast<std::size_t>(above - positions.begin()) - 1;
}

}  // namespace

LineOfSightAxis LineOfSightAxis::slopes(double low, double high) {
  if (!(high - low > kOneSlope)) return LineOfSightAxis(0.5 * (low + high));
  LineOfSightAxis axis;
  axis.straight_ = false;
  axis.known_.clear();
  axis.wanted_.clear();
  const std::size_t count = points_for(0.5 * (std::asinh(high) - std::asinh(low)));
  for (std::size_t k = 0; k < count; ++k) {
    const double at = -std::cos(std::numbers::pi * static_cast<double>(k) / static_cast<double>(count - 1));
    axis.known_.push_back(0.5 * (low + high) + 0.5 * (high - low) * at);
  }
  const std::size_t steps =
      std::min(kMostWanted - 1, 1 + static_cast<std::size_t>((high - low) / kWantedStep));
  for (std::size_t k = 0; k <= steps; ++k)
    axis.wanted_.push_back(low + (high - low) * static_cast<double>(k) / static_cast<double>(steps));
  return axis;
}

LineOfSightAxis LineOfSightAxis::heights(const Levels& levels, double highest_km) {
  LineOfSightAxis axis(0.0);
  if (!(highest_km > kOneHeight_km)) return axis;
  for (std::size_t l = 1; l < levels.altitude_km.size() && axis.known_.back() < highest_km; ++l)
    axis.known_.push_back(std::min(highest_km, levels.altitude_km[l] - levels.altitude_km.front()));
  axis.wanted_ = axis.known_;
  return axis;
}

LineOfSightAxis LineOfSightAxis::sensors(const Levels& levels, const SensorAltitudes& altitudes) {
  const double top_km = levels.altitude_km.back(), low_km = altitudes.low_km,
               high_km = std::min(altitudes.high_km, std::max(low_km, top_km));
  LineOfSightAxis axis(low_km);
  if (!(high_km - low_km > kOneAltitude_km)) return axis;
  const auto add = [&](double altitude_km) {
    if (altitude_km > low_km && altitude_km < high_km) axis.known_.push_back(altitude_km);
  };
  // Light bends within a layer as its transmittance does: half a layer is straight enough.
  for (std::size_t l = 0; l < levels.altitude_km.size(); ++l) {
    if (l > 0) add(0.5 * (levels.altitude_km[l - 1] + levels.altitude_km[l]));
    add(levels.altitude_km[l]);
  }
  axis.known_.push_back(high_km);
  axis.wanted_ = axis.known_;
  return axis;
}

std::vector<double> LineOfSightAxis::weights(double position) const {
  const std::size_t count = known_.size();
  std::vector<double> result(count, 0.0);
  if (count == 1) return {1.0};
  const double x = std::clamp(position, known_.front(), known_.back());
  if (straight_) {
    const std::size_t low = below(known_, x);
    const double share = (x - known_[low]) / (known_[low + 1] - known_[low]);
    result[low] = 1.0 - share;
    result[low + 1] = share;
    return result;
  }
  for (std::size_t k = 0; k < count; ++k) {
    result[k] = 1.0;
    for (std::size_t j = 0; j < count; ++j)
      if (j != k) result[k] *= (x - known_[j]) / (known_[k] - known_[j]);
  }
  return result;
}

double slope_along(const LineOfSight& line) { return std::tan(line.zenith_rad) * std::cos(line.azimuth_rad); }
double slope_across(const LineOfSight& line) {
  return std::abs(std::tan(line.zenith_rad) * std::sin(line.azimuth_rad));
}

LineOfSightGrid::LineOfSightGrid(const LineOfSight& line)
    : only_(line),
      sensor_(line.sensor_km),
      along_(slope_along(line)),
      across_(slope_across(line)),
      height_(line.height_km) {}

LineOfSightGrid::LineOfSightGrid(const LineOfSightRange& range, const Levels& levels,
                                 const SensorAltitudes& sensors)
    : ground_km_(levels.altitude_km.front()),
      sensor_(LineOfSightAxis::sensors(levels, sensors)),
      along_(LineOfSightAxis::slopes(range.along_low, range.along_high)),
      across_(LineOfSightAxis::slopes(range.across_low, range.across_high)),
      height_(LineOfSightAxis::heights(levels, range.highest_km)) {
  highest_km_ = std::max(0.0, range.highest_km);
  only_ = line(along_.known().front(), across_.known().front(), 0.0, sensor_.known().front());
}

LineOfSight LineOfSightGrid::line(double along, double across, double height_km, double sensor_km) {
  return {std::atan(std::hypot(along, across)), std::atan2(across, along), height_km, sensor_km};
}

std::vector<LineOfSight> LineOfSightGrid::lines() const {
  if (single()) return {only_};
  std::vector<LineOfSight> all;
  for (const double sensor : sensor_.known())
    for (const double height : height_.known())
      for (const double along : along_.known())
        for (const double across : across_.known()) all.push_back(line(along, across, height, sensor));
  return all;
}

std::vector<LineOfSight> LineOfSightGrid::checks(std::optional<double> sun_zenith_rad) const {
  std::vector<LineOfSight> all;
  if (trivial()) return all;
  // Near the corners, where polynomials are worst, and within; heights between levels.
  constexpr std::array<std::array<double, 3>, 6> kPositions{{{0.04, 0.04, 0.11},
                                                             {0.96, 0.06, 0.93},
                                                             {0.05, 0.95, 0.55},
                                                             {0.94, 0.97, 0.3},
                                                             {0.52, 0.47, 0.71},
                                                             {0.3, 0.7, 0.04}}};
  const auto at = [](const LineOfSightAxis& axis, double share) {
    return axis.known().front() + share * (axis.known().back() - axis.known().front());
  };
  for (const auto& [a, c, h] : kPositions)
    all.push_back(line(at(along_, a), at(across_, c), h * highest_km_, at(sensor_, 1.0 - h)));
  const auto holds = [](const LineOfSightAxis& axis, double slope) {
    return slope >= axis.known().front() && slope <= axis.known().back();
  };
  constexpr double kBeside = 0.06;  // of the peak's half width
  if (sun_zenith_rad && *sun_zenith_rad < kSteepestSun_rad)
    for (const auto& [a, c] : {std::pair{0.0, 0.0}, {-kBeside, 0.5 * kBeside}, {kBeside, kBeside}}) {
      const double along = std::tan(*sun_zenith_rad) + a;
      if (holds(along_, along) && holds(across_, c))
        all.push_back(line(along, c, 0.0, sensor_.known().back()));
    }
  return all;
}

std::vector<double> LineOfSightGrid::weights(const LineOfSight& line) const {
  return weights(line.sensor_km, line.height_km, slope_along(line), slope_across(line));
}

std::vector<double> LineOfSightGrid::weights(double sensor_km, double height_km, double along,
                                             double across) const {
  const std::vector<double> by_sensor = sensor_.weights(sensor_km), by_height = height_.weights(height_km),
                            by_along = along_.weights(along), by_across = across_.weights(across);
  std::vector<double> all;
  for (const double s : by_sensor)
    for (const double h : by_height)
      for (const double a : by_along)
        for (const double c : by_across) all.push_back(s * h * a * c);
  return all;
}

}  // namespace ifov::atmosphere
