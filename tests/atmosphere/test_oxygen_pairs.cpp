#include <gtest/gtest.h>

#include <cmath>

#include "atmosphere/gas/continua.h"
#include "atmosphere/gas/oxygen_pairs.h"
#include "atmosphere/profile/built_profile.h"
#include "atmosphere/profile/profile_description.h"

using namespace ifov::atmosphere;

TEST(OxygenPairs, StrengthsAreThosePublished) {
  const auto strength = [](double first, double last) {  // cm-2 per amagat of oxygen squared
    double sum = 0.0;
    for (double nu = first; nu < last; nu += 1.0) sum += oxygen_pair_depth(nu) * 1e-5;
    return sum;
  };
  // Mate et al. (1999): 3.499e-4 with oxygen and 0.679e-4 cm-2 amagat-2 with nitrogen.
  EXPECT_NEAR(strength(7300.0, 8500.0) / (3.499e-4 + 0.679e-4 * 0.781 / 0.20946), 1.0, 5e-3);
  // Banerjee et al., Phys. Chem. Chem. Phys. 21 (2019) 1805: (2.10 +- 0.31)e-4 at 1.06 um.
  EXPECT_NEAR(strength(8900.0, 9900.0), 2.10e-4, 0.31e-4);
}

TEST(OxygenPairs, DepthGoesWithTheSquareOfDensity) {
  const Profile profile = build_profile({}).profile;
  const double amagat = 0.20946 * profile.air_per_cm3(0) / kLoschmidtCm3;
  const GasAmounts path = horizontal_amounts(profile, profile.altitude_km[0], 3.0);
  EXPECT_NEAR(path.oxygen_pairs / (3.0 * amagat * amagat), 1.0, 5e-3);
  EXPECT_GT(continuum_depths(17325.0, path, GasModel::standard).oxygen_pairs, 0.0);
  EXPECT_EQ(continuum_depths(17325.0, path, GasModel::lowtran7).oxygen_pairs, 0.0);
}
