// Sheets both faces of which are outdoors, and leaves.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "atmosphere/weather_series.h"
#include "core/error.h"
#include "outdoors.h"
#include "thermal/faces/leaf.h"
#include "thermal/faces/sky_longwave.h"
#include "thermal/surface_classes.h"
#include "thermal/surface_solution.h"

namespace ifov::thermal::test_faces {
namespace {

using test::june;

constexpr double kPi = std::numbers::pi, kSigma = kStefanBoltzmann_w_m2_k4;
constexpr double kWidth_m = 0.05, kCharacteristic_m = 0.72 * kWidth_m;

Skin leaf_skin(double stomata, int faces = 1) {
  Skin skin;
  skin.two_faces = true;
  skin.solar_absorptance = 0.5;
  skin.emissivity = 0.97;
  skin.leaf = {kWidth_m, stomata, faces};
  return skin;
}

Solid sheet() { return {{{1e-3, 50.0, 7800.0, 450.0}}, OtherFace{}}; }

Skin sheet_skin() {
  Skin skin;
  skin.two_faces = true;
  skin.solar_absorptance = 0.8;
  skin.emissivity = 0.9;
  skin.roughness = Roughness::smooth;
  return skin;
}

Stand standing(double tilt_deg, double azimuth_deg) {
  Stand stand;
  stand.tilt_rad = tilt_deg * kPi / 180.0;
  stand.azimuth_rad = azimuth_deg * kPi / 180.0;
  return stand;
}

Outdoors noon() {
  Outdoors now;
  now.direct_w_m2 = 800.0;
  now.diffuse_w_m2 = 100.0;
  now.sun_azimuth_rad = kPi;
  now.sun_elevation_rad = kPi / 6.0;
  now.longwave_w_m2 = 300.0;
  now.air = {290.0, 1000.0, 101325.0};
  now.wind_m_s = 4.0;
  return now;
}

OutdoorsSeries always(const Outdoors& now) {
  OutdoorsSeries series;
  series.rows = {now, now};
  return series;
}

// Properties of air at 20 degrees Celsius (Incropera, table A.4): W m-1 K-1, m2 s-1.
constexpr double kAirConducts = 0.0257, kAirViscosity = 1.516e-5, kPrandtl = 0.709;

// Pohlhausen's laminar boundary layer along a plate, Nu = 0.664 Re^1/2 Pr^1/3, with the 1.4 of gusts.
TEST(Leaf, ForcedAsAlongAPlate) {
  for (const double wind_m_s : {0.5, 2.0, 6.0}) {
    const double reynolds = wind_m_s * kCharacteristic_m / kAirViscosity;
    const double plate = 0.664 * std::sqrt(reynolds) * std::cbrt(kPrandtl) * kAirConducts / kCharacteristic_m;
    EXPECT_NEAR(leaf_forced_convection(wind_m_s, kWidth_m), 1.4 * plate, 0.02 * 1.4 * plate);
  }
  EXPECT_NEAR(leaf_forced_convection(2.0, 4.0 * kWidth_m), 0.5 * leaf_forced_convection(2.0, kWidth_m), 1e-9);
}

// McAdams: Nu = 0.54 Ra^1/4 above a warm plate, 0.27 Ra^1/4 below it.
TEST(Leaf, FreeAsAboveAPlate) {
  for (const double warmer_k : {2.0, 8.0}) {
    const double rayleigh =
        9.81 / 293.0 * warmer_k * std::pow(kCharacteristic_m, 3) * kPrandtl / (kAirViscosity * kAirViscosity);
    const double plate = 0.54 * std::pow(rayleigh, 0.25) * kAirConducts / kCharacteristic_m;
    EXPECT_NEAR(leaf_convection(warmer_k, 1.0, 0.0, kWidth_m).h_w_m2_k, plate, 0.06 * plate);
    EXPECT_NEAR(leaf_convection(warmer_k, -1.0, 0.0, kWidth_m).h_w_m2_k, 0.5 * plate, 0.03 * plate);
    EXPECT_NEAR(leaf_convection(-warmer_k, -1.0, 0.0, kWidth_m).h_w_m2_k, plate, 0.06 * plate);
  }
  const auto h = [](double warmer_k) { return leaf_convection(warmer_k, 0.4, 5.0, kWidth_m); };
  EXPECT_NEAR(h(3.0).slope_w_m2_k2, (h(3.001).h_w_m2_k - h(2.999).h_w_m2_k) / 0.002, 1e-6);
  EXPECT_NEAR(h(-3.0).slope_w_m2_k2, (h(-2.999).h_w_m2_k - h(-3.001).h_w_m2_k) / 0.002, 1e-6);
}

/// Campbell and Norman (1998), eq. 14.6, of a leaf near the air's temperature: what it takes in beyond what it would emit at that, less what
/// evaporates at the air's deficit, over what convection, radiation and vapour take by kelvin.
double by_hand_k(const Outdoors& now, const Skin& skin, double conductance, double taken_in_w_m2) {
  constexpr double kHeat = 29.3, kLatent = 44100.0;
  const double layer = 1.4 * std::sqrt(now.wind_m_s / kCharacteristic_m);
  const double stomata = skin.leaf.stomatal_mol_m2_s, vapour = 0.147 * layer;
  const double of_vapour =
      conductance * skin.leaf.stomatal_faces * (stomata > 0.0 ? stomata * vapour / (stomata + vapour) : 0.0);
  const double air_k = now.air.temperature_k, saturated = atmosphere::saturation_pressure_pa(air_k);
  const double slope =
      (atmosphere::saturation_pressure_pa(air_k + 0.01) - atmosphere::saturation_pressure_pa(air_k - 0.01)) /
      0.02;
  const double excess = taken_in_w_m2 - 2.0 * skin.emissivity * kSigma * std::pow(air_k, 4) -
                        kLatent * of_vapour * (saturated - now.air.vapour_pa) / now.air.pressure_pa;
  return air_k + excess / (2.0 * kHeat * 0.135 * layer + 8.0 * skin.emissivity * kSigma * std::pow(air_k, 3) +
                           kLatent * of_vapour * slope / now.air.pressure_pa);
}

// Vapour by 2.45 MJ/kg and 18.015 g/mol through a boundary layer and stomata in series, summed here.
TEST(Leaf, LatentHeatOfVapourThroughBoth) {
  const MoistAir air{293.15, 1200.0, 101325.0};
  const double deficit_pa = atmosphere::saturation_pressure_pa(301.15) - air.vapour_pa, stomata = 0.25;
  const auto through = [&](double h_w_m2_k) {
    const double layer = h_w_m2_k / 29.3 * 1.0889;  // mol m-2 s-1: 0.147 / 0.135 of that of heat
    return 2.45e6 * 0.018015 * deficit_pa / air.pressure_pa / (1.0 / layer + 1.0 / stomata);
  };
  const Coefficient wet{18.0, 0.0}, other{12.0, 0.0};
  const double both = leaf_latent_heat({0.05, stomata, 2}, 301.15, air, wet, other).w_m2;
  EXPECT_NEAR(both, through(18.0) + through(12.0), 2e-3 * both);
  EXPECT_NEAR(leaf_latent_heat({0.05, stomata, 1}, 301.15, air, wet, other).w_m2, 0.5 * both, 1e-9 * both);
}

TEST(Leaf, InEquilibriumAsCampbellAndNormanHaveIt) {
  Outdoors now = noon();
  now.air.vapour_pa = 0.6 * atmosphere::saturation_pressure_pa(now.air.temperature_k);
  const OutdoorsSeries series = always(now);
  for (const int faces : {1, 2})
    for (const double stomata : {0.0, 0.1, 0.4}) {
      const Skin skin = leaf_skin(stomata, faces);
      const SurfaceBalance balance(series, skin, Stand{});
      const Fluxes taken = balance.fluxes(0.0, 290.0);
      const double taken_in =
          taken.sun + taken.sky + taken.reflected + taken.sky_longwave + taken.ground_longwave;
      // The wind at the leaf is that of its lowest height.
      Outdoors here = now;
      here.wind_m_s = wind_at_m_s(now.wind_m_s, series.anemometer, 0.0, Terrain::open);
      const double found = balanced_temperature_k(balance, 0.0, 0.0, 0.0, 290.0);
      const double expected = by_hand_k(here, skin, 1.0, taken_in);
      EXPECT_NEAR(found, expected, 0.05 + 0.03 * std::abs(expected - 290.0)) << faces << " " << stomata;
      EXPECT_LT(std::abs(found - 290.0), 6.0);
      // A fault: one face's stomata for both, or both for one.
      if (stomata <= 0.0) continue;
      EXPECT_GT(std::abs(found - by_hand_k(here, skin, faces == 1 ? 2.0 : 0.5, taken_in)), 0.3);
    }
}

TEST(Leaf, StomataAreShutInTheDarkAndDewPassesNone) {
  Outdoors night = noon();
  night.direct_w_m2 = night.diffuse_w_m2 = 0.0;
  const SurfaceBalance dry(always(night), leaf_skin(0.4), Stand{});
  EXPECT_EQ(dry.fluxes(0.0, 290.0).latent, 0.0);
  EXPECT_LT(SurfaceBalance(always(noon()), leaf_skin(0.4), Stand{}).fluxes(0.0, 290.0).latent, -20.0);
  night.air.vapour_pa = 1.2 * atmosphere::saturation_pressure_pa(288.0);
  const SurfaceBalance dewy(always(night), leaf_skin(0.4), Stand{});
  EXPECT_GT(dewy.fluxes(0.0, 288.0).latent, 10.0);
  const auto gain = [&](double t) { return dewy.gain(0.0, t); };
  EXPECT_NEAR(gain(288.0).slope_w_m2_k, (gain(288.01).w_m2 - gain(287.99).w_m2) / 0.02, 1e-3);
}

TEST(Leaf, StaysNearTheAir) {
  const OutdoorsSeries series = june(4.0);
  const Solid water{{{2e-4, 0.613, 997.0, 4179.0}}, OtherFace{}};
  const auto largest = [&](const Skin& skin) {
    const SurfaceSolution leaf = solve_surface(water, skin, Stand{}, series);
    double most_k = 0.0;
    for (std::size_t row = series.rows.size() - 288; row < series.rows.size(); ++row)
      most_k = std::max(most_k, std::abs(leaf.surface_k(row) - series.rows[row].air.temperature_k));
    return most_k;
  };
  EXPECT_LT(largest(leaf_skin(0.4)), 3.0);
  Skin wide = leaf_skin(0.4);
  wide.leaf.width_m = 1.0;
  EXPECT_GT(largest(wide), 4.0);  // as a sheet of a metre it would not
}

TEST(TwoFaces, TakeInWhatComesToEither) {
  const OutdoorsSeries series = always(noon());
  const Skin skin = sheet_skin();
  // A wall that faces north, the Sun behind it, of whose other face half is hidden.
  const SurfaceBalance balance(series, skin, standing(90.0, 0.0), {0.25, 0.25}, {0.5, 0.5});
  const Fluxes fluxes = balance.fluxes(10.0, 300.0);
  EXPECT_NEAR(fluxes.sun, 0.25 * 0.8 * 800.0 * std::cos(kPi / 6.0), 1e-9);
  EXPECT_NEAR(fluxes.sky, 0.8 * 100.0 * 0.5, 1e-9);
  EXPECT_NEAR(fluxes.reflected, 0.8 * 0.2 * 500.0 * 1.5, 1e-9);
  EXPECT_NEAR(fluxes.sky_longwave, 0.9 * 300.0 * 0.5, 1e-9);
  EXPECT_NEAR(fluxes.ground_longwave, 0.9 * kSigma * std::pow(290.0, 4) * 1.5, 1e-9);
  EXPECT_NEAR(fluxes.emitted, -2.0 * 0.9 * kSigma * std::pow(300.0, 4), 1e-9);
  const double wind = wind_at_m_s(4.0, series.anemometer, 0.0, Terrain::open);
  const auto h = [&](double cos_tilt, double azimuth_rad) {
    return convection(10.0, cos_tilt, forced_convection(wind, windward_share(0.5 * kPi, azimuth_rad, 0.0)),
                      Roughness::smooth)
        .h_w_m2_k;
  };
  EXPECT_NEAR(fluxes.convection, -10.0 * (h(0.0, 0.0) + h(0.0, kPi)), 0.01);
  EXPECT_NEAR(balance.gain(10.0, 300.0).slope_w_m2_k,
              (balance.gain(10.0, 300.01).w_m2 - balance.gain(10.0, 299.99).w_m2) / 0.02, 1e-4);
}

// Which face is called the front is no matter; and a sheet of so little mass follows C dT/dt = gain, by steps of a second.
TEST(TwoFaces, AreOneSheetEitherWay) {
  const OutdoorsSeries series = june(4.0);
  for (const double tilt_deg : {0.0, 35.0, 90.0}) {
    const SurfaceSolution one = solve_surface(sheet(), sheet_skin(), standing(tilt_deg, 100.0), series);
    const SurfaceSolution other =
        solve_surface(sheet(), sheet_skin(), standing(180.0 - tilt_deg, 280.0), series);
    double least_k = 1e9, most_k = 0.0;
    for (std::size_t row = 0; row < series.rows.size(); ++row) {
      EXPECT_NEAR(one.surface_k(row), other.surface_k(row), 1e-4);
      least_k = std::min(least_k, one.surface_k(row));
      most_k = std::max(most_k, one.surface_k(row));
    }
    EXPECT_GT(most_k - least_k, 15.0);
    const double capacity = 1e-3 * 7800.0 * 450.0;
    double lumped_k = one.surface_k(200);
    const double begin_s = series.begin_s + 200.0 * series.step_s;
    const int steps = static_cast<int>(200.0 * series.step_s);
    for (int i = 0; i < steps; ++i) lumped_k += one.balance.gain(begin_s + i, lumped_k).w_m2 / capacity;
    EXPECT_NEAR(lumped_k, one.surface_k(400), 0.05);
  }
}

// A fault: the sheet taken to be insulated behind. Lit from there it would be colder by kelvins, and lit in front warmer.
TEST(TwoFaces, WithoutTheOtherOneAreOffByKelvins) {
  const OutdoorsSeries series = june(4.0);
  Skin one = sheet_skin();
  one.two_faces = false;
  const auto noon_k = [&](const Skin& skin, const Back& back, double azimuth_deg) {
    return solve_surface({sheet().layers, back}, skin, standing(90.0, azimuth_deg), series)
        .surface_k(series.rows.size() - 144);
  };
  const double sheet_k = noon_k(sheet_skin(), OtherFace{}, 0.0);
  EXPECT_GT(sheet_k - noon_k(one, Insulated{}, 0.0), 2.0);
  EXPECT_GT(noon_k(one, Insulated{}, 180.0) - sheet_k, 2.0);
}

double class_k(const SurfaceClasses& classes, const Pose& pose, double free_sky,
               const std::vector<double>& visibility) {
  std::vector<double> weight_k(classes.sunlit_rows());
  double sum_k = classes.shaded(pose, free_sky, weight_k).kelvin;
  for (std::size_t k = 0; k < weight_k.size(); ++k)
    sum_k += weight_k[k] * visibility[classes.row_of_series(k)];
  return sum_k;
}

TEST(TwoFaces, HaveClasses) {
  OutdoorsSeries series = june(4.0);
  series.rows.resize(series.rows.size() - 120);  // two in the afternoon
  const SurfaceClasses classes(std::make_shared<const OutdoorsSeries>(series),
                               {sheet(), sheet_skin(), Stand{}}, 0);
  double worst_k = 0.0;
  for (const auto& [tilt, azimuth] : {std::pair{0.0, 0.0}, {40.0, 30.0}, {83.0, 65.0}, {90.0, 240.0}})
    for (const double free_sky : {0.3, 1.0})
      for (const double seen : {0.0, 1.0}) {
        const Stand stand = standing(tilt, azimuth);
        const math::Vec3 normal{std::sin(stand.tilt_rad) * std::sin(stand.azimuth_rad),
                                std::sin(stand.tilt_rad) * std::cos(stand.azimuth_rad),
                                std::cos(stand.tilt_rad)};
        const std::vector<double> visibility(series.rows.size(), seen);
        Stand there = stand;
        there.free_sky = free_sky;
        const double full_k = solve_surface(sheet(), sheet_skin(), there, series, Start::steady, visibility)
                                  .history.nodes.back()
                                  .surface_k;
        worst_k = std::max(worst_k, std::abs(class_k(classes, normal, free_sky, visibility) - full_k));
        EXPECT_NEAR(class_k(classes, normal, free_sky, visibility),
                    class_k(classes, -normal, free_sky, visibility), 0.02);
      }
  EXPECT_LT(worst_k, 0.5);
}

TEST(TwoFaces, OfASheetThatHeatPassesBadlyAreAnError) {
  const Solid fence{{{0.02, 0.13, 500.0, 1600.0}}, OtherFace{}};
  try {
    check(fence);
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_STREQ(
        error.what(),
        "the two faces of a sheet are taken to have one temperature, and this one's layers have a resistance "
        "of 0.154 m2 K W-1, expected at most 0.01: say what is behind it otherwise, as a room or insulated");
  }
  EXPECT_NO_THROW(check(sheet()));
}

}  // namespace
}  // namespace ifov::thermal::test_faces
