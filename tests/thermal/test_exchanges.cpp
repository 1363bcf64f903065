#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "atmosphere/weather_series.h"
#include "core/error.h"
#include "exchanges.h"
#include "thermal/faces/convection.h"
#include "thermal/faces/evaporation.h"
#include "thermal/faces/sky_longwave.h"
#include "thermal/sun_split.h"
#include "thermal/wind_levels.h"

namespace ifov::thermal::test_exchanges {
namespace {

constexpr double kPi = std::numbers::pi;

/// absorbed + e L = e sigma T^4 + h (T - T_a).
class PlateExchange : public SurfaceExchange {
 public:
  PlateExchange(double absorbed, double sky_k, double h, double air_k)
      : absorbed_(absorbed), sky_k_(sky_k), h_(h), air_k_(air_k) {}
  SurfaceGain gain(double, double t) const override {
    const double emitted = 0.9 * kStefanBoltzmann_w_m2_k4;
    return {absorbed_ + emitted * (std::pow(sky_k_, 4) - std::pow(t, 4)) + h_ * (air_k_ - t),
            -4.0 * emitted * std::pow(t, 3) - h_};
  }

 private:
  double absorbed_, sky_k_, h_, air_k_;
};

TEST(SteadyPlate, InSunAndByNight) {
  EXPECT_NEAR(balanced_temperature_k(PlateExchange(900.0, 280.0, 10.0, 300.0), 0.0, 0.0, 0.0, 280.0), 347.204,
              1e-3);
  EXPECT_NEAR(balanced_temperature_k(PlateExchange(0.0, 230.0, 5.0, 285.0), 0.0, 0.0, 0.0, 280.0), 263.990,
              1e-3);
  // A fault: a sky as warm as the air.
  EXPECT_GT(
      std::abs(balanced_temperature_k(PlateExchange(0.0, 285.0, 5.0, 285.0), 0.0, 0.0, 0.0, 280.0) - 263.990),
      20.0);
}

TEST(SteadyPlate, WithoutABalanceIsAnError) {
  EXPECT_THROW(
      balanced_temperature_k(test::LinearExchange([](double) { return 10.0; }), 0.0, 0.0, 0.0, 280.0),
      InputError);
}

// ASHRAE's constants, of which Walton's formulas are made: 1.31 for walls, 1.52 for warm roofs, 0.76 for cold ones.
TEST(Convection, NaturalOfWallsAndRoofs) {
  EXPECT_NEAR(natural_convection(8.0, 0.0).h_w_m2_k, 1.31 * 2.0, 0.002);
  EXPECT_NEAR(natural_convection(-8.0, 0.0).h_w_m2_k, 1.31 * 2.0, 0.002);
  EXPECT_NEAR(natural_convection(8.0, 1.0).h_w_m2_k, 1.52 * 2.0, 0.002);
  EXPECT_NEAR(natural_convection(-8.0, 1.0).h_w_m2_k, 0.76 * 2.0, 0.002);
  EXPECT_NEAR(natural_convection(-8.0, -1.0).h_w_m2_k, 1.52 * 2.0, 0.002);
}

TEST(Convection, SlopesAreDerivatives) {
  for (const double warmer : {-12.0, -0.5, 0.5, 12.0})
    for (const double wind : {0.0, 1.0, 6.0}) {
      const auto h = [&](double t) {
        return convection(t, 0.7, forced_convection(wind, 1.0), Roughness::very_rough).h_w_m2_k;
      };
      EXPECT_NEAR(convection(warmer, 0.7, forced_convection(wind, 1.0), Roughness::very_rough).slope_w_m2_k2,
                  (h(warmer + 1e-5) - h(warmer - 1e-5)) / 2e-5, 1e-6);
    }
}

TEST(Convection, ForcedByWindAndRoughness) {
  EXPECT_NEAR(forced_convection(4.0, 1.0), 3.26 * 3.434, 0.01);  // 4^0.89
  EXPECT_NEAR(forced_convection(4.0, 0.0), 3.55 * 2.352, 0.01);  // 4^0.617
  const double natural = natural_convection(5.0, 1.0).h_w_m2_k;
  const double glass = std::hypot(natural, forced_convection(3.0, true));
  EXPECT_NEAR(convection(5.0, 1.0, forced_convection(3.0, 1.0), Roughness::very_smooth).h_w_m2_k, glass,
              1e-12);
  EXPECT_NEAR(convection(5.0, 1.0, forced_convection(3.0, 1.0), Roughness::rough).h_w_m2_k,
              natural + 1.67 * (glass - natural), 1e-12);
  EXPECT_TRUE(faces_wind(0.1, 0.0, kPi));
  EXPECT_FALSE(faces_wind(0.5 * kPi, 0.0, kPi));
  EXPECT_TRUE(faces_wind(0.5 * kPi, 0.1, 2.0 * kPi - 0.1));
}

/// Where the wind's direction is not known, a wall is as on average over all of them, whatever it faces; a roof that is flat is to windward.
TEST(Convection, WindOfUnknownDirection) {
  constexpr int kDirections = 720;
  for (const double tilt : {0.1, 0.5, 0.5 * kPi})
    for (const double azimuth : {0.0, 1.3, 4.0}) {
      double mean = 0.0;
      for (int k = 0; k < kDirections; ++k)
        mean += forced_convection(
                    4.0, faces_wind(tilt, azimuth, 2.0 * kPi * (k + 0.5) / kDirections) ? 1.0 : 0.0) /
                kDirections;
      const double share = windward_share(tilt, azimuth, NAN);
      // Air as warm as the surface: forced convection alone, of glass.
      EXPECT_NEAR(
          convection(0.0, std::cos(tilt), forced_convection(4.0, share), Roughness::very_smooth).h_w_m2_k,
          mean, 0.005)
          << tilt << " " << azimuth;
      EXPECT_EQ(windward_share(tilt, azimuth, 0.3, 0.0), faces_wind(tilt, azimuth, 0.3) ? 1.0 : 0.0);
    }
  // A fault: taken for a wind from the north, a wall that faces south would be to leeward.
  EXPECT_LT(forced_convection(4.0, windward_share(0.5 * kPi, kPi, 0.0)),
            0.9 * forced_convection(4.0, windward_share(0.5 * kPi, kPi, NAN)));
}

/// Walton's step, averaged over directions drawn at equal shares of a normal distribution.
double mean_of_steps(double tilt, double azimuth, double from, double spread) {
  constexpr int kPlaces = 400001;
  constexpr double kSides = 8.0;
  double mean = 0.0, all = 0.0;
  for (int k = 0; k < kPlaces; ++k) {
    const double z = kSides * (2.0 * k / (kPlaces - 1) - 1.0), density = std::exp(-0.5 * z * z);
    all += density;
    mean += density * (faces_wind(tilt, azimuth, from + spread * z) ? 1.0 : 0.0);
  }
  return mean / all;
}

TEST(Convection, WindFluctuatesInDirection) {
  constexpr double kDegree = kPi / 180.0;
  double fault = 0.0;
  for (const double spread : {2.5 * kDegree, kWindSpread_rad, 60.0 * kDegree})
    for (int off = -180; off <= 180; off += 20) {
      const double from = 1.1, azimuth = from + off * kDegree;
      const double share = windward_share(0.5 * kPi, azimuth, from, spread);
      EXPECT_NEAR(share, mean_of_steps(0.5 * kPi, azimuth, from, spread), 1e-4) << spread << " " << off;
      // A fault: the step itself.
      fault = std::max(fault, std::abs(share - (faces_wind(0.5 * kPi, azimuth, from) ? 1.0 : 0.0)));
    }
  EXPECT_GT(fault, 0.3);
  // Of a table of the normal distribution: half at the step, one and two standard deviations beside it; the same to both sides.
  for (const double side : {-1.0, 1.0}) {
    const auto at = [&](double off) {
      return windward_share(0.5 * kPi, side * (100.0 * kDegree + off * kWindSpread_rad), 0.0);
    };
    EXPECT_NEAR(at(0.0), 0.5, 1e-6);
    EXPECT_NEAR(at(-1.0), 0.84134, 1e-5);
    EXPECT_NEAR(at(1.0), 0.15866, 1e-5);
    EXPECT_NEAR(at(2.0), 0.02275, 1e-5);
  }
  EXPECT_EQ(windward_share(0.1, 2.0, 5.0), 1.0);
}

/// With less and less fluctuation the share is Walton's step, with more and more that of all directions.
TEST(Convection, FluctuationsGoFromTheStepToAllDirections) {
  for (const double off : {0.0, 1.0, 1.7, 1.8, 2.5, kPi, -1.7, -1.8}) {
    EXPECT_NEAR(windward_share(0.5 * kPi, off, 0.0, 1e-3), faces_wind(0.5 * kPi, off, 0.0) ? 1.0 : 0.0,
                1e-12);
    EXPECT_NEAR(windward_share(0.5 * kPi, off, 0.0, 12.0), windward_share(0.5 * kPi, off, NAN), 1e-10);
  }
}

/// Between walls every 30 degrees a line is off by no more than 30^2 / 8 times the largest curvature of an error function,
/// exp(-1/2) / sqrt(2 pi) / spread^2.
TEST(Convection, ClassesOfWallsCanInterpolate) {
  constexpr double kDegree = kPi / 180.0;
  const auto most_off = [&](double spread) {
    double most = 0.0;
    for (int from = 0; from < 30; ++from)
      for (int wall = 0; wall < 360; ++wall) {
        const auto at = [&](int azimuth) {
          return windward_share(0.5 * kPi, azimuth * kDegree, from * kDegree, spread);
        };
        const int west = wall / 30 * 30;
        most = std::max(most, std::abs(std::lerp(at(west), at(west + 30), (wall - west) / 30.0) - at(wall)));
      }
    return most;
  };
  EXPECT_LT(most_off(kWindSpread_rad), 0.122);
  EXPECT_GT(most_off(0.0), 0.9);  // a fault: the step
}

/// EPA-454/R-99-005 (2000), table 6-8: Pasquill's class C is from 12.5 to 17.5 degrees. Walton (1983): flat is below 8 degrees,
/// to windward up to 100.
TEST(Convection, AnglesAreAsPublished) {
  constexpr double kDegree = kPi / 180.0;
  EXPECT_NEAR(kWindSpread_rad / kDegree, 0.5 * (12.5 + 17.5), 1e-12);
  for (const double from : {0.3, 5.0}) {
    const double leeward = from + kPi;
    EXPECT_TRUE(faces_wind(7.95 * kDegree, leeward, from));
    EXPECT_FALSE(faces_wind(8.05 * kDegree, leeward, from));
    EXPECT_EQ(windward_share(7.95 * kDegree, leeward, from), 1.0);
    EXPECT_LT(windward_share(8.05 * kDegree, leeward, from), 1e-6);
    EXPECT_TRUE(faces_wind(0.5 * kPi, from + 99.5 * kDegree, from));
    EXPECT_FALSE(faces_wind(0.5 * kPi, from + 100.5 * kDegree, from));
  }
}

/// Walton (1983), of ASHRAE's classes.
TEST(Convection, RoughnessFactorsAreAsPublished) {
  EXPECT_EQ(roughness_factor(Roughness::very_rough), 2.17);
  EXPECT_EQ(roughness_factor(Roughness::rough), 1.67);
  EXPECT_EQ(roughness_factor(Roughness::medium_rough), 1.52);
  EXPECT_EQ(roughness_factor(Roughness::medium_smooth), 1.13);
  EXPECT_EQ(roughness_factor(Roughness::smooth), 1.11);
  EXPECT_EQ(roughness_factor(Roughness::very_smooth), 1.0);
}

/// Davenport's classes 1, 2, 3, 5 and 7 as Wieringa (1992) has them, metres.
TEST(WindProfile, RoughnessLengthsAreAsPublished) {
  EXPECT_EQ(roughness_length_m(Terrain::sea), 0.0002);
  EXPECT_EQ(roughness_length_m(Terrain::smooth), 0.005);
  EXPECT_EQ(roughness_length_m(Terrain::open), 0.03);
  EXPECT_EQ(roughness_length_m(Terrain::rough), 0.25);
  EXPECT_EQ(roughness_length_m(Terrain::suburb), 1.0);
}

TEST(WindProfile, LogarithmicOverOneTerrain) {
  const Anemometer station;
  EXPECT_NEAR(wind_at_m_s(5.0, station, 10.0, Terrain::open), 5.0, 1e-12);
  EXPECT_NEAR(wind_at_m_s(5.0, station, 2.0, Terrain::open),
              5.0 * std::log(2.0 / 0.03) / std::log(10.0 / 0.03), 1e-12);
  // At the ground there is no wind at all, and less than 10 m up: what convection goes by is that of 2 m.
  EXPECT_EQ(wind_at_m_s(5.0, station, 0.0, Terrain::open), wind_at_m_s(5.0, station, 2.0, Terrain::open));
  EXPECT_LT(wind_at_m_s(5.0, station, 0.0, Terrain::open), 0.73 * 5.0);  // a fault: the wind at 10 m
}

TEST(WindProfile, OtherTerrainsShareTheWindAt60Metres) {
  const Anemometer station;
  const double open = wind_at_m_s(5.0, station, 60.0, Terrain::open);
  for (const Terrain terrain : {Terrain::sea, Terrain::smooth, Terrain::rough, Terrain::suburb})
    EXPECT_NEAR(wind_at_m_s(5.0, station, 60.0, terrain), open, 1e-12);
  EXPECT_NEAR(wind_at_m_s(5.0, station, 10.0, Terrain::suburb), open * std::log(10.0) / std::log(60.0),
              1e-12);
}

/// By the law itself, written out: ln(z / z0) of all levels is that of the lowest times a power of one ratio.
TEST(WindLevels, StandAtEqualRatiosOfTheWind) {
  for (const Terrain terrain :
       {Terrain::sea, Terrain::smooth, Terrain::open, Terrain::rough, Terrain::suburb}) {
    const WindLevels levels(terrain);
    const double z0 = roughness_length_m(terrain);
    ASSERT_GE(levels.highest(), 1);
    EXPECT_EQ(levels.height_m(0), 0.0);
    EXPECT_NEAR(levels.height_m(levels.highest()), 60.0, 1e-9);
    const double all = std::log(60.0 / z0) / std::log(2.0 / z0);
    const double ratio = std::pow(all, 1.0 / levels.highest());
    EXPECT_LE(ratio, 1.2 + 1e-12);
    EXPECT_GT(std::pow(all, 1.0 / std::max(1, levels.highest() - 1)), levels.highest() > 1 ? 1.2 : 1.0);
    for (int level = 1; level <= levels.highest(); ++level) {
      EXPECT_NEAR(std::log(levels.height_m(level) / z0) / std::log(2.0 / z0), std::pow(ratio, level), 1e-9);
      EXPECT_NEAR(levels.place(levels.height_m(level)), level, 1e-9);
    }
    for (const double height_m : {0.0, 1.0, 2.0}) EXPECT_EQ(levels.place(height_m), 0.0);
    EXPECT_NEAR(levels.place(20.0), std::log(std::log(20.0 / z0) / std::log(2.0 / z0)) / std::log(ratio),
                1e-9);
    EXPECT_NEAR(levels.place(300.0), levels.highest(), 1e-12);
  }
}

TEST(SkyLongwave, PrataAndCloud) {
  // Dry air: 1 - exp(-sqrt(1.2)). 288.15 K and 10 hPa: w = 1.6137.
  EXPECT_NEAR(clear_sky_emissivity(280.0, 0.0), 1.0 - std::exp(-std::sqrt(1.2)), 1e-12);
  EXPECT_NEAR(clear_sky_emissivity(288.15, 1000.0), 1.0 - 2.61374 * std::exp(-std::sqrt(1.2 + 4.84123)),
              1e-4);
  EXPECT_NEAR(sky_emissivity(0.7, 0.0), 0.7, 1e-12);
  EXPECT_NEAR(sky_emissivity(0.7, 0.5), 0.85, 1e-12);
  EXPECT_NEAR(sky_longwave_w_m2(285.0, 900.0, 1.0), kStefanBoltzmann_w_m2_k4 * std::pow(285.0, 4), 1e-9);
}

TEST(SunSplit, ErbsIsContinuousAndSums) {
  EXPECT_NEAR(diffuse_share(0.22), diffuse_share(0.2200001), 5e-4);
  EXPECT_NEAR(diffuse_share(0.8), diffuse_share(0.8000001), 5e-3);
  EXPECT_NEAR(diffuse_share(0.5), 0.6592, 5e-4);
  for (const double elevation : {0.02, 0.2, 1.0}) {
    const SunAndSky split = split_global(500.0 * std::sin(elevation), elevation, 1.0);
    EXPECT_NEAR(split.direct_w_m2 * std::sin(elevation) + split.diffuse_w_m2, 500.0 * std::sin(elevation),
                1e-9);
    EXPECT_LE(split.direct_w_m2, kSolarConstant_w_m2);
  }
  EXPECT_EQ(split_global(3.0, -0.01, 1.0).direct_w_m2, 0.0);
  EXPECT_EQ(split_global(40.0, 0.052, 1.0).direct_w_m2, 0.0);  // 3 degrees: no jump there
  EXPECT_NEAR(split_global(40.0, 0.0525, 1.0).direct_w_m2, 0.0, 6.0);
}

// Allen et al. (1998), eq. 3, with the slope of the saturation pressure at the air's temperature, is the balance to first
// order in T - T_a: with little radiation and a small deficit both agree.
TEST(Evaporation, PenmanAndMonteith) {
  MoistAir air{293.15, 0.0, 101325.0};
  air.vapour_pa = 0.97 * atmosphere::saturation_pressure_pa(293.15);
  const Coefficient h{12.0, 0.0};
  const Wetness wetness{1.0, 70.0};
  const double available = 20.0;  // R_n - G
  double surface_k = 293.15;
  for (int i = 0; i < 50; ++i) {
    const LatentHeat latent = latent_heat(wetness, surface_k, air, h);
    surface_k += (available - 12.0 * (surface_k - 293.15) - latent.w_m2) / (12.0 + latent.slope_w_m2_k);
  }
  const double density = air_density_kg_m3(air), ra = density * kAirHeat_j_kg_k / 12.0;
  const double slope =
      (atmosphere::saturation_pressure_pa(293.16) - atmosphere::saturation_pressure_pa(293.14)) / 0.02;
  const double gamma = kAirHeat_j_kg_k * 101325.0 / (0.622 * kLatentHeat_j_kg);
  const double deficit = 0.03 * atmosphere::saturation_pressure_pa(293.15);
  const auto expected = [&](double resistance) {
    return (slope * available + density * kAirHeat_j_kg_k * deficit / ra) /
           (slope + gamma * (1.0 + resistance / ra));
  };
  const double found = latent_heat(wetness, surface_k, air, h).w_m2;
  EXPECT_NEAR(found, expected(70.0), 0.01 * found);
  EXPECT_GT(std::abs(found - expected(75.0)), 0.01 * found);  // the test sees 5 s/m
}

TEST(Evaporation, DewPassesNoStomataAndDrySurfacesNothing) {
  const MoistAir air{293.15, 2000.0, 101325.0};
  const Coefficient h{12.0, 0.3};
  EXPECT_EQ(latent_heat({0.0, 0.0}, 300.0, air, h).w_m2, 0.0);
  EXPECT_EQ(latent_heat({1.0, 70.0}, 280.0, air, h).w_m2, latent_heat({1.0, 0.0}, 280.0, air, h).w_m2);
  EXPECT_LT(latent_heat({1.0, 70.0}, 280.0, air, h).w_m2, 0.0);
  EXPECT_LT(latent_heat({1.0, 70.0}, 300.0, air, h).w_m2, 0.6 * latent_heat({1.0, 0.0}, 300.0, air, h).w_m2);
  // Slopes, with a coefficient that changes as 12 + 0.3 (T - 300).
  const auto at = [&](double t) { return latent_heat({0.5, 70.0}, t, air, {12.0 + 0.3 * (t - 300.0), 0.3}); };
  EXPECT_NEAR(at(300.0).slope_w_m2_k, (at(300.01).w_m2 - at(299.99).w_m2) / 0.02, 1e-4);
}

/// A loss that goes as the root of how much warmer a surface is than 300 K: from every temperature Newton's method goes to the other side,
/// and back.
class RootExchange : public SurfaceExchange {
 public:
  SurfaceGain gain(double, double surface_k) const override {
    const double warmer_k = surface_k - 300.0, root = std::sqrt(std::max(std::abs(warmer_k), 1e-18));
    return {-std::copysign(10.0 * root, warmer_k), -5.0 / root};
  }
};

TEST(BalancedTemperature, IsFoundAboutACusp) {
  EXPECT_NEAR(balanced_temperature_k(RootExchange(), 0.0, 1e-6, 300.0, 301.0), 300.0, 1e-6);
  EXPECT_NEAR(balanced_temperature_k(RootExchange(), 0.0, 2.0, 310.0, 290.0), 302.34436, 1e-4);
}

}  // namespace
}  // namespace ifov::thermal::test_exchanges
