// The ground in the air: lakes in a field against a Monte Carlo program in three dimensions, and what must not change.
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "atmosphere/column/atmosphere_column.h"
#include "core/format.h"
#include "io/document/document.h"
#include "session/loaded/parts.h"
#include "session/session.h"
#include "support/lake_monte_carlo.h"
#include "transport/sky/adjacent_ground.h"
#include "transport/spectral_scene.h"

namespace ifov::session::test_adjacency {
namespace {

namespace fs = std::filesystem;

constexpr std::array<double, 3> kWavelengths{0.45, 0.55, 0.865};
constexpr double kLake = 0.05, kField = 0.5;

class Adjacency : public testing::Test {
 protected:
  Adjacency() : folder_(fs::temp_directory_path() / format("ifov_adjacent_{}", getpid())) {
    fs::create_directories(folder_);
  }
  ~Adjacency() override { fs::remove_all(folder_); }

  /// A lake about the origin, of a radius in km, in a field without end.
  io::Document document(double radius_km, const std::string& more = "", const std::string& camera = "",
                        double lake = kLake, const std::string& sampling = "") const {
    return io::parse_document(
        format(
            R"({{"ifov": 1, "scene": {{"materials": {{"field": {{"reflectance": {}}}, "lake": {{"reflectance": {}}}}},
                   "objects": [{{"plane": {{}}, "material": "field"}},
                               {{"disk": {{"center": ["0 m", "0 m", "0.01 m"], "normal": [0, 0, 1], "radius": "{} km"}},
                                 "material": "lake"}}]}},
                   "light": {{"sun": {{"point": {{"zenith": "40 deg", "azimuth": "90 deg"}}}},
                              "surroundings": {{"reflectance": {}}}}},
                   "atmosphere": {{"profile": "mid-latitude summer"{}}},
                   "sensor": {{"camera": {{{}}},
                     "channels": [{{"name": "blue", "monochromatic": {{"at": "0.45 um"}}}},
                                  {{"name": "green", "monochromatic": {{"at": "0.55 um"}}}},
                                  {{"name": "infrared", "monochromatic": {{"at": "0.865 um"}}}}]}},
                   "sampling": {{"grid": {{"elements": [4, 4]}}{}}}}})",
            kField, lake, radius_km, kField, more,
            camera.empty() ? R"("orthographic": {"pixels": [3, 3], "gsd": "10 m"})" : camera, sampling),
        (folder_ / "scene.json").string());
  }
  std::string bytes(const io::Document& document, int threads = 0) const {
    RunOptions options;
    options.output_folder = folder_ / "out";
    options.threads = threads;
    LoadOptions load;
    load.threads = threads;
    Session::load(document, nullptr, load).render(options);
    std::ifstream file(options.output_folder / "image_radiance.img", std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  /// Of the middle of an image of 3 x 3 pixels, by channel.
  std::array<double, 3> middle(const io::Document& document) const {
    const std::string image = bytes(document);
    std::array<double, 3> values{};
    for (std::size_t c = 0; c < 3; ++c) {
      float value = 0.0f;
      std::memcpy(&value, image.data() + 4 * (9 + 3 * c + 1), 4);
      values[c] = static_cast<double>(value);
    }
    return values;
  }
  /// The same light by Monte Carlo, for sunlight of irradiance 1.
  test::LakeMonteCarlo::Result followed(double radius_km, std::size_t channel, int paths,
                                        double view_zenith_rad = 0.0) const {
    const atmosphere::AtmosphereColumn column{atmosphere::AtmosphereDescription{}};
    const atmosphere::ColumnOptics optics = column.at(1e4 / kWavelengths[channel]);
    atmosphere::LayerOptics layers = optics.scattering;
    layers.gas_absorption.assign(optics.continuum.size(), 0.0);
    for (std::size_t term = 0; term < optics.terms(); ++term) {
      const atmosphere::LayerOptics one = optics.term(term);
      for (std::size_t k = 0; k < one.layers(); ++k)
        layers.gas_absorption[k] += optics.weight(term) * one.gas_absorption[k];
    }
    const test::LakeMonteCarlo light(column.levels().altitude_km, layers, 40.0 * std::numbers::pi / 180.0);
    return light.seen(radius_km, kLake, kField, 0.0, view_zenith_rad, paths, 7);
  }
  fs::path folder_;
};

TEST_F(Adjacency, ALakeInAField) {
  const std::array<double, 3> field = middle(document(1.0, "", "", kField));
  std::array<test::LakeMonteCarlo::Result, 3> followed_field;
  for (std::size_t c = 0; c < 3; ++c) followed_field[c] = followed(0.0, c, 12000);
  bool told_apart = false;
  for (const double radius_km : {0.1, 2.0, 20.0}) {
    const std::array<double, 3> found = middle(document(radius_km)),
                                without = middle(document(radius_km, R"(, "adjacency": false)"));
    for (std::size_t c = 0; c < 3; ++c) {
      const test::LakeMonteCarlo::Result of_field = followed_field[c], lake = followed(radius_km, c, 10000);
      const double expected = lake.radiance / of_field.radiance;
      const double error = std::hypot(lake.error, expected * of_field.error) / of_field.radiance;
      EXPECT_LT(error, 0.009);
      EXPECT_NEAR(found[c] / field[c], expected, 0.01 + 2.0 * error)
          << radius_km << " km, " << kWavelengths[c] << " um";
      told_apart = told_apart || std::abs(without[c] / field[c] - expected) > 0.1;
    }
  }
  EXPECT_TRUE(told_apart);  // twin: the surroundings alone
}

TEST_F(Adjacency, SlantedLinesOfSight) {
  const std::string camera = R"("orthographic": {"pixels": [3, 3], "gsd": "10 m",
                                "view_zenith": "50 deg", "view_azimuth": "0 deg"})";
  const double field = middle(document(1.0, "", camera, kField))[0];
  const test::LakeMonteCarlo::Result of_field = followed(0.0, 0, 20000, 50.0 * std::numbers::pi / 180.0),
                                     lake = followed(2.0, 0, 20000, 50.0 * std::numbers::pi / 180.0);
  const double expected = lake.radiance / of_field.radiance;
  const double error = std::hypot(lake.error, expected * of_field.error) / of_field.radiance;
  EXPECT_NEAR(middle(document(2.0, "", camera))[0] / field, expected, 0.01 + 2.0 * error);
}

