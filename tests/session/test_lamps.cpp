// Lamps: what they give off comes out, and the ground below them has the irradiance of a closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
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

namespace ifov::session::test_lamps {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kReflectance = 0.5;

/// A grey level ground of 0.5 under a lamp at night: one pixel of 1 mm at a place to the east of straight below it.
Session load(const std::string& lamp, double east_m = 0.0,
             const std::string& channel = R"("monochromatic": {"at": "550 nm"})") {
  return Session::load(
      io::parse_document(format(R"({{"ifov": 1, "scene": {{"materials": {{"ground": {{"reflectance": {}}}}},
                      "objects": [{{"plane": {{}}, "material": "ground"}}]}},
                     "light": {{"sources": [{}]}},
                     "sensor": {{"camera": {{"orthographic": {{"gsd": "1 mm", "pixels": [1, 1], "center": ["{} m", "0 m"]}}}},
                                 "channels": [{{"name": "c", {}}}]}},
                     "sampling": {{"accuracy": {{"error": "0.2 %", "max_samples": 2000}}}}}})",
                                kReflectance, lamp, east_m, channel),
                         "lamps.json"),
      nullptr);
}

class OneTile final : public render::TileSink {
 public:
  void begin(const render::ImageInfo&) override {}
  void write(const sampling::TileResult& tile) override { result = tile; }
  sampling::TileResult result;
};

