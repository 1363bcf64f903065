// Makes tests/atmosphere/spherical_reference.csv: what a spherical Monte Carlo program says of skies and paths.
//
//   build/tests/spherical_reference > tests/atmosphere/spherical_reference.csv
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <initializer_list>
#include <string>

#include "atmosphere/column_maker.h"
#include "support/spherical_monte_carlo.h"

namespace {

using ifov::atmosphere::test::kDegree;
using ifov::test::SphericalMonteCarlo;
constexpr unsigned kSeed = 20;

template <class Measure>
void row(const char* what, double depth, double sun_deg, double zenith_deg, double azimuth_deg, double wanted,
         Measure&& measure) {
  SphericalMonteCarlo::Light light{};
  // Paths are as many as the error needs; those of the pilot are not counted.
  constexpr std::uint64_t kPilot = 40000, kMost = 40000000;
  light = measure(kPilot, kSeed);
  const double ratio = light.error / (light.all * wanted);
  const auto paths = static_cast<std::uint64_t>(1.3 * ratio * ratio * static_cast<double>(kPilot));
  light = measure(std::min(kMost, std::max(kPilot, paths)), kSeed + 1);
  std::printf("%s,%g,%g,%g,%g,%.6g,%.2g,%.6g\n", what, depth, sun_deg, zenith_deg, azimuth_deg, light.all,
              light.error, light.once);
  std::fflush(stdout);
}

}  // namespace

int main(int count, char** arguments) {
  const double wanted = count > 1 ? std::atof(arguments[1]) : 0.002;
  std::puts(
      "# Sunlight scattered by molecules in spherical shells (radius 6371 km) over black ground: 34 layers to 60 km, scale height\n"
      "# 8 km (Air of tests/atmosphere/column_maker.h), no depolarization, unpolarized, not refracted; sunlight of irradiance 1.\n"
      "# Made by tests/support/spherical_reference.cpp: spherical_reference 0.002 (with haze 0.003). Standard errors of the mean.\n"
      "# sky: radiance at the ground; above: at the top along the line that leaves the ground at this zenith angle; flux:\n"
      "# irradiance on level ground. Angles in degrees; azimuth of propagation, 0 as sunlight propagates. Names that end in _haze:\n"
      "# with haze of depth 0.2 that absorbs nothing, scale height 1.5 km, asymmetry 0.65 (Henyey and Greenstein 1941).\n"
      "what,depth,sun_zenith,zenith,azimuth,all,error,once");
  const auto rows = [&](const SphericalMonteCarlo& shells, const std::string& haze, double depth, double sun,
                        std::initializer_list<double> zeniths) {
    row(("flux" + haze).c_str(), depth, sun, 0.0, 0.0, sun < 90.0 ? wanted : 2.0 * wanted,
        [&](std::uint64_t paths, unsigned seed) { return shells.flux(paths, seed); });
    if (sun > 90.0) return;
    for (const double zenith : zeniths)
      for (const double azimuth : {0.0, 90.0, 180.0}) {
        if (zenith == 0.0 && azimuth > 0.0) continue;
        row(("sky" + haze).c_str(), depth, sun, zenith, azimuth, wanted,
            [&](std::uint64_t paths, unsigned seed) {
              return shells.sky(zenith * kDegree, azimuth * kDegree, paths, seed);
            });
        row(("above" + haze).c_str(), depth, sun, zenith, azimuth, wanted,
            [&](std::uint64_t paths, unsigned seed) {
              return shells.above(zenith * kDegree, azimuth * kDegree, paths, seed);
            });
      }
  };
  for (const double depth : {0.1, 0.35}) {
    ifov::atmosphere::test::Air air;
    air.rayleigh = depth;
    const auto column = air.column();
    for (const double sun : {60.0, 75.0, 84.0, 87.0, 89.0, 90.0, 92.0, 94.0, 96.0})
      rows(SphericalMonteCarlo(column.levels.altitude_km, column.optics.rayleigh_scattering, sun * kDegree),
           "", depth, sun, {0.0, 40.0, 60.0, 75.0, 80.0});
  }
  const ifov::atmosphere::test::Air air;
  const auto column = air.column();
  for (const double sun : {60.0, 75.0, 84.0, 87.0, 89.0, 92.0}) {
    SphericalMonteCarlo shells(column.levels.altitude_km, column.optics.rayleigh_scattering, sun * kDegree);
    shells.add_haze(column.optics.aerosol_scattering, air.asymmetry);
    rows(shells, "_haze", air.rayleigh, sun, {0.0, 60.0, 75.0, 80.0});
  }
}