TEST_F(Adjacency, AUniformFieldIsAsItWas) {
  EXPECT_EQ(bytes(document(2.0, "", "", kField)),
            bytes(document(2.0, R"(, "adjacency": false)", "", kField)));
  const Session field = Session::load(document(2.0, "", "", kField), nullptr);
  EXPECT_EQ(field.parts().spectral_scene->adjacent_ground(), nullptr);
  EXPECT_NE(field.description().find("ground in the air: as the surroundings everywhere"), std::string::npos);
}

TEST_F(Adjacency, NeitherTilesNorThreadsChangeABit) {
  const std::string camera = R"("orthographic": {"pixels": [70, 70], "gsd": "30 m"})";
  const std::string all = bytes(document(0.5, "", camera, kLake, R"(, "tile": 64)"), 2);
  EXPECT_EQ(all, bytes(document(0.5, "", camera, kLake, R"(, "tile": 16)"), 1));
  EXPECT_NE(all, bytes(document(0.6, "", camera, kLake, R"(, "tile": 16)"), 1));
}

// What the description and the half-width say.
TEST_F(Adjacency, IsTold) {
  const Session lake = Session::load(document(0.5), nullptr);
  EXPECT_NE(lake.description().find("ground in the air: the scene's own, half of its light from within "),
            std::string::npos);
  const Session without = Session::load(document(0.5, R"(, "adjacency": false)"), nullptr);
  EXPECT_NE(without.description().find("ground in the air: the surroundings alone"), std::string::npos);
  for (std::size_t c = 0; c < 3; ++c) {
    const double more = lake.parts().air[c].path - without.parts().air[c].path;
    EXPECT_GT(more, 0.0);
    EXPECT_LT(more, 0.01 * lake.parts().air[c].grey_radiance);
  }
}

}  // namespace
}  // namespace ifov::session::test_adjacency
