#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "radiometry/spectrum.h"

namespace ifov::atmosphere {

/// What another radiative transfer code may say about one path. "Sensor" is the near end of the path and
/// "ground" its far end, whatever lies there; radiances are those that arrive at the sensor.
enum class PathQuantity {
  ground_sensor_transmittance,          ///< of the direct beam from the ground to the sensor
  diffuse_ground_sensor_transmittance,  ///< of light that scatters on the way
  sun_ground_transmittance,  ///< direct and diffuse light on a level ground / that above the atmosphere
  direct_sun_ground_transmittance,  ///< of the direct beam from the Sun to the ground
  two_way_transmittance,            ///< of the direct beam Sun - ground - sensor
  total_radiance,
  solar_path_radiance,           ///< all light of the Sun scattered into the path
  single_scatter_path_radiance,  ///< the part that scattered once
  thermal_path_radiance,         ///< emitted by the air, scattered or not
  surface_emission,
  ground_reflected_radiance,
  direct_reflected_radiance,  ///< the part that the direct beam of the Sun gave
  direct_irradiance,          ///< of the direct beam on a level plane
  diffuse_irradiance,         ///< downward, on a level plane
  global_irradiance,          ///< direct and diffuse
  upward_irradiance,
  sun_at_sensor,     ///< irradiance of the direct beam across it, at the sensor
  solar_irradiance,  ///< across the beam, above the atmosphere, at the date's distance
  spherical_albedo,  ///< of the atmosphere for light from below
  surface_emissivity,
};

inline constexpr std::size_t kPathQuantities = 20;

/// Name as in documents and tables ("solar_path_radiance"), unit ("W m-2 sr-1 um-1"; empty for ratios).
std::string_view name_of(PathQuantity quantity);
std::string_view unit_of(PathQuantity quantity);
/// The quantity of that name, if there is one.
std::optional<PathQuantity> path_quantity(std::string_view name);
std::vector<std::string> path_quantity_names();

/// Where the path runs, as far as the file says.
struct PathGeometry {
  std::optional<double> sensor_altitude_km, ground_altitude_km;  ///< above mean sea level
  std::optional<double> zenith_rad;      ///< of the line of sight at the sensor: pi looks straight down
  std::optional<double> azimuth_rad;     ///< as the code counts it
  std::optional<double> sun_zenith_rad;  ///< at the ground
  std::optional<double> range_km;
};

/// Spectral columns of one path as another code computed them. Radiances in W m-2 sr-1 um-1, irradiances in
/// W m-2 um-1, ratios as fractions of 1. What the code did not write is absent.
class ImportedPath {
 public:
  /// `wavelength_um` rises strictly (else InputError); `source` is what messages call this path.
  ImportedPath(std::string source, std::vector<double> wavelength_um);

  /// As many values as wavelengths, all finite; ratios between 0 and 1 (rounding of 1e-3 is cut off). Else
  /// InputError. No values at all leave the quantity absent.
  void set(PathQuantity quantity, std::vector<double> values);

  const std::string& source() const { return source_; }
  std::span<const double> wavelength_um() const { return wavelength_um_; }
  bool has(PathQuantity quantity) const { return !column(quantity).empty(); }
  /// Empty where absent.
  std::span<const double> column(PathQuantity quantity) const {
    return columns_[static_cast<std::size_t>(quantity)];
  }
  /// The column, or an InputError that names the source and what it has.
  std::span<const double> need(PathQuantity quantity) const;
  radiometry::Spectrum spectrum(PathQuantity quantity) const;
  std::vector<PathQuantity> quantities() const;  ///< those that are there

  /// One minus the emissivity where that is the same (within 1e-3) at all wavelengths: the run's albedo.
  std::optional<double> surface_albedo() const;

  PathGeometry geometry;
  std::vector<double> width_um;  ///< of channels; empty for a spectrum
  std::optional<double> water_vapour_g_cm2, ozone_g_cm2;

 private:
  std::string source_;
  std::vector<double> wavelength_um_;
  std::array<std::vector<double>, kPathQuantities> columns_;
};

}  // namespace ifov::atmosphere
