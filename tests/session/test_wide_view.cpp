// Every pixel has the air of its own line of sight, and of the height that it ends at; ground has its light.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "atmosphere/sensor/sensor_atmosphere.h"
#include "core/format.h"
#include "io/document/document.h"
#include "render/mirrors/glints.h"
#include "sampling/footprint_groups.h"
#include "sampling/pixel_footprint.h"
#include "sampling/tile.h"
#include "sensor/sinking_scanner.h"
#include "session/assembly/atmosphere/atmosphere_assembly.h"
#include "session/loaded/parts.h"
#include "session/session.h"
#include "transport/spectral_scene.h"
#include "transport/view_table.h"

namespace ifov::session::test_wide_view {
namespace {

namespace fs = std::filesystem;

class WideView : public testing::Test {
 protected:
  WideView() : folder_(fs::temp_directory_path() / format("ifov_wide_{}", getpid())) {
    fs::create_directories(folder_);
  }
  ~WideView() override { fs::remove_all(folder_); }

  /// Black ground of 300 K: what is seen is the path, and its transmittance in the thermal channel.
  io::Document document(const std::string& camera, const std::string& more = "", double reflectance = 0.0,
                        const std::string& sampling = R"({"grid": {"elements": [1, 1]}})") const {
    return io::parse_document(
        format(
            R"({{"ifov": 1, "scene": {{"materials": {{"soot": {{"reflectance": {}, "temperature": "300 K"}},
                     "chrome": {{"reflectance": 0.5, "scattering": "mirror", "temperature": "300 K"}}}},
                   "objects": [{{"plane": {{}}, "material": "soot"}}{}]}},
                   "light": {{"sun": {{"point": {{"zenith": "35 deg", "azimuth": "130 deg"}}}}}},
                   "atmosphere": {{"profile": "mid-latitude summer"}},
                   "sensor": {{"camera": {{{}}},
                     "channels": [{{"name": "blue", "gaussian": {{"center": "0.45 um", "fwhm": "2 nm"}}}},
                                  {{"name": "thermal", "gaussian": {{"center": "10.5 um", "fwhm": "500 nm"}}}}]}},
                   "sampling": {}}})",
            reflectance, more, camera, sampling),
        (folder_ / "scene.json").string());
  }
  /// By pixel and channel.
  std::vector<float> image(const io::Document& document, int pixels) const {
    RunOptions options;
    options.output_folder = folder_ / "out";
    Session::load(document, nullptr).render(options);
    std::ifstream file(options.output_folder / "image_radiance.img", std::ios::binary);
    std::vector<float> lines(2 * static_cast<std::size_t>(pixels) * pixels), values(lines.size());
    file.read(reinterpret_cast<char*>(lines.data()), static_cast<std::streamsize>(4 * lines.size()));
    for (int y = 0; y < pixels; ++y)
      for (int c = 0; c < 2; ++c)
        for (int x = 0; x < pixels; ++x)
          values[2 * static_cast<std::size_t>(y * pixels + x) + c] =
              lines[static_cast<std::size_t>((y * 2 + c) * pixels + x)];
    return values;
  }
  fs::path folder_;
};

constexpr const char* kWide = R"("frame": {"focal_length": "10 mm", "pitch": "1 mm", "pixels": [11, 11],
    "position": ["0 m", "0 m", "4 km"], "look_at": ["0 m", "0 m", "0 m"]})";

// A narrow camera at the same place that looks where a pixel of the wide one does.
TEST_F(WideView, APixelIsWhatACameraOfItsOwnSees) {
  const std::vector<float> wide = image(document(kWide), 11);
  // 4 degrees from the point opposite the Sun haze has a peak that the table is too coarse for, and says so.
  const double stated =
      Session::load(document(kWide), nullptr).parts().atmosphere->errors()[0].lines_of_sight.path;
  const std::size_t middle = 5 * 11 + 5;
  for (const auto& [x, y] : {std::pair{5, 5}, {0, 0}, {10, 2}, {3, 10}}) {
    const double east = 400.0 * (x - 5), north = 400.0 * (5 - y);
    const std::string narrow = format(
        R"("frame": {{"focal_length": "10 m", "pitch": "1 mm", "pixels": [1, 1], "position": ["0 m", "0 m", "4 km"],
           "look_at": ["{:.1f} m", "{:.1f} m", "0 m"]}})",
        east, north);
    const std::vector<float> own = image(document(narrow), 1);
    const std::size_t pixel = static_cast<std::size_t>(y * 11 + x);
    const double off = x == 0 && y == 0 ? stated / static_cast<double>(own[0]) : 2e-3;
    EXPECT_NEAR(wide[2 * pixel] / own[0], 1.0, off) << x << " " << y;
    EXPECT_LT(off, 0.03);
    EXPECT_NEAR(wide[2 * pixel + 1] / own[1], 1.0, 5e-4) << x << " " << y;
    // The planted fault: the line of sight of the middle.
    if (x != 5) {
      EXPECT_GT(std::abs(wide[2 * middle] / own[0] - 1.0), 0.02) << x << " " << y;
    }
  }
}

