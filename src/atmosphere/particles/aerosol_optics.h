#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace ifov::atmosphere {

/// Optical properties of an aerosol at one wavelength.
struct AerosolProperties {
  double extinction = 0.0;  ///< over that at 550 nm
  double absorption = 0.0;  ///< over the extinction at 550 nm
  double asymmetry = 0.0;   ///< mean cosine of the scattering angle
};

/// Spectral shape of an aerosol of one kind and humidity, 0.2 to 300 um: Shettle and Fenn (1979),
/// AFGL-TR-79-0214, as tabulated in LOWTRAN7. Linear between the table's wavelengths; logarithms are linear
/// in log(100 % - humidity) between the table's humidities (0, 70, 80, 99 %), constant beyond.
class AerosolOptics {
 public:
  /// Kinds are named as in data/atmosphere/aerosols.txt; std::out_of_range for any other.
  AerosolOptics(std::string_view kind, double relative_humidity_percent);
  AerosolProperties at(double wavelength_um) const;

 private:
  std::vector<double> wavelength_um_, extinction_, absorption_, asymmetry_;
};

}  // namespace ifov::atmosphere
