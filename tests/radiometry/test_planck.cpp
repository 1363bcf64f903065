#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <string>

#include "radiometry/channel.h"
#include "radiometry/planck.h"
#include "support/truth_data.h"

namespace ifov::radiometry::test_planck {
namespace {

constexpr double kStefanBoltzmann = 5.670374419e-8;  // CODATA 2018

TEST(Planck, KnownRadiances) {
  EXPECT_NEAR(planck_w_m2_sr_um(8.5, 313.15), 12.113897, 1e-6);
  EXPECT_NEAR(planck_w_m2_sr_um(8.5, 293.15), 8.366091, 1e-6);
  EXPECT_NEAR(planck_w_m2_sr_um(10.0, 300.0), 9.9240333, 1e-7);
}

// Band radiances computed to 1e-12 with another program.
TEST(Planck, BandRadiancesOf300K) {
  const auto band = [](double first, double last) {
    return channel_planck_w_m2_sr_um(Channel::top_hat("", first, last), 300.0) * (last - first);
  };
  EXPECT_NEAR(band(3.0, 5.0) / 1.8659562, 1.0, 3e-8);
  EXPECT_NEAR(band(8.0, 12.0) / 38.500424, 1.0, 3e-8);
  EXPECT_NEAR(band(8.0, 14.0) / 54.933461, 1.0, 3e-8);
}

TEST(Planck, TotalIsStefanBoltzmann) {
  for (const double temperature : {150.0, 300.0, 6000.0}) {
    // Over ln(wavelength), from where Planck's law is nothing to where its tail is, by the trapezoid rule.
    double sum = 0.0;
    constexpr int kSteps = 20000;
    const double low = std::log(100.0 / temperature), high = std::log(3e9 / temperature);
    const double step = (high - low) / kSteps;
    for (int i = 0; i <= kSteps; ++i) {
      const double wavelength = std::exp(low + i * step);
      sum += planck_w_m2_sr_um(wavelength, temperature) * wavelength * step;
    }
    EXPECT_NEAR(sum * std::numbers::pi / (kStefanBoltzmann * std::pow(temperature, 4)), 1.0, 1e-9);
  }
}

TEST(Planck, BrightnessTemperatureInverts) {
  for (const double wavelength : {0.3, 1.0, 4.0, 10.9, 100.0, 10000.0})
    for (const double temperature : {50.0, 200.0, 300.0, 1000.0, 6000.0}) {
      const double radiance = planck_w_m2_sr_um(wavelength, temperature);
      if (radiance < 1e-290) continue;
      EXPECT_NEAR(brightness_temperature_k(wavelength, radiance) / temperature, 1.0, 1e-12) << wavelength;
    }
}

TEST(Planck, Extremes) {
  EXPECT_EQ(planck_w_m2_sr_um(0.3, 3.0), 0.0);
  EXPECT_EQ(planck_w_m2_sr_um(10.0, 0.0), 0.0);
  EXPECT_EQ(planck_w_m2_sr_um(10.0, -5.0), 0.0);
  EXPECT_EQ(planck_slope_w_m2_sr_um_k(0.3, 3.0), 0.0);
  EXPECT_EQ(brightness_temperature_k(10.0, 0.0), 0.0);
  EXPECT_EQ(brightness_temperature_k(10.0, -1.0), 0.0);
  // Rayleigh-Jeans: 2 c k T / wavelength^4, at 1 m in W m-2 sr-1 m-1 and then per um.
  EXPECT_NEAR(planck_w_m2_sr_um(1e6, 300.0) / (2.0 * 299792458.0 * 1.380649e-23 * 300.0 * 1e-6), 1.0, 1e-4);
  const double log_ratio = std::log(1.191042972e8 / 0.03125) + 305.0 * std::numbers::ln10;
  EXPECT_NEAR(brightness_temperature_k(0.5, 1e-305), 14387.768775 / 0.5 / log_ratio, 1e-6);
}

TEST(Planck, SlopeIsTheDerivative) {
  for (const double wavelength : {0.6, 3.7, 8.5, 12.0, 1000.0})
    for (const double temperature : {220.0, 300.0, 800.0}) {
      const double delta = 1e-4 * temperature;
      const double difference = (planck_w_m2_sr_um(wavelength, temperature + delta) -
                                 planck_w_m2_sr_um(wavelength, temperature - delta)) /
                                (2.0 * delta);
      EXPECT_NEAR(planck_slope_w_m2_sr_um_k(wavelength, temperature) / difference, 1.0, 1e-4);
    }
}

TEST(Planck, ReferenceTable) {
  const auto file = test::truth_file("thermal_radiometry/planck_table.csv");
  if (!file) GTEST_SKIP() << "reference data not found: thermal_radiometry/planck_table.csv";
  std::ifstream stream(*file);
  std::string line;
  std::getline(stream, line);
  int rows = 0;
  double wavelength, temperature, radiance, slope;
  char comma;
  while (stream >> wavelength >> comma >> temperature >> comma >> radiance >> comma >> slope) {
    EXPECT_NEAR(planck_w_m2_sr_um(wavelength, temperature) / radiance, 1.0, 1e-9) << line;
    EXPECT_NEAR(planck_slope_w_m2_sr_um_k(wavelength, temperature) / slope, 1.0, 1e-9) << line;
    ++rows;
  }
  EXPECT_EQ(rows, 176);
}

}  // namespace
}  // namespace ifov::radiometry::test_planck
