#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#include "atmosphere/scattering/phase/phase_function.h"

namespace ifov::atmosphere {

/// Phase functions of an aerosol of one kind and humidity, 0.2 to 40 um: Mie's for the aerosols of Shettle and Fenn
/// (1979), as LOWTRAN7 has them (data/atmosphere/phase_functions.txt). As there, logarithms are linear
/// between the table's wavelengths, and what they give is linear between its humidities; constant beyond both.
class AerosolPhaseFunctions {
 public:
  /// Kinds are named as in the file; std::out_of_range for any other.
  AerosolPhaseFunctions(std::string_view kind, double relative_humidity_percent);
  PhaseFunction at(double wavelength_um) const;

 private:
  /// Numbers of functions by wavelength, at the humidity below and above, and the weight of the latter.
  std::array<const std::vector<std::size_t>*, 2> number_;
  double above_ = 0.0;
};

}  // namespace ifov::atmosphere
