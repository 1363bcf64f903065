#include <gtest/gtest.h>

#include "session/loaded/temperature_errors.h"

namespace ifov::session::test_temperature_errors {
namespace {

// Table G.2 of the Guide to the Expression of Uncertainty in Measurement (JCGM 100:2008), at 95.45 %.
TEST(TemperatureErrors, CoverageFactorsByTheirPoints) {
  const auto factor = [](double points) {
    return TemperatureErrors::OfMaterial{points, 1.0, 0.0}.half_width_k();
  };
  EXPECT_NEAR(factor(8.0), 2.37, 0.005);
  EXPECT_NEAR(factor(20.0), 2.13, 0.005);
  EXPECT_NEAR(factor(50.0), 2.05, 0.005);
  EXPECT_NEAR(factor(1e6), 2.0, 0.001);
  EXPECT_GT(factor(8.0), 2.3);  // a fault: 2 for any number
  EXPECT_NEAR((TemperatureErrors::OfMaterial{1e6, 0.3, 0.4}.half_width_k()), 1.0, 0.001);
}

TEST(TemperatureErrors, OfAnImageTheLargestStands) {
  TemperatureErrors errors;
  errors.by_material = {{1, {60.0, 0.1, 0.0}}, {2, {8.0, 0.2, 0.0}}, {5, {60.0, 0.05, 0.01}}};
  EXPECT_EQ(errors.half_width_k(), errors.by_material.at(2).half_width_k());
}

}  // namespace
}  // namespace ifov::session::test_temperature_errors
