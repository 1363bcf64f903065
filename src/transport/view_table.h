#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "math/vec3.h"
#include "radiometry/spectrum_block.h"

namespace ifov::radiometry {
struct PolarizationFrame;
struct StokesVector;
}  // namespace ifov::radiometry
namespace ifov::atmosphere {
class SensorAtmosphere;
}

namespace ifov::transport {

struct GroundAround;

/// What the air between surfaces and the sensor does, by height of the sensor, line of sight and height of the
/// surface, in spectral nodes: linear in the simplices of a fine grid of heights and slopes (Kuhn's division of each
/// cell), which takes 2 to 4 spectra, and 5 where the sensor has more than one height.
class ViewTable {
 public:
  /// `ground`: around the scene, whose light the air scatters into the path. `polarized`: Q and U are kept, where the atmosphere has
  /// them.
  ViewTable(const atmosphere::SensorAtmosphere& atmosphere, math::Vec3 towards_sun,
            const GroundAround& ground, bool polarized = true);

  struct Weights {
    std::size_t count = 0;
    std::array<const float*, 5> transmittance{}, radiance{};
    std::array<float, 5> weight{};
  };
  /// `towards_sensor` is a unit vector that points up; heights of surface and sensor are z of the scene, and the
  /// sensor's does not matter where it has one alone. Beyond the table its rim holds.
  Weights at(math::Vec3 towards_sensor, double height_m, double sensor_height_m) const;

  /// With the weights of at(): radiance of ground that is scattered into the line, for a radiance of 1. Rows beyond its
  /// count may be read and have no weight.
  std::array<const float*, 5> diffuse(const Weights& weights) const;

  /// Whether the atmosphere's tables are: stokes() and polarization() are then there.
  bool polarized() const { return q_.rows() > 0; }
  /// What the path adds, with its polarization, by node; returns the frame that it is about, the meridional one
  /// of light that goes to the sensor. Lines of sight are interpolated in frames carried to them from the
  /// vertical, which change smoothly across it.
  radiometry::PolarizationFrame stokes(math::Vec3 towards_sensor, double height_m, double sensor_height_m,
                                       std::span<radiometry::StokesVector> nodes) const;
  /// The same by rows, about a frame of the direction to the sensor: with q and u the sums over rows with the weights of at(), Q is
  /// cosine q + sine u and U is cosine u - sine q; u counts `side` times.
  struct Polarization {
    std::array<const float*, 5> q{}, u{};
    float cosine = 1.0f, sine = 0.0f, side = 1.0f;
  };
  Polarization polarization(const Weights& weights, math::Vec3 towards_sensor,
                            const radiometry::PolarizationFrame& frame) const;

 private:
  void polarize(const atmosphere::SensorAtmosphere& atmosphere, const GroundAround& ground);
  /// At the places of the axes, in the order of rows: weights of the lines of sight that are known there.
  template <class Visit>
  void each_row(const atmosphere::SensorAtmosphere& atmosphere, Visit visit) const;
  double sun_x_ = 0.0, sun_y_ = 1.0;  // horizontal direction of the Sun, unit
  std::array<std::vector<double>, 4>
      axes_;  // heights of sensor and surface in km above ground, along, across
  radiometry::SpectrumBlock transmittance_, radiance_, diffuse_;
  /// As radiance_, about frames carried from the vertical, where x is towards the Sun; of lines on the
  /// counterclockwise side. Empty where not asked for.
  radiometry::SpectrumBlock q_, u_;
};

}  // namespace ifov::transport
