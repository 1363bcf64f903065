// Lamps: what they give off comes out, and the ground below them has the irradiance of a closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <string>

#include "core/error.h"
#include "core/format.h"
#include "io/document/document.h"
#include "radiometry/photometry.h"
#include "radiometry/spectral_nodes.h"
#include "render/image_renderer.h"
#include "render/tile_sink.h"
#include "sampling/random.h"
#include "sampling/tile.h"
#include "scene/lamp.h"
#include "session/loaded/parts.h"
#include "session/session.h"
#include "transport/spectral_scene.h"

namespace ifov::session {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kReflectance = 0.5;

/// A grey level ground of 0.5 under a lamp at night; one pixel of 1 mm straight below it and one 3 m to the east of that.
Session load(const std::string& lamp, const std::string& channel = R"("at": "550 nm")",
             const std::string& more = "") {
  return Session::load(
      io::parse_document(format(R"({{"ifov": 1, "scene": {{"materials": {{"ground": {{"reflectance": {}}}}},
                   "objects": [{{"plane": {{}}, "material": "ground"}}{}]}},
                 "light": {{"sources": [{}]}},
                 "sensor": {{"camera": {{"orthographic": {{"gsd": "3 m", "pixels": [2, 1], "center": ["1.5 m", "0 m"]}}}},
                             "footprint": {{"box": {{"width": "0.001 px"}}}},
                             "channels": [{{"name": "c", {}}}]}},
                 "sampling": {{"accuracy": {{"error": "0.2 %", "max_samples": 2000}}}}}})",
                                kReflectance, more, lamp, channel),
                         "lamps.json"));
}

class OneTile final : public render::TileSink {
 public:
  void begin(const render::ImageInfo&) override {}
  void write(const sampling::TileResult& tile) override { result = tile; }
  sampling::TileResult result;
};

sampling::TileResult rendered(const Session& session, std::uint64_t seed = 1) {
  render::RenderJob job = session.parts().job();
  job.seed = seed;
  render::RenderControl control;
  control.threads = 1;
  OneTile tile;
  render::render_image(job, control, tile);
  return tile.result;
}

/// Spectral power of the lamp's light, W um-1 at a wavelength, as its surface is said to shine: a ball of area pi r^2 from
/// everywhere, summed over random directions.
double emitted(const Session& session, double radius_m, std::size_t node = 0) {
  const scene::Scene& scene = session.parts().scene;
  std::uint32_t state = 0;
  while (scene.states[state].lamp == 0) ++state;
  scene::ResolvedSurface surface{};
  surface.count = 1;
  surface.constituents[0] = {state, scene.states[state].material, 1.0, 0.0};
  surface.shading_normal = math::as_normal({0.0, 0.0, 1.0});
  radiometry::SpectrumBlock scratch(3, session.parts().spectral_scene->node_count());
  constexpr int kSide = 600;
  double sum = 0.0;
  for (int k = 0; k < kSide * kSide; ++k) {
    const double z = -1.0 + 2.0 * (k / kSide + 0.5) / kSide, about = 2.0 * kPi * (k % kSide + 0.5) / kSide;
    const double r = std::sqrt(1.0 - z * z);
    const float* light = session.parts().spectral_scene->emission(
        surface, {r * std::cos(about), r * std::sin(about), z}, scratch.row(0));
    sum += static_cast<double>(light[node]);
  }
  return sum * 4.0 * kPi / (kSide * kSide) * kPi * radius_m * radius_m;
}

/// A spectrum with all its power, 1 by itself, between 500 and 600 nm.
const char* const kFlat =
    R"("spectrum": {"table": [["499.9 nm", 0], ["500 nm", 1], ["600 nm", 1], ["600.1 nm", 0]]})";

void expect_radiance(const sampling::TileResult& tile, std::size_t pixel, double wanted) {
  EXPECT_TRUE(tile.converged(pixel));
  EXPECT_NEAR(static_cast<double>(tile.mean[pixel]), wanted, 0.004 * wanted + 1e-12);
}

