#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "atmosphere/column/atmosphere_column.h"
#include "radiometry/planck.h"

namespace ifov::studies {

/// Whether LOWTRAN7 has a level at this altitude, km.
inline bool program_level(double z) {
  return (z == std::floor(z) && z <= 25.0) || z == 30 || z == 35 || z == 40 || z == 45 || z == 50 ||
         z == 70 || z == 100;
}

/// A column of layers of one temperature each, between the program's levels: its own way.
struct UniformLayers {
  std::vector<double> altitude_km, planck, depth;
  UniformLayers(const atmosphere::Levels& levels, const std::vector<double>& absorption,
                double wavelength_um) {
    const auto weight = [&](std::size_t i) { return levels.pressure_hPa[i] / levels.temperature_K[i]; };
    std::size_t low = 0;
    double sum = 0.0;
    for (std::size_t high = 1; high < levels.altitude_km.size(); ++high) {
      sum += absorption[high - 1];
      if (!program_level(levels.altitude_km[high])) continue;
      const double temperature =
          (weight(low) * levels.temperature_K[low] + weight(high) * levels.temperature_K[high]) /
          (weight(low) + weight(high));
      // The source jumps from layer to layer, across a millimetre that absorbs nothing.
      altitude_km.push_back(levels.altitude_km[low] + (low > 0 ? 1e-6 : 0.0));
      altitude_km.push_back(levels.altitude_km[high]);
      if (!depth.empty()) depth.push_back(0.0);
      depth.push_back(sum);
      planck.insert(planck.end(), 2, radiometry::planck_w_m2_sr_um(wavelength_um, temperature));
      low = high;
      sum = 0.0;
    }
  }
};

}  // namespace ifov::studies
