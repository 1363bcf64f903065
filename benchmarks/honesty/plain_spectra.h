#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "radiometry/channel.h"
#include "scene/scene.h"

namespace ifov::benchmarks {

/// A scene's spectra for a tracer that has no spectral nodes: a path carries a number for every point of a fine
/// quadrature of each channel (columns). Between the points of all tables, in steps of at most 4 % of the wavelength,
/// Gauss's rule of two points. Where nothing that multiplies light on its way has a colour within the channels, one
/// column a channel holds the sources' means over it by the same quadrature, which is then the same.
class PlainSpectra {
 public:
  /// Keeps a reference to `scene`.
  PlainSpectra(const scene::Scene& scene, std::span<const radiometry::Channel> channels);

  std::size_t columns() const { return column_count_; }
  std::size_t channels() const { return channel_count_; }

  const std::vector<double>& reflectance(std::uint32_t material) const { return reflectance_[material]; }
  const std::vector<double>& transmittance(std::uint32_t material) const { return transmittance_[material]; }
  /// Irradiance of the Sun on a surface that faces it, W m-2 um-1; 0 without one.
  const std::vector<double>& sun() const { return sun_; }
  /// Radiances, W m-2 sr-1 um-1.
  const std::vector<double>& sky() const { return sky_; }
  const std::vector<double>& surroundings() const { return surroundings_; }

  std::vector<double> columns_of(const radiometry::Spectrum& spectrum) const;

  /// Adds weight times (1 - reflectance - transmittance) B(T) times `throughput` to `sum`.
  void add_emission(std::uint32_t material, double temperature_k, double weight,
                    std::span<const double> throughput, std::span<double> sum) const;

  /// Radiance that leaves towards the sensor, by column, to the channels' at the sensor. Without `path` the radiance
  /// that the view path adds is left out (for light that comes on top of other light).
  std::vector<double> at_sensor(std::span<const double> columns, bool path = true) const;

 private:
  struct Point {
    double um = 0.0, weight = 0.0;  ///< weights of a channel add up to 1
  };
  std::vector<double> planck(double temperature_k) const;
  /// By column: the value there, or its mean over the channel.
  template <class Function>
  std::vector<double> column_values(const Function& value) const;

  std::size_t channel_count_ = 0, column_count_ = 0;
  bool by_channel_ = false;                 ///< one column a channel
  std::vector<std::vector<Point>> points_;  ///< by channel
  std::vector<std::vector<double>> reflectance_, transmittance_;
  std::vector<double> sun_, sky_, surroundings_, view_transmittance_, view_radiance_;
  std::vector<std::pair<double, std::vector<double>>> kept_planck_;  ///< of the scene's own temperatures
};

}  // namespace ifov::benchmarks
