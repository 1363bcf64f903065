#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

#include "atmosphere/column/atmosphere_column.h"
#include "atmosphere/gas/band_model.h"
#include "atmosphere/gas/gas_transmittance.h"
#include "atmosphere/scattering/column_solver.h"
#include "atmosphere/scattering/ground_spread.h"
#include "atmosphere/scattering/phase/scattering_matrix.h"
#include "atmosphere/sensor/model_error_table.h"
#include "figure_data.h"
#include "geodesy/moon_position.h"
#include "geodesy/sun_position.h"
#include "geodesy/utc_time.h"

namespace ifov::figures {

void print_sun() {
  constexpr double kDegree = std::numbers::pi / 180.0;
  for (const char* day : {"2026-03-20", "2026-06-21", "2026-12-21"})
    for (int minute = 0; minute < 24 * 60; minute += 10) {
      char time[32];
      std::snprintf(time, sizeof time, "%sT%02d:%02d:00Z", day, minute / 60, minute % 60);
      const geodesy::SunPosition sun =
          geodesy::sun_position(geodesy::parse_utc(time), {48.2 * kDegree, 16.4 * kDegree, 0.0});
      std::printf("sun %s %.4f %.4f %.4f\n", day, minute / 60.0, sun.azimuth_rad / kDegree,
                  sun.elevation_rad / kDegree);
    }
  geodesy::MoonPosition moon;
  moon.distance_m = 384400e3;
  for (int g = 0; g <= 150; ++g) {
    moon.phase_angle_rad = g * kDegree;
    std::printf("moon %d %.6e\n", g, geodesy::moonlight_ratio(moon));
  }
}

void print_gases() {
  using namespace atmosphere;
  const Profile profile = model_atmosphere("mid-latitude summer").between(0.0, kTopOfAtmosphereKm);
  const GasAmounts amounts = vertical_amounts(profile, 0.0, kTopOfAtmosphereKm);
  // Evenly over the logarithm of wavelength, means over 20 cm-1 or more, as the bands resolve.
  constexpr int kPoints = 400;
  for (int k = 0; k < kPoints; ++k) {
    const double um = 0.3 * std::pow(15.0 / 0.3, (k + 0.5) / kPoints),
                 half = 0.5 * std::log(15.0 / 0.3) / kPoints;
    const int first = static_cast<int>(1e4 / um * (1.0 - half) / 5.0),
              last = static_cast<int>(1e4 / um * (1.0 + half) / 5.0);
    double water = 0.0, carbon = 0.0, ozone = 0.0, oxygen = 0.0, all = 0.0;
    for (int bin = first; bin <= last; ++bin) {
      const double wavenumber = 5.0 * bin;
      const ContinuumDepths continuum = continuum_depths(wavenumber, amounts, GasModel::standard);
      const auto lines = [&](Gas gas) {
        return line_transmittance(gas, wavenumber, amounts, GasModel::standard);
      };
      water += lines(Gas::h2o) * std::exp(-continuum.water);
      carbon += lines(Gas::co2);
      ozone += lines(Gas::o3) * std::exp(-continuum.ozone);
      oxygen += lines(Gas::o2) * std::exp(-continuum.oxygen - continuum.oxygen_pairs);
      all += gas_transmittance(wavenumber, amounts, GasModel::standard);
    }
    const double count = last - first + 1;
    std::printf("gas %.5f %.5f %.5f %.5f %.5f %.5f\n", um, water / count, carbon / count, ozone / count,
                oxygen / count, all / count);
  }
  constexpr double kExponent = 0.4704;  // the worst of the band model
  for (const int count : {3, 5, 8}) {
    const AbsorptionTerms& terms = absorption_terms(kExponent, count);
    for (int k = 0; k <= 160; ++k) {
      const double x = std::pow(10.0, -5.0 + k / 20.0);
      double sum = 0.0;
      for (std::size_t j = 0; j < terms.k.size(); ++j) sum += terms.weight[j] * std::exp(-terms.k[j] * x);
      std::printf("terms %d %.6e %.7f %.7f\n", count, x, std::exp(-std::pow(x, kExponent)), sum);
    }
    for (std::size_t j = 0; j < terms.k.size(); ++j)
      std::printf("term %d %.6e %.6f\n", count, terms.k[j], terms.weight[j]);
  }
}

void print_phase() {
  for (int degree = 0; degree <= 180; ++degree) {
    const double cosine = std::cos(degree * std::numbers::pi / 180.0);
    const atmosphere::ScatteringMatrix air = atmosphere::rayleigh_matrix(cosine, 0.03);
    const atmosphere::ScatteringMatrix haze = atmosphere::aerosol_matrix(cosine, 0.65, 0.1);
    std::printf("phase %d %.6f %.6f %.6f %.6f\n", degree, air.a1, -air.b1 / air.a1, haze.a1,
                -haze.b1 / haze.a1);
  }
}

void print_round_earth() {
  using namespace atmosphere;
  constexpr double kDegree = std::numbers::pi / 180.0, kWavelength_um = 0.55;
  AtmosphereDescription description;
  description.air.model = "mid-latitude summer";
  const AtmosphereColumn column(description);
  const LayerOptics layers = column.at(5.0 * std::round(1e4 / kWavelength_um / 5.0)).term(0);
  const double ground_km = column.levels().altitude_km.front(), top_km = column.levels().altitude_km.back();
  for (const double sun : {30.0, 60.0, 80.0, 88.0}) {
    const ColumnSolution solved = ColumnSolver().solve(column.levels(), layers, sun * kDegree);
    for (int zenith = 0; zenith <= 80; zenith += 5) {
      const double mu = std::cos(zenith * kDegree);
      const Propagation up{mu, 0.5}, down{-mu, 0.5};
      const double flat_up = solved.sunlit().path(up, top_km).radiance().i,
                   flat_down = solved.sunlit().path(down, ground_km).radiance().i;
      std::printf("round %g %d %.5f %.5f\n", sun, zenith,
                  flat_up / solved.sunlit().line_of_sight(up, top_km, ground_km).radiance().i,
                  flat_down / solved.sunlit().sky(down, ground_km).radiance().i);
    }
  }
}

void print_adjacency() {
  using namespace atmosphere;
  const auto print = [](const char* kind, double um, const GroundSpread& spread) {
    for (int k = 0; k <= 80; ++k) {
      const double km = 0.01 * std::pow(10.0, k / 20.0);
      std::printf("within %s %g %.5f %.5f\n", kind, um, km, spread.within(km));
    }
  };
  const auto spread = [](const AtmosphereDescription& description, double um, GroundSpread::Sight line) {
    const AtmosphereColumn column(description);
    return GroundSpread(column.levels().altitude_km, column.at(5.0 * std::round(1e4 / um / 5.0)).term(0),
                        line, 1 << 16);
  };
  AtmosphereDescription hazy, clear;
  hazy.air.model = clear.air.model = "mid-latitude summer";
  clear.aerosol.type = "none";
  for (const double um : {0.45, 0.865}) print("hazy", um, spread(hazy, um, {}));
  print("clear", 0.45, spread(clear, 0.45, {}));
  print("low", 0.45, spread(hazy, 0.45, {0.0, 2.0}));
}

void print_model_error() {
  using namespace atmosphere;
  const ModelErrorTable& table = ModelErrorTable::built_in();
  constexpr int kPoints = 300;
  for (const char* name : {"tropical", "subarctic winter"}) {
    const Profile profile = model_atmosphere(name).between(0.0, kTopOfAtmosphereKm);
    const GasAmounts amounts = vertical_amounts(profile, 0.0, kTopOfAtmosphereKm);
    const double water = profile.precipitable_water_g_cm2();
    std::printf("water %c %.3f\n", *name, water);
    // Steps of about 1 % of the wavelength.
    for (int k = 0; k < kPoints; ++k) {
      const double um = 0.36 * std::pow(15.0 / 0.36, (k + 0.5) / kPoints),
                   half = 0.5 * std::log(15.0 / 0.36) / kPoints;
      const int first = static_cast<int>(1e4 / um * (1.0 - half) / 5.0),
                last = static_cast<int>(1e4 / um * (1.0 + half) / 5.0);
      double seen = 0.0, less = 0.0;
      for (int bin = first; bin <= last; ++bin) {
        const double one = std::max(1e-30, gas_transmittance(5.0 * bin, amounts, GasModel::standard));
        seen += one;
        less += one * std::exp(table.of_depth(2000.0 / bin, {1.0, water, -std::log(one), 0.0}));
      }
      std::printf("model_error %c %.5f %.6f %.5f\n", *name, um, seen / (last - first + 1), less / seen - 1.0);
    }
  }
}

}  // namespace ifov::figures
