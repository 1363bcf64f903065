// Amounts of gases as a user asks for them.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <memory>
#include <numeric>
#include <string>

#include "atmosphere/column/atmosphere_column.h"
#include "atmosphere/gas/gas_transmittance.h"
#include "atmosphere/profile/built_profile.h"
#include "atmosphere/profile/gas_requests.h"
#include "column_maker.h"
#include "core/error.h"
#include "support/truth_data.h"

namespace ifov::atmosphere::test_gas_requests {
namespace {

ProfileDescription asking(const GasRequests& gases) {
  ProfileDescription air;
  air.gases = std::make_shared<const GasRequests>(gases);
  return air;
}

ProfileDescription asking(Gas gas, const GasRequest& request) {
  GasRequests gases;
  gases.of[static_cast<std::size_t>(gas)] = request;
  return asking(gases);
}

GasRequest column(double atm_cm) {
  GasRequest request;
  request.column_atm_cm = atm_cm;
  return request;
}

std::string refused(const ProfileDescription& air) {
  try {
    build_profile(air);
  } catch (const InputError& error) {
    return error.what();
  }
  return "taken";
}

/// Exponent of a gas's band in LOWTRAN7's table.
double exponent(const std::string& gas, double wavenumber_cm1) {
  std::ifstream stream(*ifov::test::truth_file("atmosphere/lowtran7/table_band_params.csv"));
  for (std::string line; std::getline(stream, line);) {
    double low = 0.0, high = 0.0, a = 0.0;
    if (line.rfind(gas + ",", 0) == 0 &&
        std::sscanf(line.c_str() + gas.size() + 1, "%lf,%lf,%lf", &low, &high, &a) == 3 &&
        low <= wavenumber_cm1 && wavenumber_cm1 <= high)
      return a;
  }
  return 0.0;
}

// Where lines absorb, twice the gas is 2^a times the logarithm; where there are none, twice: Beer's law by the exponents of the
// tables that LOWTRAN7's program itself has.
TEST(GasRequests, TwiceTheGasIsBeersLawByTheTablesExponents) {
  if (!ifov::test::truth_file("atmosphere/lowtran7/table_band_params.csv"))
    GTEST_SKIP() << "reference data not found: atmosphere/lowtran7/table_band_params.csv";
  const auto depth = [](Gas gas, double atm_cm, double wavenumber_cm1) {
    const Profile profile = build_profile(asking(gas, column(atm_cm))).profile;
    return -std::log(
        line_transmittance(gas, wavenumber_cm1, vertical_amounts(profile, 0.0, 100.0), GasModel::standard));
  };
  struct Case {
    Gas gas;
    const char* name;
    double wavenumber_cm1, atm_cm;
  };
  for (const Case& of : {Case{Gas::o3, "O3", 1040.0, 0.3}, Case{Gas::ch4, "CH4", 3020.0, 1.5},
                         Case{Gas::so2, "SO2", 1360.0, 0.01}}) {
    const double a = exponent(of.name, of.wavenumber_cm1);
    ASSERT_GT(a, 0.4) << of.name;
    const double once = depth(of.gas, of.atm_cm, of.wavenumber_cm1),
                 twice = depth(of.gas, 2.0 * of.atm_cm, of.wavenumber_cm1);
    ASSERT_GT(once, 1e-3) << of.name;
    EXPECT_NEAR(std::log2(twice / once), a, 1e-6) << of.name;
  }
}

// In Chappuis's bands by the table of cross-sections, c per atm-cm: 300 DU of ozone have 0.3 c.
TEST(GasRequests, OzoneOfTheVisibleIsTheTables) {
  const auto file = ifov::test::truth_file("atmosphere/lowtran7/table_o3_uvvis.csv");
  if (!file) GTEST_SKIP() << "reference data not found: atmosphere/lowtran7/table_o3_uvvis.csv";
  const auto absorption = [](double atm_cm, double wavenumber_cm1) {
    GasRequests gases;
    for (std::optional<GasRequest>& gas : gases.of) gas.emplace().off = true;
    gases.of[static_cast<std::size_t>(Gas::o3)] = column(atm_cm);
    AtmosphereDescription description;
    description.air = asking(gases);
    description.aerosol.type = "none";
    const LayerOptics layers = AtmosphereColumn(description).at(wavenumber_cm1).term(0);
    return std::accumulate(layers.gas_absorption.begin(), layers.gas_absorption.end(), 0.0);
  };
  std::ifstream stream(*file);
  int compared = 0;
  for (std::string line; std::getline(stream, line);) {
    double wavenumber = 0.0, coefficient = 0.0;
    if (std::sscanf(line.c_str(), "%lf,%lf", &wavenumber, &coefficient) != 2 || wavenumber > 24000.0 ||
        coefficient < 0.01)
      continue;
    if (++compared % 8 != 0) continue;
    EXPECT_NEAR(absorption(0.3, wavenumber) / (0.3 * coefficient), 1.0, 1e-4) << wavenumber;
    EXPECT_NEAR(absorption(0.6, wavenumber) / absorption(0.3, wavenumber), 2.0, 1e-9) << wavenumber;
  }
  EXPECT_GT(compared, 30);
}

// Without any gas that absorbs air is molecules that scatter: Bodhaine et al. (1999), equation 30, and nothing from 2 to 15 um.
TEST(GasRequests, WithoutGasesAirOnlyScatters) {
  GasRequests gases;
  for (std::size_t g = 0; g < kGasCount; ++g)
    if (static_cast<Gas>(g) != Gas::co2) gases.of[g].emplace().off = true;
  gases.nitrogen = false;
  AtmosphereDescription description;
  description.aerosol.type = "none";
  const auto absorbed = [&](double wavelength_um) {
    description.air = asking(gases);
    description.air.model = "US standard 1976";
    const ColumnOptics optics = AtmosphereColumn(description).at(1e4 / wavelength_um);
    double most = 0.0;
    for (std::size_t t = 0; t < optics.terms(); ++t)
      for (const double depth : optics.term(t).gas_absorption) most = std::max(most, depth);
    if (wavelength_um < 1.0) {
      const std::vector<double>& molecules = optics.scattering.rayleigh_scattering;
      EXPECT_NEAR(
          std::accumulate(molecules.begin(), molecules.end(), 0.0) / test::rayleigh_depth(wavelength_um), 1.0,
          0.01)
          << wavelength_um;
    }
    return most;
  };
  EXPECT_GT(absorbed(4.26), 0.1) << "carbon dioxide is there";
  gases.of[static_cast<std::size_t>(Gas::co2)].emplace().off = true;
  for (const double wavelength_um :
       {0.26, 0.35, 0.45, 0.577, 0.6, 0.762, 0.94, 1.27, 2.7, 4.26, 6.3, 9.6, 15.0, 30.0})
    EXPECT_EQ(absorbed(wavelength_um), 0.0) << wavelength_um;
  gases.nitrogen = true;
  EXPECT_GT(absorbed(4.26), 0.0) << "nitrogen is left";
}

// A mixing ratio that is the same at all heights is that share of the air, whose column is p / (m g): 1013 hPa weigh 10,330 kg/m2.
TEST(GasRequests, AProfileOfOnesOwnHasTheColumnThatWeighs) {
  GasRequest request;
  request.levels = {{0.0, 2.0}, {7.0, 2.0}, {100.0, 2.0}};
  ProfileDescription air = asking(Gas::co, request);
  air.model = "US standard 1976";
  const BuiltProfile built = build_profile(air);
  const double molecules_cm2 = 1013.25e2 / (9.78 * 28.964e-3) * 6.022045e23 * 1e-4;  // with g half way up
  EXPECT_NEAR(built.profile.column_atm_cm(Gas::co) / (2e-6 * molecules_cm2 / kLoschmidtCm3), 1.0, 0.005);
  EXPECT_TRUE(built.remarks.empty());
  // Linear between: 4 ppm at the ground that end at 8 km; what lies above is the model's.
  request.levels = {{0.0, 4.0}, {8.0, 0.0}};
  air = asking(Gas::so2, request);
  const Profile profile = build_profile(air).profile;
  EXPECT_NEAR(profile.between(3.0, 100.0).of(Gas::so2)[0], 2.5, 1e-9);
  EXPECT_EQ(profile.between(20.0, 100.0).of(Gas::so2)[0],
            build_profile({}).profile.between(20.0, 100.0).of(Gas::so2)[0]);
}

TEST(GasRequests, ProfilesAreScaledToColumns) {
  GasRequest request = column(0.28);
  request.levels = {{0.0, 0.02}, {20.0, 3.0}, {35.0, 7.0}, {60.0, 1.0}};
  const Profile scaled = build_profile(asking(Gas::o3, request)).profile;
  EXPECT_NEAR(scaled.column_atm_cm(Gas::o3), 0.28, 1e-9);
  EXPECT_NEAR(scaled.between(20.0, 100.0).of(Gas::o3)[0] / scaled.of(Gas::o3)[0], 150.0, 1e-6);
  const Profile wet = build_profile(asking(Gas::h2o, column(1.3 * kVapourAtmCmPerGram))).profile;
  EXPECT_NEAR(wet.precipitable_water_g_cm2(), 1.3, 1e-6);
  GasRequest ground;
  ground.ground_ppmv = 560.0;
  EXPECT_NEAR(build_profile(asking(Gas::co2, ground)).profile.of(Gas::co2)[0], 560.0, 1e-9);
}

TEST(GasRequests, WhatIsMadeUpIsSaid) {
  GasRequest request;
  request.levels = {{2.0, 0.03}, {30.0, 6.0}};
  const std::vector<std::string> remarks = build_profile(asking(Gas::o3, request)).remarks;
  ASSERT_EQ(remarks.size(), 2u);
  EXPECT_EQ(
      remarks[0],
      "the profile of O3 begins at 2 km, above the ground at 0 km: its lowest value, 0.03 ppm, holds below");
  EXPECT_EQ(remarks[1].substr(0, 74),
            "the profile of O3 ends at 30 km: above it the model atmosphere's goes on, ");
  request.levels = {{2.0, 0.03}, {1.0, 6.0}};
  EXPECT_EQ(refused(asking(Gas::o3, request)),
            "the altitudes of the profile of O3 must rise: 1 km follows 2 km");
  request.levels = {{2.0, 0.03}, {5.0, -6.0}};
  EXPECT_EQ(refused(asking(Gas::o3, request)), "O3 of -6 ppm: expected 0 or more");
  request.levels = {{0.0, 0.0}, {100.0, 0.0}};
  request.column_atm_cm = 0.1;
  EXPECT_EQ(refused(asking(Gas::o3, request)), "the profile has no O3 that a column could be scaled from");
  request.levels = {{-3.0, 1.0}, {-1.0, 0.0}};
  EXPECT_EQ(refused(asking(Gas::o3, request)),
            "the profile of O3 reaches from -3 to -1 km, and the air from 0 to 100 km");
}

}  // namespace
}  // namespace ifov::atmosphere::test_gas_requests