sampling::TileResult rendered(const Session& session, std::uint64_t seed = 1, bool seek = true) {
  render::RenderJob job = session.parts().job();
  job.seed = seed;
  job.transport.seek_emitters = seek;
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
    R"("spectrum": {"table": {"wavelength": ["499.9 nm", "500 nm", "600 nm", "600.1 nm"], "values": [0, 1, 1, 0]}})";

void expect_radiance(const Session& session, double wanted) {
  const sampling::TileResult tile = rendered(session);
  EXPECT_TRUE(tile.converged(0));
  EXPECT_NEAR(static_cast<double>(tile.mean[0]), wanted, 0.004 * wanted + 1e-12);
}

/// What ground shows that a lamp of this intensity (W sr-1 um-1), 4 m above the origin, lights `east_m` from there.
double lit(double intensity, double east_m) {
  return kReflectance / kPi * intensity * 4.0 / std::pow(16.0 + east_m * east_m, 1.5);
}

constexpr double kPerUm = 100.0 / 0.1001;  // of 100 W with the spectrum kFlat

TEST(Lamps, PointLampLightsTheGroundByItsPower) {
  const std::string lamp =
      format(R"({{"point": {{"at": ["0 m", "0 m", "4 m"], {}, "power": "100 W"}}}})", kFlat);
  EXPECT_NEAR(emitted(load(lamp), 0.01), kPerUm, 1e-3 * kPerUm);
  for (const double east : {1.0, 3.0}) expect_radiance(load(lamp, east), lit(kPerUm / (4.0 * kPi), east));
  // Seen itself.
  expect_radiance(load(lamp, 0.0), kPerUm / (4.0 * kPi) / (kPi * 1e-4));
}

TEST(Lamps, SpotLightsWithinItsConeAlone) {
  const std::string lamp = format(
      R"({{"spot": {{"at": ["0 m", "0 m", "4 m"], "half_angle": "20 deg", "edge": "10 deg", {}, "power": "100 W"}}}})",
      kFlat);
  EXPECT_NEAR(emitted(load(lamp), 0.01), kPerUm, 1e-3 * kPerUm);
  const double solid_angle =
      scene::SpotPattern({0.0, 0.0, -1.0}, 20.0 * kPi / 180.0, 10.0 * kPi / 180.0).solid_angle_sr();
  expect_radiance(load(lamp, 1.0), lit(kPerUm / solid_angle, 1.0));
  expect_radiance(load(lamp, 3.0), 0.0);  // 36.9 deg
}

TEST(Lamps, DiskShinesToOneSideByLambertsLaw) {
  const double radiance = kPerUm / (kPi * kPi * 0.25);
  // View factor of a disk to a level element beside its axis (Howell, B-12).
  const double s = 16.0 + 9.0 + 0.25;
  const double seen = 0.5 * (1.0 - (16.0 + 9.0 - 0.25) / std::sqrt(s * s - 4.0 * 9.0 * 0.25));
  for (const bool down : {true, false}) {
    const std::string lamp = format(
        R"({{"disk": {{"at": ["0 m", "0 m", "4 m"], "radius": "0.5 m", "towards": [0, 0, {}], {}, "power": "100 W"}}}})",
        down ? -1 : 1, kFlat);
    expect_radiance(load(lamp, 0.0), down ? 0.0 : radiance);
    expect_radiance(load(lamp, 3.0), down ? kReflectance * radiance * seen : 0.0);
  }
}

/// Of 24 pixels of sunlit ground beside a lamp that is ten times as bright as white under the Sun, twice rendered: those whose interval
/// holds, and those that are sure.
std::pair<int, int> in_daylight(bool seek) {
  const auto text = [](const std::string& lamp) {
    return format(R"({{"ifov": 1, "scene": {{"materials": {{"ground": {{"reflectance": {}}}}},
                      "objects": [{{"plane": {{}}, "material": "ground"}}]}},
                     "light": {{"sun": {{"point": {{"zenith": "30 deg", "azimuth": "90 deg"}}}}{}}},
                     "sensor": {{"camera": {{"orthographic": {{"gsd": "0.25 m", "pixels": [4, 6], "center": ["0.75 m", "0 m"]}}}},
                                 "channels": [{{"name": "c", "monochromatic": {{"at": "550 nm"}}}}]}},
                     "sampling": {{"accuracy": {{"error": "1 %", "max_samples": 2000}}}}}})",
                  kReflectance, lamp);
  };
  const auto load_text = [](const std::string& document) {
    return Session::load(io::parse_document(document, "daylight.json"), nullptr);
  };
  constexpr double kPower_w = 233.0, kRadius_m = 0.1, kHeight_m = 1.5;
  const Session dark = load_text(text({}));
  const Session session = load_text(text(format(
      R"(, "sources": [{{"sphere": {{"at": ["0 m", "0 m", "{} m"], "radius": "{} m", {}, "power": "{} W"}}}}])",
      kHeight_m, kRadius_m, kFlat, kPower_w)));
  const auto sunlit = static_cast<double>(rendered(dark).mean[0]);
  const double intensity = kPower_w / 0.1001 / (4.0 * kPi);
  std::pair<int, int> held_and_sure;
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    const sampling::TileResult tile = rendered(session, seed, seek);
    constexpr int kGrid = 16;
    for (std::size_t p = 0; p < 24; ++p) {
      double lamp = 0.0;
      for (int k = 0; k < kGrid * kGrid; ++k) {
        const double x = 0.25 + 0.25 * (static_cast<double>(p % 4) + (k % kGrid + 0.5) / kGrid);
        const double y = 0.75 - 0.25 * (static_cast<double>(p / 4) + (k / kGrid + 0.5) / kGrid);
        lamp += kReflectance / kPi * intensity * kHeight_m /
                std::pow(x * x + y * y + kHeight_m * kHeight_m, 1.5) / (kGrid * kGrid);
      }
      held_and_sure.first += std::abs(static_cast<double>(tile.mean[p]) - sunlit - lamp) <=
                             static_cast<double>(tile.half_width[p]);
      held_and_sure.second += tile.converged(p);
    }
  }
  return held_and_sure;
}

TEST(Lamps, InDaylightAreSought) {
  const auto [held, sure] = in_daylight(true);
  EXPECT_GE(held, 46);
  EXPECT_EQ(sure, 48);
  // Planted fault: their light is left to chance.
  const auto [lucky, deceived] = in_daylight(false);
  EXPECT_LT(lucky, 30);
  EXPECT_GE(deceived, 20);
}

