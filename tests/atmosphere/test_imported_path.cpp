#include <gtest/gtest.h>

#include <cmath>

#include "atmosphere/imported_path.h"
#include "core/error.h"

namespace ifov::atmosphere::test_imported_path {
namespace {

using Q = PathQuantity;

template <class Act>
std::string error_of(const Act& act) {
  try {
    act();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(ImportedPath, NamesAreUniqueAndFound) {
  for (const std::string& name : path_quantity_names()) EXPECT_EQ(name_of(*path_quantity(name)), name);
  EXPECT_EQ(path_quantity_names().size(), kPathQuantities);
  EXPECT_EQ(name_of(Q::surface_emissivity), "surface_emissivity");
  EXPECT_EQ(unit_of(Q::solar_irradiance), "W m-2 um-1");
  EXPECT_FALSE(path_quantity("radiance"));
}

TEST(ImportedPath, WhatIsAbsentIsAbsent) {
  ImportedPath path("a.csv", {0.4, 0.5});
  path.set(Q::total_radiance, {1.0, 3.0});
  path.set(Q::ground_sensor_transmittance, {1.0005, -0.0005});
  EXPECT_FALSE(path.has(Q::solar_path_radiance));
  EXPECT_DOUBLE_EQ(path.spectrum(Q::total_radiance).at(0.45), 2.0);
  EXPECT_DOUBLE_EQ(path.column(Q::ground_sensor_transmittance)[0], 1.0);  // rounding is cut off
  EXPECT_DOUBLE_EQ(path.column(Q::ground_sensor_transmittance)[1], 0.0);
  EXPECT_EQ(
      error_of([&] { path.need(Q::solar_path_radiance); }),
      "a.csv: has no solar_path_radiance; there are 'ground_sensor_transmittance' and 'total_radiance'");
  EXPECT_FALSE(path.surface_albedo());
  path.set(Q::surface_emissivity, {0.9, 0.9});
  EXPECT_NEAR(*path.surface_albedo(), 0.1, 1e-12);
  path.set(Q::surface_emissivity, {0.9, 0.8});
  EXPECT_FALSE(path.surface_albedo());
}

TEST(ImportedPath, RefusesWhatCannotBe) {
  EXPECT_EQ(error_of([] { ImportedPath("a", {0.5, 0.4}); }), "a: wavelengths do not rise at 0.4 um");
  ImportedPath path("a", {0.4, 0.5});
  EXPECT_EQ(error_of([&] {
              path.set(Q::spherical_albedo, {0.1, 1.2});
            }),
            "a: found a spherical_albedo of 1.2 at 0.5 um; expected 0 to 1");
  EXPECT_EQ(error_of([&] { path.set(Q::total_radiance, {0.1}); }),
            "a: found 1 values of total_radiance at 2 wavelengths");
  EXPECT_EQ(error_of([&] {
              path.set(Q::total_radiance, {0.1, NAN});
            }),
            "a: found a total_radiance at 0.5 um that is no number");
}

}  // namespace
}  // namespace ifov::atmosphere::test_imported_path
