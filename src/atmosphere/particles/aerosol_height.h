#pragma once

#include <array>
#include <string>
#include <vector>

namespace ifov::atmosphere {

/// Extinction at 550 nm, km-1, of the four regions of the aerosol at the altitudes of LOWTRAN7's table.
struct AerosolHeights {
  std::vector<double> altitude_km;
  /// Boundary layer, troposphere, stratosphere, above 30 km.
  std::array<std::vector<double>, 4> extinction_km;
};

/// Names of the table's columns that a state of the stratosphere stands for.
struct StratosphereState {
  std::string name;
  std::string spring_summer, autumn_winter, upper;  ///< heights; empty: there is none
  std::string optics;
};
const std::vector<StratosphereState>& stratosphere_table();

/// For a visibility (km), the altitudes shifted so that those below 6 km lie between the ground and 6 km.
AerosolHeights aerosol_heights(double visibility_km, bool spring_summer, const StratosphereState& state,
                               double ground_km);

}  // namespace ifov::atmosphere
