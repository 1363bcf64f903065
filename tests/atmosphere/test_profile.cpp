#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>

#include "atmosphere/profile/built_profile.h"
#include "atmosphere/profile/profile_description.h"
#include "core/error.h"
#include "lowtran_output.h"
#include "measured.h"
#include "support/truth_data.h"

namespace ifov::atmosphere::test_profile {
namespace {

ProfileDescription of_1986(const std::string& model) {
  ProfileDescription description;
  description.model = model;
  description.co2_ppm = description.ch4_ppm = description.n2o_ppm = std::nullopt;
  return description;
}

// Profiles of Anderson et al. (1986) as another program has them: altitude, pressure, temperature and number
// densities of air, ozone, oxygen, water vapour and carbon dioxide.
TEST(Profile, ModelAtmospheresAsPublished) {
  const std::map<std::string, std::string> files{
      {"tropical", "afglt"},          {"mid-latitude summer", "afglms"}, {"mid-latitude winter", "afglmw"},
      {"subarctic summer", "afglss"}, {"subarctic winter", "afglsw"},    {"US standard 1976", "afglus"}};
  for (const auto& [name, stem] : files) {
    const auto file = ifov::test::truth_file("atmosphere/afgl_profiles/" + stem + ".dat");
    if (!file) GTEST_SKIP() << "reference data not found: atmosphere/afgl_profiles/" << stem << ".dat";
    const Profile& model = model_atmosphere(name);
    std::ifstream stream(*file);
    int compared = 0;
    for (std::string line; std::getline(stream, line);) {
      std::istringstream words(line);
      double z, p, t, air, o3, o2, h2o;
      if (!(words >> z >> p >> t >> air >> o3 >> o2 >> h2o) || z > 90.0) continue;
      // The 1992 tables have other values here, 3 % in pressure and 0.5 K off.
      if (name == "US standard 1976" && (z == 32.5 || z == 37.5)) continue;
      EXPECT_NEAR(model.pressure_at(z) / p, 1.0, 2e-3) << name << " " << z;
      EXPECT_NEAR(model.temperature_at(z), t, 0.06) << name << " " << z;
      const Profile here = model.between(z, 120.0);
      EXPECT_NEAR(here.air_per_cm3(0) / air, 1.0, 0.01) << name << " " << z;
      EXPECT_NEAR(here.of(Gas::o3)[0] / (1e6 * o3 / air), 1.0, 0.01) << name << " " << z;
      EXPECT_NEAR(here.of(Gas::h2o)[0] / (1e6 * h2o / air), 1.0, 0.01) << name << " " << z;
      ++compared;
    }
    EXPECT_GT(compared, 40);
  }
  EXPECT_EQ(model_atmosphere_names().size(), files.size());
}

// Columns printed by MODTRAN6 for mid-latitude summer over ground at 0.35 km (molecules of the same
// profiles).
TEST(Profile, ColumnsAsModtran6) {
  ProfileDescription description = of_1986("mid-latitude summer");
  description.ground_altitude_km = 0.35;
  description.co2_ppm = 450.0;
  const Profile profile = build_profile(description).profile;
  EXPECT_NEAR(profile.pressure_hPa[0], 972.674, 0.5);
  EXPECT_NEAR(profile.temperature_K[0], 292.62, 0.06);
  EXPECT_NEAR(profile.relative_humidity_percent(0), 72.38, 1.5);
  EXPECT_NEAR(profile.precipitable_water_g_cm2() / 2.46511, 1.0, 0.01);
  EXPECT_NEAR(profile.column_atm_cm(Gas::o3) / (0.30009 / 0.90720), 1.0, 0.01);
  EXPECT_NEAR(profile.column_atm_cm(Gas::co2) / 346.97, 1.0, 0.005);
  EXPECT_NEAR(profile.column_atm_cm(Gas::n2o) / 0.22722, 1.0, 0.005);
  EXPECT_NEAR(profile.column_atm_cm(Gas::ch4) / 1.2141, 1.0, 0.005);
  EXPECT_NEAR(profile.column_atm_cm(Gas::co) / 0.082978, 1.0, 0.01);
  EXPECT_NEAR(profile.column_atm_cm(Gas::o2) / 1.6115e5, 1.0, 0.005);
}

// Columns of water vapour that MODTRAN5 prints for these models.
TEST(Profile, PrecipitableWaterOfTheModels) {
  for (const auto& [name, column] :
       std::map<std::string, double>{{"tropical", 4.114728}, {"US standard 1976", 1.416445}}) {
    EXPECT_NEAR(build_profile(of_1986(name)).profile.precipitable_water_g_cm2() / column, 1.0, 0.005) << name;
  }
}

TEST(Profile, WhatIsAskedForIsThere) {
  ProfileDescription description;
  description.water_vapour_g_cm2 = 2.1;
  description.ozone_DU = 320.0;
  const BuiltProfile built = build_profile(description);
  EXPECT_NEAR(built.profile.precipitable_water_g_cm2(), 2.1, 1e-6);
  EXPECT_NEAR(built.profile.column_atm_cm(Gas::o3), 0.320, 1e-6);
  EXPECT_DOUBLE_EQ(built.profile.of(Gas::co2)[0], 420.0);
  EXPECT_DOUBLE_EQ(built.profile.of(Gas::ch4)[0], 1.9);
  EXPECT_DOUBLE_EQ(built.profile.of(Gas::n2o)[0], 0.335);
  EXPECT_TRUE(built.remarks.empty());
  EXPECT_EQ(built.profile.altitude_km.back(), 100.0);
}

TEST(Profile, ModelAtmospheresNeedNoRemark) {
  for (const std::string& name : model_atmosphere_names()) {
    ProfileDescription description;
    description.model = name;
    EXPECT_TRUE(build_profile(description).remarks.empty())
        << name << ": " << build_profile(description).remarks[0];
  }
}

TEST(Profile, HumidityStaysAtSaturationAndIsSaid) {
  ProfileDescription description;
  description.water_vapour_g_cm2 = 4.2;  // the model has 2.9
  const BuiltProfile moist = build_profile(description);
  EXPECT_NEAR(moist.profile.precipitable_water_g_cm2(), 4.2, 1e-5);
  for (std::size_t i = 0; i < moist.profile.levels(); ++i)
    EXPECT_LE(moist.profile.relative_humidity_percent(i), 100.0 + 1e-9);
  ASSERT_EQ(moist.remarks.size(), 1u);
  EXPECT_EQ(moist.remarks[0],
            "with 4.2 g/cm2 of water vapour the air saturates; relative humidity is kept at 100 % there and "
            "the rest of "
            "the profile is moister instead");
  description.water_vapour_g_cm2 = 12.0;
  const BuiltProfile full = build_profile(description);
  EXPECT_LT(full.profile.precipitable_water_g_cm2(), 8.0);
  ASSERT_EQ(full.remarks.size(), 1u);
  EXPECT_TRUE(full.remarks[0].starts_with("12 g/cm2 of water vapour is more than this air can hold"))
      << full.remarks[0];
  description.limit_humidity = false;
  EXPECT_NEAR(build_profile(description).profile.precipitable_water_g_cm2(), 12.0, 1e-5);
}

// Goff and Gratch (1946) as tabulated: 6.1078 hPa at 0 C, 23.373 hPa at 20 C, 42.43 hPa at 30 C; p = rho R T
// / M.
TEST(Profile, SaturationOverWater) {
  for (const auto& [celsius, hectopascal] :
       std::map<double, double>{{0, 6.1078}, {20, 23.373}, {30, 42.430}, {-20, 1.2540}}) {
    const double t = 273.15 + celsius;
    EXPECT_NEAR(saturated_vapour_g_m3(t) / (100.0 * hectopascal * 18.015 / (8.314463 * t)), 1.0, 0.005)
        << celsius;
  }
}

TEST(Profile, OwnLevelsJoinTheModel) {
  ProfileDescription description;
  description.levels = {
      {0.2, 990.0, 295.0, 60.0, {}, {}}, {1.5, 850.0, 287.0, {}, 9.0, {}}, {5.0, 550.0, 265.0, 30.0, {}, {}}};
  const Profile profile = build_profile(description).profile;
  EXPECT_EQ(profile.ground_km(), 0.2);
  EXPECT_EQ(profile.pressure_hPa[0], 990.0);
  EXPECT_NEAR(profile.relative_humidity_percent(0), 60.0, 1e-9);
  const std::size_t second = 1;
  EXPECT_EQ(profile.altitude_km[second], 1.5);
  const double vapour = profile.of(Gas::h2o)[second] * 1e-6;
  EXPECT_NEAR(vapour / (1.0 - vapour) * 18.015 / 28.964, 9.0e-3, 1e-9);
  const Profile& model = model_atmosphere(description.model);
  EXPECT_NEAR(profile.pressure_at(20.0) / model.pressure_at(20.0), 550.0 / model.pressure_at(5.0), 1e-9);
  EXPECT_EQ(profile.temperature_at(20.0), model.temperature_at(20.0));
  description.ground_altitude_km = 1.0;
  EXPECT_EQ(build_profile(description).profile.ground_km(), 1.0);
}

TEST(Profile, WrongInputIsNamed) {
  const auto message = [](const std::function<void(ProfileDescription&)>& change) -> std::string {
    ProfileDescription description;
    description.levels = {{0.0, 1000.0, 290.0, 50.0, {}, {}}, {2.0, 800.0, 280.0, 50.0, {}, {}}};
    change(description);
    try {
      build_profile(description);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message([](auto&) {}), "");
  EXPECT_EQ(message([](auto& d) { d.model = "midlatitude summer"; }),
            "'midlatitude summer' is no model atmosphere; expected 'tropical', 'mid-latitude summer', "
            "'mid-latitude "
            "winter', 'subarctic summer', 'subarctic winter' or 'US standard 1976'; did you mean "
            "'mid-latitude summer'?");
  EXPECT_EQ(message([](auto& d) { d.levels[1].altitude_km = 0.0; }),
            "the altitudes of a profile must rise: 0 km follows 0 km");
  EXPECT_EQ(message([](auto& d) { d.levels[1].pressure_hPa = 1001.0; }),
            "pressure 1001 hPa at 2 km: expected above 0 and falling with altitude");
  EXPECT_EQ(message([](auto& d) { d.levels[0].temperature_K = 20.0; }),
            "temperature 20 K at 0 km: expected 120 to 350 K");
  EXPECT_EQ(message([](auto& d) { d.levels[0].mixing_ratio_g_kg = 5.0; }),
            "the level at 0 km has both a relative humidity and a mixing ratio; expected one");
  EXPECT_EQ(message([](auto& d) { d.levels.pop_back(); }),
            "a profile of one level: expected two or more, or none for the model's own");
  EXPECT_EQ(message([](auto& d) { d.ground_altitude_km = -0.1; }),
            "the ground at -0.1 km is below the lowest level of the profile, 0 km");
  EXPECT_EQ(message([](auto& d) { d.ground_altitude_km = 6.5; }), "ground at 6.5 km: expected below 6 km");
  EXPECT_EQ(message([](auto& d) { d.levels[1].relative_humidity_percent = -5.0; }),
            "relative humidity, %, of -5 at 2 km: expected 0 or more");
  EXPECT_EQ(message([](auto& d) {
              d.levels.push_back({60.0, 0.2, 260.0, 30.0, {}, {}});
            }),
            "water vapour of 0.668 hPa at 60 km: expected less than the 0.2 hPa of the air there");
  EXPECT_EQ(message([](auto& d) { d.levels[0].ozone_ppmv = -1.0; }),
            "ozone, ppmv, of -1 at 0 km: expected 0 or more");
  EXPECT_EQ(message([](auto& d) { d.ozone_DU = -1.0; }), "ozone of -1 DU: expected 0 or more");
}

}  // namespace
}  // namespace ifov::atmosphere::test_profile