TEST_F(WideView, HighGroundHasLessAirBeforeIt) {
  const char* mesa =
      R"(, {"box": {"low": ["-50 m", "-50 m", "0 m"], "high": ["50 m", "50 m", "1500 m"]}, "material": "soot"})";
  const char* above = R"("orthographic": {"gsd": "100 m", "pixels": [3, 3]})";
  const std::vector<float> flat = image(document(above), 3), high = image(document(above, mesa), 3);
  constexpr std::size_t kMiddle = 4, kCorner = 0;
  EXPECT_NEAR(high[2 * kCorner] / flat[2 * kCorner], 1.0, 1e-6);
  EXPECT_LT(high[2 * kMiddle], 0.85f * flat[2 * kMiddle]);
  EXPECT_GT(high[2 * kMiddle], 0.4f * flat[2 * kMiddle]);
  // Of 300 K seen through less air that is colder.
  EXPECT_GT(high[2 * kMiddle + 1], 1.01f * flat[2 * kMiddle + 1]);
}

// A mirror ball sends rho E R^2 / 4 every way, and as much of the glint is seen as the air before it lets through.
TEST_F(WideView, GlintsAreSeenThroughTheAirBeforeThem) {
  constexpr double kRadius_m = 20.0, kReflectance = 0.5;
  const char* ball =
      R"(, {"sphere": {"center": ["30 m", "10 m", "900 m"], "radius": "20 m"}, "material": "chrome"})";
  const Session session = Session::load(document(kWide, ball), nullptr);
  const transport::SpectralScene& scene = *session.parts().spectral_scene;
  const sensor::Camera& camera = *session.parts().camera;
  sampling::TileResult tile;
  tile.reset({0, 0, camera.width_px(), camera.height_px()}, 2);
  render::Glints(scene, camera, 0.5, 1).add_to(sampling::PixelFootprint::box(1.0), nullptr, tile);
  double total = 0.0;
  for (std::size_t at = 0; at < tile.mean.size(); at += 2) total += static_cast<double>(tile.mean[at]);

  const math::Vec3 to_sensor = math::Point3{0.0, 0.0, 4000.0} - math::Point3{30.0, 10.0, 900.0};
  const auto place = scene.view_table()->at(math::normalized(to_sensor), 915.0, 4000.0);
  std::vector<float> nodes(scene.node_count()), scratch(scene.stride()), channels(scene.stride());
  const float* sun = scene.sun_irradiance(915.0, scratch.data());
  for (std::size_t n = 0; n < nodes.size(); ++n)
    for (std::size_t k = 0; k < place.count; ++k)
      nodes[n] += place.weight[k] * place.transmittance[k][n] * sun[n];
  scene.nodes().to_channels(nodes.data(), channels.data());
  const double pixel_sr = 0.01;  // 1 mm at 10 mm
  const double intensity = kReflectance * static_cast<double>(channels[0]) * kRadius_m * kRadius_m / 4.0;
  EXPECT_NEAR(total, intensity / (pixel_sr * math::dot(to_sensor, to_sensor)), 0.03 * total);
}

TEST_F(WideView, ASensorThatSinksHasTheAirOfAllItsHeights) {
  constexpr double kGround_km = 0.25;
  const io::Document still = document(kWide);
  const io::ModelledAtmosphere& air = *still.atmosphere.modelled;
  const Session session = Session::load(still, nullptr);
  const atmosphere::SensorAltitudes one = sensor_altitudes(air, *session.parts().camera, kGround_km);
  EXPECT_EQ(one.low_km, one.high_km);
  EXPECT_EQ(one.low_km, kGround_km + 4.0);
  const test::SinkingScanner scanner;
  const atmosphere::SensorAltitudes all = sensor_altitudes(air, scanner, kGround_km);
  EXPECT_NEAR(all.low_km, kGround_km + 0.96, 1e-12);
  EXPECT_NEAR(all.high_km, kGround_km + 1.0, 1e-12);
  EXPECT_NEAR(sensor_geometry(still.sources, air, still.sensor.camera, scanner, std::nullopt, kGround_km)
                  .sensor_altitude_km,
              kGround_km + 0.98, 1e-12);
  // What the document says goes before.
  io::ModelledAtmosphere said = air;
  said.sensor_altitude_km = 9.0;
  EXPECT_EQ(sensor_altitudes(said, scanner, kGround_km).low_km, 9.0);
  EXPECT_EQ(sensor_altitudes(said, scanner, kGround_km).high_km, 9.0);
}

// Paths draw the sky by direction; its irradiance was integrated by the solver of the air.
TEST_F(WideView, LevelGroundReflectsTheIrradianceOfSunAndSky) {
  const io::Document grey = document(R"("orthographic": {"gsd": "1 m", "pixels": [8, 8]})", "", 0.4,
                                     R"({"grid": {"elements": [16, 16]}})");
  double mean = 0.0;
  const std::vector<float> seen = image(grey, 8);
  for (std::size_t pixel = 0; pixel < 64; ++pixel) mean += static_cast<double>(seen[2 * pixel]) / 64.0;
  const Session session = Session::load(grey, nullptr);
  const transport::SpectralScene& scene = *session.parts().spectral_scene;
  const double expected = 0.4 * scene.white_reflected()[0] + scene.path_radiance()[0];
  EXPECT_NEAR(mean / expected, 1.0, 1e-3);
}

TEST_F(WideView, FlatGroundFromStraightAboveKeepsOneRow) {
  const Session flat =
      Session::load(document(R"("orthographic": {"gsd": "1 m", "pixels": [3, 3]})"), nullptr);
  EXPECT_EQ(flat.parts().spectral_scene->view_table(), nullptr);
  EXPECT_FALSE(flat.parts().spectral_scene->light_by_height());
  const Session wide = Session::load(document(kWide), nullptr);
  EXPECT_NE(wide.parts().spectral_scene->view_table(), nullptr);
}

}  // namespace
}  // namespace ifov::session::test_wide_view