// A small lamp over ground between slabs that are 40 K warmer, and outshine the ground at 1.6 um: they send a ten-thousandth of the
// lamp's light there, but most of what is sought at 10 um.
TEST(Lamps, AreSoughtBesideWarmThings) {
  constexpr double kRadiance = 3e4, kRadius_m = 0.01, kHeight_m = 4.0;
  std::string slabs;
  for (int k = -8; k <= 8; ++k)
    slabs += format(R"(, {{"box": {{"low": ["{0} m", "-8 m", "0 m"], "high": ["{1} m", "8 m", "5 cm"]}},
                          "material": "warm"}})",
                    k + 0.45, k + 0.55);
  const Session session =
      Session::load(io::parse_document(format(R"({{"ifov": 1, "scene": {{"materials": {{
             "ground": {{"reflectance": {}, "temperature": "280 K"}}, "warm": {{"reflectance": 0, "temperature": "320 K"}}}},
             "objects": [{{"plane": {{}}, "material": "ground"}}{}]}},
           "light": {{"sky": {{"none": {{}}}}, "sources": [{{"sphere": {{"at": ["0 m", "0 m", "{} m"], "radius": "{} m",
                                                                "radiance": "{} W m-2 sr-1 um-1"}}}}]}},
           "sensor": {{"camera": {{"orthographic": {{"gsd": "0.25 m", "pixels": [3, 4], "center": ["0 m", "2 m"]}}}},
                       "channels": [{{"name": "s", "monochromatic": {{"at": "1.6 um"}}}},
                                    {{"name": "t", "monochromatic": {{"at": "10 um"}}}}]}},
           "sampling": {{"accuracy": {{"error": "2 %"}}}}}})",
                                              kReflectance, slabs, kHeight_m, kRadius_m, kRadiance),
                                       "warm.json"),
                    nullptr);
  const sampling::TileResult tile = rendered(session);
  for (std::size_t p = 0; p < 12; ++p) {
    const double x = 0.25 * (static_cast<double>(p % 3) - 1.0), y = 2.375 - 0.25 * static_cast<double>(p / 3);
    const double expected = kReflectance * kRadiance * kRadius_m * kRadius_m * kHeight_m /
                            std::pow(x * x + y * y + kHeight_m * kHeight_m, 1.5);
    EXPECT_TRUE(tile.converged(p));
    EXPECT_LT(tile.samples[p], 5000u);  // 49,000 where one scale over all channels chooses
    EXPECT_NEAR(static_cast<double>(tile.mean[p * static_cast<std::size_t>(tile.columns)]), expected,
                0.025 * expected);
  }
}

TEST(Lamps, LumensAndTemperature) {
  const Session session =
      load(R"({"point": {"at": ["0 m", "0 m", "4 m"], "temperature": "2856 K", "flux": "1000 lm"}})");
  const scene::Lamp& lamp = session.parts().scene.lamps.at(0);
  EXPECT_NEAR(radiometry::luminous(lamp.radiance) * 4.0 * kPi * kPi * 1e-4, 1000.0, 0.1);
  const Session glowing =
      load(R"({"sphere": {"at": ["0 m", "0 m", "4 m"], "radius": "2 cm", "temperature": "2856 K"}})");
  const radiometry::Spectrum& light = glowing.parts().scene.lamps.at(0).radiance;
  const double stefan_boltzmann = 5.670374419e-8 * std::pow(2856.0, 4);
  EXPECT_NEAR(kPi * radiometry::integral(light, light.first_um(), light.last_um()), stefan_boltzmann,
              2e-4 * stefan_boltzmann);
}

TEST(Lamps, IntensitiesOfAFile) {
  const std::string path = testing::TempDir() + "lamps_test.ies";
  const auto write = [&](const std::string& planes) {
    std::ofstream(path) << "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 " << planes;
  };
  const auto lamp = [&](const std::string& more) {
    return format(R"({{"ies": {{"at": ["0 m", "0 m", "4 m"], "file": "{}", {}{}}}}})", path, kFlat, more);
  };
  write("4 1 2 0 0 0\n1 1 50\n0 45 90\n0 90 180 270\n");
  EXPECT_THROW(load(lamp("")), InputError);
  write(
      "5 1 2 0 0 0\n1 1 50\n0 45 90\n0 90 180 270 360\n200 400 0\n200 100 0\n200 100 0\n200 100 0\n200 400 0\n");
  const Session east = load(lamp(""), 3.0), south = load(lamp(R"(, "azimuth": "180 deg")"), 3.0);
  const double lumens = radiometry::luminous(radiometry::Spectrum({0.4999, 0.5, 0.6, 0.6001}, {0, 1, 1, 0}));
  const double across = std::atan2(3.0, 4.0) * 180.0 / kPi;
  expect_radiance(east, lit((200.0 + 200.0 * across / 45.0) / lumens, 3.0));
  expect_radiance(south, lit((200.0 - 100.0 * across / 45.0) / lumens, 3.0));
}

