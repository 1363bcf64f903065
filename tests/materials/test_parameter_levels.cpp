// Levels of a parameter: what two of them side by side are off from the model between, measured apart from how they were placed.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "materials/bsdf/bsdf_model.h"
#include "materials/bsdf/hemisphere.h"
#include "materials/parameter_levels.h"

namespace ifov::materials::test_parameter_levels {
namespace {

std::shared_ptr<const Bsdf> lacquer(double roughness) {
  return bsdf_model("rough_dielectric")
      .make({radiometry::Spectrum::constant(0.3),
             {{"index", radiometry::Spectrum::constant(1.5)},
              {"roughness", roughness},
              {"distribution", std::string("ggx")},
              {"over", std::string("lambertian")}}});
}

std::vector<std::shared_ptr<const Bsdf>> one(double roughness) { return {lacquer(roughness)}; }

/// Largest relative error of the reflectance for light from two angles, halfway between levels, by the integral that materials use.
double largest_error(const std::vector<double>& levels) {
  double worst = 0.0;
  for (const double cosine : {0.9, 0.35}) {
    const auto reflectance = [&](double roughness) {
      return directional_hemispherical(*lacquer(roughness), Side::reflected, cosine).at(1.0);
    };
    double low = reflectance(levels.front());
    for (std::size_t k = 0; k + 1 < levels.size(); ++k) {
      const double high = reflectance(levels[k + 1]), exact = reflectance(0.5 * (levels[k] + levels[k + 1]));
      worst = std::max(worst, std::abs(0.5 * (low + high) / exact - 1.0));
      low = high;
    }
  }
  return worst;
}

std::vector<double> rising(int count) {
  std::vector<double> values;
  for (int k = 0; k < count; ++k) values.push_back(0.1 + 0.1 * k / (count - 1));
  return values;
}

TEST(ParameterLevels, ReflectanceBetweenThemIsThatOfTheModel) {
  const ParameterLevels placed = place_levels(rising(61), 64, one);
  EXPECT_LE(placed.worst.reflectance, kLevelTolerance.reflectance);
  EXPECT_LE(placed.worst.direction, kLevelTolerance.direction);
  EXPECT_LT(placed.values.size(), 40u);
  EXPECT_DOUBLE_EQ(placed.values.front(), 0.1);
  EXPECT_DOUBLE_EQ(placed.values.back(), 0.2);
  const double error = largest_error(placed.values);
  EXPECT_LT(error, kLevelTolerance.reflectance);
  RecordProperty("error_1e6", static_cast<int>(1e6 * error));
  RecordProperty("direction_1e6", static_cast<int>(1e6 * placed.worst.direction));
  RecordProperty("levels", static_cast<int>(placed.values.size()));
}

TEST(ParameterLevels, TooFewAreOffAndSaidToBe) {
  const ParameterLevels placed = place_levels(rising(61), 2, one);
  EXPECT_EQ(placed.values.size(), 2u);
  EXPECT_GT(placed.worst.reflectance, kLevelTolerance.reflectance);
  EXPECT_GT(placed.worst.direction, kLevelTolerance.direction);
  EXPECT_GT(largest_error(placed.values), kLevelTolerance.reflectance);
}

TEST(ParameterLevels, FewValuesAreAllLevelsOrNearOnes) {
  const ParameterLevels two = place_levels(std::vector<double>{0.2, 0.8}, 64, one);
  EXPECT_EQ(two.values, (std::vector<double>{0.2, 0.8}));
  EXPECT_EQ(two.worst.reflectance, 0.0);
  EXPECT_EQ(place_levels(std::vector<double>{0.3}, 64, one).values, std::vector<double>{0.3});
  // Between the same model twice nothing is off.
  const LevelError none = level_error(*lacquer(0.3), *lacquer(0.3), 0.5, *lacquer(0.3));
  EXPECT_LT(none.reflectance, 1e-6);
  EXPECT_LT(none.direction, 1e-6);
}

}  // namespace
}  // namespace ifov::materials::test_parameter_levels
