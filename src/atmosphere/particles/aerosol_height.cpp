#include "atmosphere/particles/aerosol_height.h"

#include <algorithm>

#include "atmosphere/particles/aerosol_tables.h"

namespace ifov::atmosphere {
namespace {

constexpr std::array<double, 5> kVisibility{50.0, 23.0, 10.0, 5.0, 2.0};
constexpr std::array<const char*, 5> kBoundary{"BL50", "BL23", "BL10", "BL5", "BL2"};

double at(const char* name, double altitude) {
  return AerosolTables::instance().heights.at(name).at(altitude);
}
double at(const std::string& name, double altitude) {
  return name.empty() ? 0.0 : at(name.c_str(), altitude);
}

/// Linear in 1/visibility between the values at two visibilities, and beyond them.
double by_visibility(double visibility, double v0, double x0, double v1, double x1) {
  const double f = (1.0 / visibility - 1.0 / v0) / (1.0 / v1 - 1.0 / v0);
  return std::max(x0 + (x1 - x0) * f, 0.0);
}

double boundary_layer(double altitude, double visibility) {
  std::size_t j = 1;
  while (j + 1 < kVisibility.size() && visibility < kVisibility[j]) ++j;
  return by_visibility(visibility, kVisibility[j - 1], at(kBoundary[j - 1], altitude), kVisibility[j],
                       at(kBoundary[j], altitude));
}

double troposphere(double altitude, double visibility, bool spring_summer) {
  const double hazy = at(spring_summer ? "SPSU23" : "FAWI23", altitude);
  const double clear = at(spring_summer ? "SPSU50" : "FAWI50", altitude);
  if (visibility <= 23.0) return hazy;
  constexpr double kHighestKm = 4.0;  // up to where visibility at the ground tells
  return altitude <= kHighestKm ? by_visibility(visibility, 50.0, clear, 23.0, hazy) : clear;
}

}  // namespace

const std::vector<StratosphereState>& stratosphere_table() {
  static const std::vector<StratosphereState> states{
      {"background", "BASTSS", "BASTFW", "UPNATM", "stratospheric_background"},
      {"moderate volcanic", "VUMOSS", "VUMOFW", "VUTONO", "aged_volcanic"},
      {"high volcanic", "HIVUSS", "HIVUFW", "VUTONO", "fresh_volcanic"},
      {"extreme volcanic", "EXVUSS", "EXVUFW", "VUTOEX", "fresh_volcanic"},
      {"none", "", "", "", "stratospheric_background"},
  };
  return states;
}

AerosolHeights aerosol_heights(double visibility_km, bool spring_summer, const StratosphereState& state,
                               double ground_km) {
  AerosolHeights heights;
  std::vector<double> altitudes;
  for (int z = 0; z <= 25; ++z) altitudes.push_back(z);
  altitudes.insert(altitudes.end(), {30.0, 35.0, 40.0, 45.0, 50.0, 70.0, 100.0});
  constexpr double kCompressedKm = 6.0;
  for (const double z : altitudes) {
    const bool low = z < kCompressedKm;
    heights.altitude_km.push_back(low ? ground_km + z * (kCompressedKm - ground_km) / kCompressedKm : z);
    const double stratosphere = at(spring_summer ? state.spring_summer : state.autumn_winter, z);
    heights.extinction_km[0].push_back(z <= 2.0 ? boundary_layer(z, visibility_km) : 0.0);
    heights.extinction_km[1].push_back(z > 2.0 && z <= 10.0 ? troposphere(z, visibility_km, spring_summer)
                                                            : 0.0);
    heights.extinction_km[2].push_back(z > 10.0 && z <= 30.0 ? stratosphere : 0.0);
    heights.extinction_km[3].push_back(z > 30.0 ? at(state.upper, z) : 0.0);
  }
  return heights;
}

}  // namespace ifov::atmosphere