TEST(Lamps, PointLampLightsTheGroundByItsPower) {
  const Session session =
      load(format(R"({{"point": {{"at": ["0 m", "0 m", "4 m"], {}, "power": "100 W"}}}})", kFlat));
  const double per_um = 100.0 / 0.1001;  // of the spectrum's integral, 0.1001 um
  EXPECT_NEAR(emitted(session, 0.01), per_um, 1e-3 * per_um);
  const sampling::TileResult tile = rendered(session);
  const double intensity = per_um / (4.0 * kPi);
  expect_radiance(tile, 0, kReflectance / kPi * intensity / 16.0);
  expect_radiance(tile, 1, kReflectance / kPi * intensity * 4.0 / 125.0);
}

TEST(Lamps, SpotLightsWithinItsConeAlone) {
  const Session session = load(format(
      R"({{"spot": {{"at": ["0 m", "0 m", "4 m"], "half_angle": "20 deg", "edge": "10 deg", {}, "power": "100 W"}}}})",
      kFlat));
  const double per_um = 100.0 / 0.1001;
  EXPECT_NEAR(emitted(session, 0.01), per_um, 1e-3 * per_um);
  const sampling::TileResult tile = rendered(session);
  const double solid_angle =
      scene::SpotPattern({0.0, 0.0, -1.0}, 20.0 * kPi / 180.0, 10.0 * kPi / 180.0).solid_angle_sr();
  expect_radiance(tile, 0, kReflectance / kPi * per_um / solid_angle / 16.0);
  expect_radiance(tile, 1, 0.0);  // 36.9 deg
}

TEST(Lamps, DiskShinesToOneSideByLambertsLaw) {
  for (const bool down : {true, false}) {
    const Session session = load(format(
        R"({{"disk": {{"at": ["0 m", "0 m", "4 m"], "radius": "0.5 m", "towards": [0, 0, {}], {}, "power": "100 W"}}}})",
        down ? -1 : 1, kFlat));
    const sampling::TileResult tile = rendered(session);
    // Irradiance below the middle of a disk: pi L r^2 / (r^2 + h^2); seen from above, the disk itself hides that point.
    const double radiance = 100.0 / 0.1001 / (kPi * kPi * 0.25);
    EXPECT_NEAR(static_cast<double>(tile.mean[0]), down ? 0.0 : radiance, 1e-3 * radiance);
    const double d2 = 9.0 + 16.0, r2 = 0.25, h2 = 16.0, s = h2 + 9.0 + r2;
    const double factor = 0.5 * (1.0 - (h2 + 9.0 - r2) / std::sqrt(s * s - 4.0 * 9.0 * r2));  // Howell, B-12
    EXPECT_LT(factor, r2 / d2);
    expect_radiance(tile, 1, down ? kReflectance * radiance * factor : 0.0);
  }
}

TEST(Lamps, LumensAndTemperature) {
  const Session session =
      load(R"({"point": {"at": ["0 m", "0 m", "4 m"], "temperature": "2856 K", "flux": "1000 lm"}})",
           R"("top_hat": {"from": "540 nm", "to": "560 nm"})");
  const scene::Lamp& lamp = session.parts().scene.lamps.at(0);
  EXPECT_NEAR(radiometry::luminous(lamp.radiance) * 4.0 * kPi * kPi * 1e-4, 1000.0, 0.1);
  // A blackbody by its temperature alone: pi r^2 of it, 4 pi sr, is sigma T^4 of 4 pi r^2.
  const Session glowing =
      load(R"({"sphere": {"at": ["0 m", "0 m", "4 m"], "radius": "2 cm", "temperature": "2856 K"}})");
  const radiometry::Spectrum& light = glowing.parts().scene.lamps.at(0).radiance;
  EXPECT_NEAR(kPi * radiometry::integral(light, light.first_um(), light.last_um()),
              5.670374419e-8 * std::pow(2856.0, 4), 2e-4 * 3.77e6);
}

