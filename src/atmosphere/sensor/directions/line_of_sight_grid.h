#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "atmosphere/layer_optics.h"
#include "atmosphere/profile/profile.h"
#include "atmosphere/sensor/directions/line_of_sight.h"

namespace ifov::atmosphere {

/// Lines of sight of an image, as the box that holds them: slopes tan(zenith) cos(azimuth) along the Sun's
/// azimuth and |tan(zenith) sin(azimuth)| across it (the air is the same on both sides of the Sun's plane).
struct LineOfSightRange {
  double along_low = 0.0, along_high = 0.0;
  double across_low = 0.0, across_high = 0.0;
  double highest_km = 0.0;  ///< of the surfaces, above the column's ground
};

/// Altitudes of a sensor above mean sea level while it takes an image; one where it stands still or flies level.
struct SensorAltitudes {
  double low_km = kTopOfAtmosphereKm, high_km = kTopOfAtmosphereKm;
};

/// An axis that a smooth quantity is known at few positions of, and taken from at many: between the few it is
/// the polynomial through all of them (Chebyshev's points, where that is safe), or straight lines.
class LineOfSightAxis {
 public:
  /// One position.
  explicit LineOfSightAxis(double position = 0.0) : known_{position}, wanted_{position} {}
  /// Chebyshev's points of [low, high], more of them for longer ranges.
  static LineOfSightAxis slopes(double low, double high);
  /// The column's own levels, straight between.
  static LineOfSightAxis heights(const Levels& levels, double highest_km);
  /// Of sensors: both ends, levels and middles of layers between; straight between; beyond the air all are alike.
  static LineOfSightAxis sensors(const Levels& levels, const SensorAltitudes& altitudes);

  const std::vector<double>& known() const { return known_; }
  /// Rising, evenly spaced for slopes; its first and last position are the range's ends.
  const std::vector<double>& wanted() const { return wanted_; }
  /// Weights of the known positions at a position.
  std::vector<double> weights(double position) const;

 private:
  std::vector<double> known_, wanted_;
  bool straight_ = true;
};

/// The lines of sight that an image's table is made of, from all altitudes that its sensor has.
class LineOfSightGrid {
 public:
  /// A single line of sight.
  explicit LineOfSightGrid(const LineOfSight& line);
  LineOfSightGrid(const LineOfSightRange& range, const Levels& levels, const SensorAltitudes& sensors);

  const LineOfSightAxis& sensor() const { return sensor_; }  ///< altitudes above mean sea level, km
  double ground_km() const { return ground_km_; }            ///< above mean sea level; 0 of a single line
  const LineOfSightAxis& along() const { return along_; }
  const LineOfSightAxis& across() const { return across_; }
  const LineOfSightAxis& height() const { return height_; }
  bool single() const { return known_lines() == 1; }
  std::size_t known_lines() const {
    return sensor_.known().size() * along_.known().size() * across_.known().size() * height_.known().size();
  }
  /// At the known positions, [sensor][height][along][across].
  std::vector<LineOfSight> lines() const;
  /// Some between them, for checks; none of a single line. Where the lines reach the point opposite the Sun, about which haze
  /// has a narrow peak, some are there.
  std::vector<LineOfSight> checks(std::optional<double> sun_zenith_rad) const;
  /// Weights of lines() at a line of sight.
  std::vector<double> weights(const LineOfSight& line) const;
  std::vector<double> weights(double sensor_km, double height_km, double along, double across) const;
  /// Whether anything but a single line's own light is asked for.
  bool trivial() const { return single() && !(highest_km_ > 0.0); }

 private:
  static LineOfSight line(double along, double across, double height_km, double sensor_km);
  LineOfSight only_;
  double ground_km_ = 0.0, highest_km_ = 0.0;
  LineOfSightAxis sensor_, along_, across_, height_;
};

/// Slopes of a direction.
double slope_along(const LineOfSight& line);
double slope_across(const LineOfSight& line);

}  // namespace ifov::atmosphere
