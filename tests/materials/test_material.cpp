#include <gtest/gtest.h>

#include "core/error.h"
#include "materials/bsdf/lambertian.h"
#include "materials/bsdf/mirror.h"
#include "materials/draped_map.h"
#include "materials/material.h"

namespace ifov::materials::test_material {
namespace {

template <class Action>
std::string message_of(const Action& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Material, IsChecked) {
  Material m{"roof", radiometry::Spectrum({0.4, 0.7}, {0.2, 1.2}), Lambertian::shared(), {}};
  EXPECT_EQ(message_of([&] { check(m); }),
            "material 'roof': reflectance must lie between 0 and 1; it reaches from 0.2 to 1.2");
  m.reflectance = radiometry::Spectrum::constant(0.5);
  m.temperature_k = 0.0;
  EXPECT_EQ(message_of([&] { check(m); }), "material 'roof': a temperature must be above 0 K; found 0 K");
  m.temperature_k = 300.0;
  EXPECT_NO_THROW(check(m));
}

TEST(Material, LeavesLetThroughNoMoreThanIsLeft) {
  Material m{"leaf", radiometry::Spectrum({0.4, 0.7, 1.0}, {0.1, 0.2, 0.6}), Lambertian::shared()};
  m.transmittance = radiometry::Spectrum({0.5, 0.9}, {0.2, 0.5});
  EXPECT_NO_THROW(check(m));
  m.transmittance = radiometry::Spectrum({0.5, 0.9}, {0.2, 0.75});
  EXPECT_EQ(
      message_of([&] { check(m); }),
      "material 'leaf': reflectance and transmittance must not sum to more than 1; at 0.9 um they are 0.466667 "
      "and 0.75");
  m.transmittance = radiometry::Spectrum::constant(-0.1);
  EXPECT_EQ(message_of([&] { check(m); }),
            "material 'leaf': transmittance must lie between 0 and 1; it reaches from -0.1 to -0.1");
  m.transmittance = radiometry::Spectrum::constant(0.1);
  m.bsdf = Mirror::shared();
  EXPECT_EQ(message_of([&] { check(m); }),
            "material 'leaf': only \"lambertian\" scattering can have a transmittance");
}

// 3 x 2 cells of 2 m x 1 m; the north-west corner at (10, 20).
const MapGrid kGrid{10.0, 20.0, 2.0, 1.0, 3, 2};

TEST(ClassMap, CellsFromTheNorthWest) {
  const ClassMap map(kGrid, {1, 2, 3, 4, 5, 6});
  EXPECT_EQ(map.at(10.1, 19.9), 1);
  EXPECT_EQ(map.at(13.0, 19.5), 2);
  EXPECT_EQ(map.at(15.9, 18.1), 6);
  EXPECT_EQ(map.at(12.0, 19.0), 5);  // a cell holds its west and north edges
  EXPECT_EQ(map.at(-1e300, 1e300), 1);
  EXPECT_EQ(map.at(1e300, -1e300), 6);
  EXPECT_EQ(map.largest_class(), 6);
}

TEST(TemperatureMap, BilinearBetweenCentres) {
  const TemperatureMap map(kGrid, {300, 310, 320, 400, 410, 420});
  EXPECT_DOUBLE_EQ(map.at_k(11.0, 19.5), 300.0);
  EXPECT_DOUBLE_EQ(map.at_k(12.0, 19.5), 305.0);
  EXPECT_DOUBLE_EQ(map.at_k(12.0, 19.0), 355.0);
  EXPECT_DOUBLE_EQ(map.at_k(15.0, 18.5), 420.0);
  EXPECT_DOUBLE_EQ(map.at_k(1e9, -1e9), 420.0);
  EXPECT_DOUBLE_EQ(map.at_k(-1e9, 1e9), 300.0);
  EXPECT_DOUBLE_EQ(map.minimum_k(), 300.0);
  EXPECT_DOUBLE_EQ(map.maximum_k(), 420.0);
}

TEST(DrapedMaps, RefuseWhatDoesNotFit) {
  EXPECT_EQ(message_of([] { ClassMap(kGrid, {1, 2}); }), "a map of 3 x 2 cells needs 6 values: found 2");
  EXPECT_EQ(message_of([] {
              ClassMap({0, 0, 0, 1, 1, 1}, {1});
            }),
            "a map needs cells of some size: found 1 x 1 cells of 0 m x 1 m");
  EXPECT_EQ(message_of([] {
              TemperatureMap({0, 0, 1, 1, 1, 1}, {-3.0f});
            }),
            "-3 K at row 1, column 1 is no temperature: expected above 0 K and at most 100000 K");
}

}  // namespace
}  // namespace ifov::materials::test_material
