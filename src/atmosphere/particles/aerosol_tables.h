#pragma once

#include <map>
#include <string>
#include <vector>

namespace ifov::atmosphere {

/// The content of data/atmosphere/aerosols.txt.
struct AerosolTables {
  struct Optics {
    double humidity_percent = 0.0;
    std::vector<double> wavelength_um, extinction, absorption, asymmetry;
  };
  /// Extinction at 550 nm, km-1, at altitudes in km.
  struct Height {
    std::vector<double> altitude_km, extinction_km;
    double at(double altitude) const;  ///< that of the level itself; 0 where the table has none
  };
  std::map<std::string, std::vector<Optics>, std::less<>> optics;  ///< humidities rise
  std::map<std::string, Height, std::less<>> heights;

  static const AerosolTables& instance();
};

}  // namespace ifov::atmosphere
