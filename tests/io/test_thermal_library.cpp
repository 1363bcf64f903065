#include <gtest/gtest.h>

#include "core/error.h"
#include "io/library/material_library.h"
#include "io/library/thermal_library.h"
#include "io/tables/text_table.h"

namespace ifov::io::test_thermal_library {
namespace {

std::string message_of_table(const std::string& text) {
  try {
    ThermalLibrary{TextFile("table", text)};
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(ThermalLibrary, KnowsWhatEverySpectrumStandsOn) {
  for (const LibraryMaterial& material : material_library().materials()) {
    const LibrarySurface* surface = thermal_library().surface(material.name);
    ASSERT_NE(surface, nullptr) << material.name;
    EXPECT_NO_THROW(thermal::check({surface->layers, thermal::Insulated{}})) << material.name;
    EXPECT_LE(surface->wet_share, 1.0) << material.name;
  }
}

TEST(ThermalLibrary, EverySolidHasASource) {
  EXPECT_GE(thermal_library().solids().size(), 35u);
  for (const LibrarySolid& solid : thermal_library().solids()) {
    EXPECT_GT(solid.source.size(), 20u) << solid.name;
    // From peat to sheets of metal.
    const double inertia = thermal::thermal_inertia(solid.values);
    EXPECT_GT(inertia, 35.0) << solid.name;
    EXPECT_LT(inertia, solid.name == "mixed water" ? 1e5 : 4.5e4) << solid.name;
  }
}

// The table of the project's own notes, of other handbooks: inertias in J m-2 K-1 s-1/2.
TEST(ThermalLibrary, InertiasAsOthersHaveThem) {
  const auto inertia = [](const char* name) {
    return thermal::thermal_inertia(thermal_library().solid(name).values);
  };
  EXPECT_NEAR(inertia("asphalt"), 1276.0, 100.0);
  EXPECT_NEAR(inertia("brick"), 1074.0, 5.0);
  EXPECT_NEAR(inertia("dry soil"), 620.0, 40.0);
  EXPECT_NEAR(inertia("dry sand"), 572.0, 40.0);
  EXPECT_NEAR(inertia("granite"), 2421.0, 60.0);
  EXPECT_NEAR(inertia("hardwood"), 532.0, 90.0);
  EXPECT_NEAR(inertia("water"), 1582.0, 30.0);
  EXPECT_NEAR(inertia("ice"), 2034.0, 150.0);
  EXPECT_NEAR(inertia("steel"), 13868.0, 700.0);
}

TEST(ThermalLibrary, SnowAndIceMelt) {
  for (const char* name : {"snow, melting", "ice"})
    EXPECT_EQ(thermal_library().surface(name)->melts_k, 273.15) << name;
  EXPECT_EQ(thermal_library().solid("fresh snow").melts_k, 273.15);
  EXPECT_TRUE(std::isinf(thermal_library().surface("grass, lawn")->melts_k));
}

TEST(ThermalLibrary, NamesNearMisses) {
  try {
    thermal_library().solid("asfalt");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what())
                  .find("the library has no thermal material 'asfalt'; did you mean 'asphalt'? It has "
                        "'dry soil', 'moist soil'"),
              0u)
        << error.what();
  }
  EXPECT_EQ(thermal_library().solid("Dry Soil").name, "dry soil");
  EXPECT_EQ(thermal_library().surface("no such thing"), nullptr);
}

TEST(ThermalLibrary, RefusesTablesThatAreNotWellFormed) {
  const std::string good = "origin: a a book\nsolid: x\nsource: a\nvalues: 1 2 3\n";
  EXPECT_EQ(message_of_table(good), "no error");
  EXPECT_NE(message_of_table("solid: x\nsource: b\n").find("table:2: no 'origin' is called 'b'"),
            std::string::npos);
  EXPECT_NE(message_of_table(good + "solid: y\nvalues: 1 0 3\n").find("found '0'; expected a number above 0"),
            std::string::npos);
  EXPECT_NE(message_of_table(good + "surface: s\nlayers: 0.1 z\n").find("no solid is called 'z'"),
            std::string::npos);
  EXPECT_NE(message_of_table(good + "surface: s\nroughness: rough\n").find("the surface 's' has no layers"),
            std::string::npos);
}

}  // namespace
}  // namespace ifov::io::test_thermal_library
