#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "studies/temperature/temperature_checks.h"
#include "thermal/faces/sky_longwave.h"
#include "thermal/surface_exchange.h"
#include "thermal/surface_solution.h"
#include "thermal/therm_slab.h"

namespace ifov::studies {
namespace {

constexpr double kSigma = 5.670374419e-8;

/// A plate that emits, and takes from the Sun, the sky and the air.
class PlateGain final : public thermal::SurfaceExchange {
 public:
  PlateGain(double absorbed, double sky_k, double h, double air_k)
      : absorbed_(absorbed), sky_k_(sky_k), h_(h), air_k_(air_k) {}
  thermal::SurfaceGain gain(double, double t) const override {
    return {absorbed_ + kEmissivity * kSigma * (std::pow(sky_k_, 4) - std::pow(t, 4)) + h_ * (air_k_ - t),
            -4.0 * kEmissivity * kSigma * std::pow(t, 3) - h_};
  }

 private:
  static constexpr double kEmissivity = 0.9;
  double absorbed_, sky_k_, h_, air_k_;
};

/// Clear days of June at 45 degrees.
thermal::OutdoorsSeries clear_days(double days) {
  thermal::OutdoorsSeries series;
  constexpr double kTurn = 2.0 * std::numbers::pi, kLatitude = kTurn / 8.0, kDeclination = 0.4;
  for (int i = 0; i <= static_cast<int>(days * 86400.0 / series.step_s); ++i) {
    const double hour_angle = kTurn * (i * series.step_s / 86400.0 - 0.5);
    thermal::Outdoors now;
    const double height = std::sin(kLatitude) * std::sin(kDeclination) +
                          std::cos(kLatitude) * std::cos(kDeclination) * std::cos(hour_angle);
    now.sun_elevation_rad = std::asin(height);
    now.direct_w_m2 = height > 0.0 ? 900.0 * (1.0 - std::exp(-8.0 * height)) : 0.0;
    now.diffuse_w_m2 = 100.0 * std::max(0.0, height);
    now.air = {293.0 - 6.0 * std::cos(hour_angle + 0.7 * std::numbers::pi), 1000.0, 101325.0};
    now.longwave_w_m2 = thermal::sky_longwave_w_m2(now.air.temperature_k, 1000.0, 0.0);
    now.wind_m_s = 3.0 + std::sin(5.0 * hour_angle);
    series.rows.push_back(now);
  }
  return series;
}

}  // namespace

double steady_plate_k(double absorbed_w_m2, double sky_k, double convection_w_m2_k, double air_k) {
  return thermal::balanced_temperature_k(PlateGain(absorbed_w_m2, sky_k, convection_w_m2_k, air_k), 0.0, 0.0,
                                         0.0, 280.0);
}

double heat_unaccounted() {
  const thermal::Solid road{{{0.06, 0.75, 2360.0, 920.0}, {0.5, 0.30, 1600.0, 800.0}},
                            thermal::DeepGround{290.0}};
  thermal::Skin wet;
  wet.wetness = {0.4, 70.0};
  double worst = 0.0;
  for (const thermal::Skin& skin : {thermal::Skin{}, wet}) {
    const thermal::SurfaceSolution solution = thermal::solve_surface(road, skin, {}, clear_days(4.0));
    const thermal::History& history = solution.history;
    const thermal::Fluxes& mean = solution.mean;
    const double all_s = history.nodes.back().time_s - history.nodes.front().time_s,
                 in = mean.sun + mean.sky + mean.sky_longwave,
                 out = -(mean.emitted + mean.convection + mean.latent) + history.out_of_back_j_m2 / all_s;
    worst = std::max(worst, std::abs(in - out - history.stored_j_m2 / all_s) / in);
  }
  return worst;
}

double therm_error_k(double exposed_area) {
  thermal::ThermSlab slab;
  slab.density_kg_m3 = 2000.0;
  slab.specific_heat_j_kg_k = 900.0;
  slab.conductivity_w_m_k = 1.0;
  slab.thickness_m = 0.05;
  slab.solar_absorption = 0.7;
  slab.emissivity = 0.9;
  slab.exposed_area = exposed_area;
  const thermal::OutdoorsSeries series = clear_days(1.0);
  const thermal::SurfaceSolution solution = thermal::solve_surface(
      thermal::solid_of(slab), thermal::skin_of(slab), {}, series, thermal::Start::air);
  // By hand: explicit steps of a quarter of a second, 1.5 faces in the air.
  constexpr int kSlices = 50;
  constexpr double kSlice_m = 0.05 / kSlices, kStep_s = 0.25, kFaces = 1.5;
  std::vector<double> t(kSlices, series.rows[0].air.temperature_k), flux(kSlices + 1, 0.0);
  double worst_k = 0.0, surface_k = t[0];
  for (std::size_t row = 0; row + 1 < series.rows.size(); ++row) {
    if (row >= 12) worst_k = std::max(worst_k, std::abs(surface_k - solution.surface_k(row)));
    const thermal::Outdoors &a = series.rows[row], &b = series.rows[row + 1];
    const auto on_level = [](const thermal::Outdoors& now) {
      return now.direct_w_m2 * std::max(0.0, std::sin(now.sun_elevation_rad)) + now.diffuse_w_m2;
    };
    for (int k = 0; k < static_cast<int>(series.step_s / kStep_s); ++k) {
      const double share = k * kStep_s / series.step_s;
      const double wind_m_s =
          std::lerp(a.wind_m_s, b.wind_m_s, share) * std::log(2.0 / 0.03) / std::log(10.0 / 0.03);
      const double warmer_k = surface_k - std::lerp(a.air.temperature_k, b.air.temperature_k, share);
      const double natural = (warmer_k > 0.0 ? 1.52 : -0.76) * std::cbrt(warmer_k);
      const double h = natural + 1.11 * (std::hypot(natural, 3.26 * std::pow(wind_m_s, 0.89)) - natural);
      const double gain = 0.7 * std::lerp(on_level(a), on_level(b), share) +
                          0.9 * std::lerp(a.longwave_w_m2, b.longwave_w_m2, share) -
                          0.9 * kSigma * std::pow(surface_k, 4) - kFaces * h * warmer_k;
      surface_k += (gain - 2.0 / kSlice_m * (surface_k - t[0])) / (2.0 / kSlice_m + 6.0 + kFaces * h);
      flux[0] = 2.0 / kSlice_m * (surface_k - t[0]);
      for (std::size_t i = 1; i < kSlices; ++i) flux[i] = (t[i - 1] - t[i]) / kSlice_m;
      for (std::size_t i = 0; i < kSlices; ++i)
        t[i] += kStep_s * (flux[i] - flux[i + 1]) / (2000.0 * 900.0 * kSlice_m);
    }
  }
  return worst_k;
}

}  // namespace ifov::studies