TEST(Lamps, IntensitiesOfAFile) {
  const std::string path = testing::TempDir() + "lamps_test.ies";
  std::ofstream(path) << "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 4 1 2 0 0 0\n1 1 50\n0 45 90\n0 90 180 270\n";
  EXPECT_THROW(load(format(R"({{"ies": {{"at": ["0 m", "0 m", "4 m"], "file": "{}"}}}})", path)), InputError);
  std::ofstream(path)
      << "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 5 1 2 0 0 0\n1 1 50\n0 45 90\n0 90 180 270 360\n"
      << "200 400 0\n200 100 0\n200 100 0\n200 100 0\n200 400 0\n";
  const Session session = load(format(
      R"({{"ies": {{"at": ["0 m", "0 m", "4 m"], "file": "{}", {}, "azimuth": "90 deg"}}}})", path, kFlat));
  const sampling::TileResult tile = rendered(session);
  const double seen = radiometry::luminous(session.parts().scene.lamps[0].radiance) /
                      session.parts().scene.lamps[0].radiance.at(0.55);  // lm per W um-1
  const double across = std::atan2(3.0, 4.0) * 180.0 / kPi;
  expect_radiance(tile, 0, kReflectance / kPi * 200.0 / seen / 16.0);
  expect_radiance(tile, 1, kReflectance / kPi * (200.0 + 200.0 * across / 45.0) / seen * 4.0 / 125.0);
  const Session turned = load(format(
      R"({{"ies": {{"at": ["0 m", "0 m", "4 m"], "file": "{}", {}, "azimuth": "0 deg"}}}})", path, kFlat));
  expect_radiance(rendered(turned), 1,
                  kReflectance / kPi * (200.0 - 100.0 * across / 45.0) / seen * 4.0 / 125.0);
}

TEST(Lamps, ALineOfLightIsMetByAWideChannel) {
  // A line of 1 nm in a channel of 400 nm, on ground whose reflectance is 0.5 there and 0 elsewhere.
  const Session session = Session::load(io::parse_document(
      R"({"ifov": 1, "scene": {"materials": {"ground": {"reflectance": {"table": [["400 nm", 0], ["580 nm", 0],
            ["585 nm", 0.5], ["595 nm", 0.5], ["600 nm", 0], ["800 nm", 0]]}}},
            "objects": [{"plane": {}, "material": "ground"}]},
          "light": {"sources": [{"point": {"at": ["0 m", "0 m", "4 m"], "power": "100 W",
            "spectrum": {"table": [["588.8 nm", 0], ["589.3 nm", 1], ["589.8 nm", 0]]}}}]},
          "sensor": {"camera": {"orthographic": {"gsd": "1 m", "pixels": [1, 1]}},
            "footprint": {"box": {"width": "0.001 px"}},
            "channels": [{"name": "c", "top_hat": {"from": "400 nm", "to": "800 nm"}}]},
          "sampling": {"accuracy": {"error": "0.2 %"}}})",
      "line.json"));
  const sampling::TileResult tile = rendered(session);
  expect_radiance(tile, 0, 0.5 / kPi * 100.0 / (4.0 * kPi) / 16.0 / 0.4);
}

TEST(Lamps, ManyLampsAreSureAndRight) {
  // Twenty spots in a row that point down, of which a point on the ground has one or two above it.
  std::string lamps;
  for (int k = 0; k < 20; ++k)
    lamps += format(
        R"({}{{"spot": {{"at": ["{} m", "0 m", "4 m"], "half_angle": "25 deg", "edge": "15 deg", {}, "power": "100 W"}}}})",
        k > 0 ? ", " : "", 3 * (k - 10), kFlat);
  const Session session = load(lamps);
  const scene::SpotPattern spot({0.0, 0.0, -1.0}, 25.0 * kPi / 180.0, 15.0 * kPi / 180.0);
  double wanted = 0.0;
  for (int k = 0; k < 20; ++k) {
    const double x = 3.0 * (k - 10), d = std::sqrt(16.0 + x * x);
    wanted += kReflectance / kPi * 100.0 / 0.1001 / spot.solid_angle_sr() * spot.at({-x / d, 0.0, -4.0 / d}) *
              4.0 / (d * d * d);
  }
  int outside = 0, rays = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const sampling::TileResult tile = rendered(session, seed);
    outside += std::abs(static_cast<double>(tile.mean[0]) - wanted) >
               static_cast<double>(tile.half_width[0]) + 1e-4 * wanted;
    rays += static_cast<int>(tile.rays.total());
  }
  EXPECT_LE(outside, 2);
  EXPECT_LT(rays / 10, 20000);
}

}  // namespace
}  // namespace ifov::session