TEST(Lamps, ALineOfLightIsMetByAWideChannel) {
  // A line of 1 nm in a channel of 400 nm, on ground whose reflectance is 0.5 there and 0 elsewhere.
  const Session session = Session::load(
      io::parse_document(
          R"({"ifov": 1, "scene": {"materials": {"ground": {"reflectance": {"table": {"wavelength": ["400 nm", "580 nm",
            "585 nm", "595 nm", "600 nm", "800 nm"], "values": [0, 0, 0.5, 0.5, 0, 0]}}}},
            "objects": [{"plane": {}, "material": "ground"}]},
          "light": {"sources": [{"point": {"at": ["0 m", "0 m", "4 m"], "power": "100 W",
            "spectrum": {"table": {"wavelength": ["588.8 nm", "589.3 nm", "589.8 nm"], "values": [0, 1, 0]}}}}]},
          "sensor": {"camera": {"orthographic": {"gsd": "1 mm", "pixels": [1, 1], "center": ["3 m", "0 m"]}},
           
            "channels": [{"name": "c", "top_hat": {"from": "400 nm", "to": "800 nm"}}]},
          "sampling": {"accuracy": {"error": "0.2 %"}}})",
          "line.json"),
      nullptr);
  expect_radiance(session, 0.5 / kPi * 100.0 / (4.0 * kPi) * 4.0 / 125.0 / 0.4);
}

TEST(Lamps, ManyLampsAreSureAndRight) {
  // Twenty spots in a row that point down; the ground is lit by a few of them.
  std::string lamps;
  for (int k = 0; k < 20; ++k)
    lamps += format(
        R"({}{{"spot": {{"at": ["{} m", "0 m", "4 m"], "half_angle": "25 deg", "edge": "15 deg", {}, "power": "100 W"}}}})",
        k > 0 ? ", " : "", 3 * (k - 10), kFlat);
  const Session session = load(lamps, 1.0);
  const scene::SpotPattern spot({0.0, 0.0, -1.0}, 25.0 * kPi / 180.0, 15.0 * kPi / 180.0);
  double wanted = 0.0;
  for (int k = 0; k < 20; ++k) {
    const double x = 3.0 * (k - 10) - 1.0, d = std::hypot(4.0, x);
    wanted += lit(kPerUm / spot.solid_angle_sr() * spot.at({-x / d, 0.0, -4.0 / d}), x);
  }
  int outside = 0;
  std::int64_t rays = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const sampling::TileResult tile = rendered(session, seed);
    outside += std::abs(static_cast<double>(tile.mean[0]) - wanted) >
               static_cast<double>(tile.half_width[0]) + 1e-4 * wanted;
    rays += static_cast<std::int64_t>(tile.rays.total());
  }
  EXPECT_LE(outside, 2);
  EXPECT_LT(rays / 10, 5000);
}

TEST(Lamps, MistakesAreLocated) {
  const auto said = [](const std::string& lamp) -> std::string {
    try {
      load(lamp);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  const auto expect = [&](const std::string& lamp, const std::string& text) {
    const std::string found = said(lamp);
    EXPECT_NE(found.find("lamps.json:"), std::string::npos) << found;
    EXPECT_NE(found.find(text), std::string::npos) << found;
  };
  const std::string at = R"("at": ["0 m", "0 m", "4 m"])";
  expect(format(R"({{"point": {{{}, {}}}}})", at, kFlat), "give 'power' or 'flux' too");
  expect(format(R"({{"point": {{{}, "radiance": "5 W m-2 sr-1 um-1", "power": "1 W"}}}})", at), "'radiance'");
  expect(format(R"({{"point": {{{}, "temperature": "300 K", "flux": "1 lm"}}}})", at),
         "nothing of the light is visible");
  expect(format(R"({{"point": {{{}, "spectrum": 1, "power": "1 W"}}}})", at), "without end");
  expect(format(R"({{"point": {{{}, "temperature": "2000 K", "power": "1 W", "flux": "1 lm"}}}})", at),
         "'flux'");
  expect(format(R"({{"lantern": {{{}}}}})", at), "'point', 'sphere', 'disk', 'spot'");
}

}  // namespace
}  // namespace ifov::session::test_lamps
