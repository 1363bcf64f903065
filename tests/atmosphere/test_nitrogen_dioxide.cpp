// The band of nitrogen dioxide in the ultraviolet and the visible, which LOWTRAN7 lacks.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "atmosphere/column/atmosphere_column.h"
#include "atmosphere/gas/gas_transmittance.h"
#include "atmosphere/profile/built_profile.h"
#include "atmosphere/profile/gas_requests.h"

namespace ifov::atmosphere::test_nitrogen_dioxide {
namespace {

constexpr double kMoleculesPerAtmCm = 2.6867774e19;

ProfileDescription with_column(double atm_cm) {
  GasRequests gases;
  GasRequest& request = gases.of[static_cast<std::size_t>(Gas::no2)].emplace();
  request.column_atm_cm = atm_cm;
  ProfileDescription air;
  air.gases = std::make_shared<const GasRequests>(gases);
  return air;
}

/// cm2 per molecule, of air at 294 K, by way of the whole column.
double cross_section(double um) {
  GasAmounts amounts;
  amounts.nitrogen_dioxide = 1.0;
  amounts.nitrogen_dioxide_temperature = 294.0 - 220.0;
  return continuum_depths(1e4 / um, amounts, GasModel::standard).nitrogen_dioxide / kMoleculesPerAtmCm;
}

}  // namespace

// What instruments with lasers at 405 and 532 nm take for it: 5.9 to 6.1e-19 and 1.45e-19 cm2 (Osthoff et al. 2006, Rev. Sci. Instrum.
// 77, 114104; Fuchs et al. 2009, Environ. Sci. Technol. 43, 7831). The table has means over 5 nm.
TEST(NitrogenDioxide, AbsorbsAsInstrumentsFind) {
  EXPECT_NEAR(cross_section(0.405), 6.0e-19, 0.3e-19);
  EXPECT_NEAR(cross_section(0.532), 1.45e-19, 0.15e-19);
  EXPECT_EQ(cross_section(0.70), 0.0);
  EXPECT_EQ(cross_section(2.0), 0.0);
}

TEST(NitrogenDioxide, IsInTheColumnByBeersLaw) {
  const auto through = [](double um, double atm_cm, GasModel model) {
    const Profile profile = build_profile(with_column(atm_cm)).profile;
    return gas_transmittance(1e4 / um, vertical_amounts(profile, profile.ground_km(), 100.0), model);
  };
  // 1 Dobson unit, by far most of it where it is 220 to 260 K.
  constexpr double kDobson = 1e-3;
  const double depth =
      std::log(through(0.4, 1e-9, GasModel::standard) / through(0.4, kDobson, GasModel::standard));
  EXPECT_NEAR(depth, kDobson * kMoleculesPerAtmCm * 6.41e-19, 1e-4);
  EXPECT_NEAR(
      std::log(through(0.4, kDobson, GasModel::standard) / through(0.4, 3.0 * kDobson, GasModel::standard)),
      2.0 * depth, 1e-6);
  EXPECT_EQ(through(0.4, 1e-9, GasModel::lowtran7),
            through(0.4, kDobson, GasModel::lowtran7));  // twin: without it
  // What leaving it out would cost: of the model atmosphere's own column straight up, a third to half a percent in the blue.
  const Profile profile = build_profile({}).profile;
  const GasAmounts all = vertical_amounts(profile, profile.ground_km(), 100.0);
  const double lost = continuum_depths(1e4 / 0.44, all, GasModel::standard).nitrogen_dioxide;
  EXPECT_GT(lost, 0.0015);
  EXPECT_LT(lost, 0.005);
}

}  // namespace ifov::atmosphere::test_nitrogen_dioxide
