#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "radiometry/solar_spectrum.h"
#include "support/truth_data.h"

namespace ifov::radiometry::test_solar_spectrum {
namespace {

// Total solar irradiance 1361 W m-2 (Kopp and Lean 2011, Geophys. Res. Lett. 38, L01706).
TEST(SolarSpectrum, IntegralIsTheSolarConstant) {
  const Spectrum& sun = solar_irradiance_1au();
  EXPECT_NEAR(integral(sun, sun.first_um(), sun.last_um()), 1361.0, 1.5);
  EXPECT_EQ(sun.at(0.1), 0.0);
  EXPECT_LT(sun.first_um(), 0.21);
  EXPECT_GT(sun.last_um(), 100.0);
}

// ASTM E490 is older, its total is 1366 W m-2, and it is up to 4 % brighter in the near infrared.
TEST(SolarSpectrum, AgreesWithE490) {
  const auto file = test::truth_file("sensors/solar/e490_00a.dat");
  if (!file) GTEST_SKIP() << "reference data not found: sensors/solar/e490_00a.dat";
  std::ifstream stream(*file);
  std::string line;
  std::getline(stream, line);
  std::vector<double> x, y;
  for (double a, b; stream >> a >> b;) {
    x.push_back(a);
    y.push_back(b);
  }
  const Spectrum e490(x, y);
  const auto ratio = [&](double a, double b) {
    return integral(solar_irradiance_1au(), a, b) / integral(e490, a, b);
  };
  for (double a = 0.40; a < 2.45; a += 0.05) EXPECT_NEAR(ratio(a, a + 0.05), 1.0, 0.04) << a;
  for (const double a : {2.5, 3.0, 4.0, 6.0, 8.0, 10.0, 14.0}) EXPECT_NEAR(ratio(a, a + 1.0), 1.0, 0.04) << a;
  EXPECT_NEAR(ratio(0.3, 20.0), 1361.0 / 1366.1, 0.003);
}

}  // namespace
}  // namespace ifov::radiometry::test_solar_spectrum
