#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "atmosphere/layer_optics.h"
#include "atmosphere/profile/profile.h"

namespace ifov::atmosphere {

/// A line of sight from a surface to the sensor.
struct SightLine {
  double zenith_rad = 0.0;                ///< of the direction from the surface towards the sensor
  double azimuth_rad = 0.0;               ///< of that direction from the Sun's
  double height_km = 0.0;                 ///< of the surface above the column's ground
  double sensor_km = kTopOfAtmosphereKm;  ///< altitude of the sensor above mean sea level
};

/// Lines of sight of an image, as the box that holds them: slopes tan(zenith) cos(azimuth) along the Sun's
/// azimuth and |tan(zenith) sin(azimuth)| across it (the air is the same on both sides of the Sun's plane).
struct SightRange {
  double along_low = 0.0, along_high = 0.0;
  double across_low = 0.0, across_high = 0.0;
  double highest_km = 0.0;  ///< of the surfaces, above the column's ground
};

/// Altitudes of a sensor above mean sea level while it takes an image; one where it stands still or flies level.
struct SensorAltitudes {
  double low_km = kTopOfAtmosphereKm, high_km = kTopOfAtmosphereKm;
};

/// An axis that a smooth quantity is known at few places of, and taken from at many: between the few it is
/// the polynomial through all of them (Chebyshev's points, where that is safe), or straight lines.
class SightAxis {
 public:
  /// One place.
  explicit SightAxis(double place = 0.0) : known_{place}, wanted_{place} {}
  /// Chebyshev's points of [low, high], more of them for longer ranges.
  static SightAxis slopes(double low, double high);
  /// The column's own levels, straight between.
  static SightAxis heights(const Levels& levels, double highest_km);
  /// Of sensors: both ends, levels and middles of layers between; straight between; beyond the air all are alike.
  static SightAxis sensors(const Levels& levels, const SensorAltitudes& altitudes);

  const std::vector<double>& known() const { return known_; }
  /// Rising, evenly spaced for slopes; its first and last place are the range's ends.
  const std::vector<double>& wanted() const { return wanted_; }
  /// Weights of the known places at a place.
  std::vector<double> weights(double place) const;

 private:
  std::vector<double> known_, wanted_;
  bool straight_ = true;
};

/// The lines of sight that an image's table is made of, from all altitudes that its sensor has.
class SightGrid {
 public:
  /// A single line of sight.
  explicit SightGrid(const SightLine& line);
  SightGrid(const SightRange& range, const Levels& levels, const SensorAltitudes& sensors);

  const SightAxis& sensor() const { return sensor_; }  ///< altitudes above mean sea level, km
  double ground_km() const { return ground_km_; }      ///< above mean sea level; 0 of a single line
  const SightAxis& along() const { return along_; }
  const SightAxis& across() const { return across_; }
  const SightAxis& height() const { return height_; }
  bool single() const { return known_lines() == 1; }
  std::size_t known_lines() const {
    return sensor_.known().size() * along_.known().size() * across_.known().size() * height_.known().size();
  }
  /// At the known places, [sensor][height][along][across].
  std::vector<SightLine> lines() const;
  /// Some between them, for checks; none of a single line.
  std::vector<SightLine> checks() const;
  /// Weights of lines() at a line of sight.
  std::vector<double> weights(const SightLine& line) const;
  std::vector<double> weights(double sensor_km, double height_km, double along, double across) const;
  /// Whether anything but a single line's own light is asked for.
  bool trivial() const { return single() && !(highest_km_ > 0.0); }

 private:
  static SightLine line(double along, double across, double height_km, double sensor_km);
  SightLine only_;
  double ground_km_ = 0.0, highest_km_ = 0.0;
  SightAxis sensor_, along_, across_, height_;
};

/// Slopes of a direction.
double slope_along(const SightLine& line);
double slope_across(const SightLine& line);

}  // namespace ifov::atmosphere
